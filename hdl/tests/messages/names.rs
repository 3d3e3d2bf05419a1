//! Names that clash, or that no port, net, instance or module may have.

use crate::messages::common::*;
use tilewright_hdl::*;

#[test]
fn a_name_is_for_a_port_that_exists() {
    block! {
        /// A word a clock later, under names of its own.
        struct Delay { port: u32 }
        port_names(self) { clk: "aclk", rst_n: "aresetn", word: ["word", "d", "no name", "late"][self.port as usize], late: "q" }
        in DelayIn { word: bits(8) }
        out DelayOut { late: bits(8) }
    }
    impl Delay {
        fn build(&self, m: Module, i: DelayIn) -> DelayOut {
            DelayOut { late: m.pipe("held", i.word) }
        }
    }
    let ports = |port| {
        elaborate(&Delay { port }).map(|design| {
            let top = design.top();
            [&top.clocks[0].port, &top.inputs[0].name, &top.outputs[0].name].map(String::clone).join(" ")
        })
    };
    assert_eq!((ports(0).unwrap(), ports(1).unwrap()), ("aclk word q".to_owned(), "aclk d q".to_owned()));
    let said = ports(2).unwrap_err().to_string();
    assert!(said.contains("`no name`") && said.contains("[T403]"), "{said}");

    block! {
        /// Names a port that it does not have.
        struct Misspelt;
        port_names { wird: "d", held: "q" }
        in MisspeltIn { word: bits(8) }
        out MisspeltOut { held: bits(8) }
    }
    impl Misspelt {
        fn build(&self, m: Module, i: MisspeltIn) -> MisspeltOut {
            MisspeltOut { held: m.pipe("late", i.word) }
        }
    }
    let said = elaborate(&Misspelt).unwrap_err().to_string();
    assert!(said.starts_with("`d` names the port `wird`, but `Misspelt` has no such port [T510]\n"), "{said}");
    assert!(
        said.contains("help: its ports are `word`, `held`; those of its clock are `clk`, `rst`, `rst_n`"),
        "{said}"
    );
}

#[test]
fn names_that_clash_or_are_illegal() {
    expect(
        |_, i| (i.a.named("sum") + 1).named("sum"),
        "net `sum` has the name of another net [T401]
         --> [|_, i| (i.a.named(\"sum\") + 1).named(\"sum\"),]
         the other net `sum` is declared at [|_, i| (i.a.named(\"sum\") + 1).named(\"sum\"),]
         help: rename one of them, or put a prefix before it: `m.within(\"first\", || ..)`",
    );
    assert!(problems(&Case(|_, i| (!i.a).named("b"))).starts_with("net `b` has the name of an input [T401]"));
    assert!(
        problems(&Case(|_, i| (!i.a).named("two words"))).starts_with("`two words` cannot be the name of a net [T403]")
    );
}

#[test]
fn ports_with_reserved_names() {
    assert_eq!(
        problems(&Through),
        "input `table` has a reserved word of Verilog for a name [T402]\n  --> [Reserved { table: bits(4) }]\n  help: call it `table_` or something else"
    );
}

#[test]
fn ports_with_names_reserved_in_cpp() {
    bundle! { struct Distance<T> { near: T } }
    /// Has a port that Verilator rejects.
    #[derive(Debug, Clone, PartialEq, Eq, Hash)]
    struct Near;
    impl Block for Near {
        type In = Distance;
        type Out = Out;
        fn inputs(&self) -> Distance<Width> {
            Distance { near: bits(4) }
        }
        fn build(&self, _: Module, i: Distance) -> Out {
            Out { out: !i.near }
        }
    }
    assert!(problems(&Near).starts_with("input `near` has a reserved word of C++ for a name [T402]"));
}

#[test]
fn instances_that_hide_something() {
    expect(
        |m, i| m.instance("y", &Inverter { registered: true }, Link { x: i.a }).out,
        "instance `y` has the name of something inside of it [T404]
         --> [|m, i| m.instance(\"y\", &Inverter { registered: true }, Link { x: i.a }).out,]
         the inner `y` is declared at [Out { out: if self.registered { m.pipe(\"y\", !i.x) } else { !i.x } }]
         help: call the instance `u_y`",
    );
    /// Has a register with the name of every lane.
    #[derive(Debug, Clone, PartialEq, Eq, Hash)]
    struct Street;
    impl Block for Street {
        type In = Link;
        type Out = Out;
        fn inputs(&self) -> Link<Width> {
            Link { x: bits(8) }
        }
        fn build(&self, m: Module, i: Link) -> Out {
            Out { out: m.pipe("lane", i.x) }
        }
    }
    let text = problems(&Case(|m, i| m.array("u_street", 2, &Street, |_| Link { x: i.a }).out.last()));
    assert!(
        text.starts_with("the lanes of `u_street` contain something called `lane`, the name of each lane [T404]"),
        "{text}"
    );
}

#[test]
fn inner_names_that_are_reserved_get_an_underscore() {
    let design = elaborate(&Case(|_, i| (!i.a).named("cell"))).unwrap();
    assert!(design.top().nodes.iter().any(|node| node.name.as_deref() == Some("cell_")));
}

#[test]
fn modules_of_one_name_and_different_contents() {
    /// Has the same name for every parameter.
    #[derive(Debug, Clone, PartialEq, Eq, Hash)]
    struct Twin(u32);
    impl Block for Twin {
        type In = Link;
        type Out = Out;
        fn inputs(&self) -> Link<Width> {
            Link { x: bits(self.0) }
        }
        fn build(&self, m: Module, i: Link) -> Out {
            Out { out: m.pipe("y", i.x) }
        }
        fn name(&self) -> String {
            "twin".to_owned()
        }
    }
    let text = problems(&Case(|m, i| {
        let b = m.instance("u_b", &Twin(7), Link { x: i.b }).out;
        m.instance("u_a", &Twin(8), Link { x: i.a }).out & b.zext(8)
    }));
    assert!(text.starts_with("`Twin(7)` and `Twin(8)` are both called `twin` [T405]"), "{text}");
}

#[test]
fn modules_with_illegal_names() {
    /// Named by a reserved word of Verilog.
    #[derive(Debug, Clone, PartialEq, Eq, Hash)]
    struct Unnameable;
    impl Block for Unnameable {
        type In = Link;
        type Out = Out;
        fn inputs(&self) -> Link<Width> {
            Link { x: bits(0) }
        }
        fn build(&self, _: Module, i: Link) -> Out {
            Out { out: i.x }
        }
        fn name(&self) -> String {
            "endmodule".to_owned()
        }
    }
    let text = problems(&Unnameable);
    assert!(text.starts_with("input `x` has no bits [T107]\n  --> [Link { x: bits(0) }]"), "{text}");
    assert!(text.contains("`endmodule` cannot be the name of a module [T403]"), "{text}");
}

/// A table of constants whose `Debug` text is its length only.
#[derive(Clone, PartialEq, Eq, Hash)]
struct Rom(&'static [u64]);

impl std::fmt::Debug for Rom {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        write!(f, "Rom {{ words: {} }}", self.0.len())
    }
}

impl Block for Rom {
    type In = Link;
    type Out = Out;

    fn inputs(&self) -> Link<Width> {
        Link { x: bits(8) }
    }

    fn build(&self, _: Module, i: Link) -> Out {
        Out { out: case(i.x, (0..).zip(self.0.iter().map(|word| lit(8, *word))), 0) }
    }
}

#[test]
fn different_blocks_that_print_alike() {
    expect(
        |m, i| {
            let one = m.instance("u_one", &Rom(&[1, 2]), Link { x: i.a }).out;
            one ^ m.instance("u_two", &Rom(&[1, 3]), Link { x: i.a }).out
        },
        "two different blocks print as `Rom { words: 2 }` and are both called `rom_words2` [T405]
         --> [one ^ m.instance(\"u_two\", &Rom(&[1, 3]), Link { x: i.a }).out]
         `Rom { words: 2 }` is described at [Out { out: case(i.x, (0..).zip(self.0.iter().map(|word| lit(8, *word))), 0) }]
         the other one is instantiated at [let one = m.instance(\"u_one\", &Rom(&[1, 2]), Link { x: i.a }).out;]
         the other one is described at [Out { out: case(i.x, (0..).zip(self.0.iter().map(|word| lit(8, *word))), 0) }]
         help: distinguish them by `name(self) = ..` in `block!`, or in the block's `Debug` text",
    );
    let same = elaborate(&Case(|m, i| {
        let one = m.instance("u_one", &Rom(&[1, 2]), Link { x: i.a }).out;
        one ^ m.instance("u_two", &Rom(&[1, 2]), Link { x: i.a }).out
    }));
    assert_eq!(same.unwrap().modules().len(), 2);
}
