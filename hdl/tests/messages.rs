//! Every message that a mistake in a description can give, with the user's own lines that it names.
//!
//! In the expected texts a place stands as the source line it points to, so that they survive edits of this file.

use tilewright_hdl::*;

bundle! {
    struct In<T> { a: T, b: T, c: T }
    struct Out<T> { out: T }
}

/// Describes the one output of a [`Case`].
type Build = fn(Module, In) -> Signal;

/// A block of three inputs (8, 7 and 1 bits), described by a function.
struct Case(Build);

impl std::fmt::Debug for Case {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        write!(f, "Case {{ at: {} }}", self.0 as usize)
    }
}

impl Block for Case {
    type In = In;
    type Out = Out;

    fn inputs(&self) -> In<Width> {
        In { a: bits(8), b: bits(7), c: bit() }
    }

    fn build(&self, m: Module, i: In) -> Out {
        m.ignore(&i);
        Out { out: (self.0)(m, i) }
    }

    fn name(&self) -> String {
        "case_block".to_owned()
    }
}

/// The problems as text, each place replaced by the line it points to.
fn problems<B: Block>(block: &B) -> String {
    let text = elaborate(block).expect_err("the description is wrong").to_string();
    let source: Vec<_> = include_str!("messages.rs").lines().collect();
    let place = |line: &str| {
        let (before, after) = line.split_once("hdl/tests/messages.rs:")?;
        let number: usize = after.split(':').next()?.parse().ok()?;
        Some(format!("{before}[{}]", source[number - 1].trim()))
    };
    text.lines().map(|line| place(line).unwrap_or(line.to_owned())).collect::<Vec<_>>().join("\n")
}

#[track_caller]
fn expect(build: Build, expected: &str) {
    let lines: Vec<_> = expected.lines().map(str::trim_start).collect();
    let found = problems(&Case(build));
    let found: Vec<_> = found.lines().map(str::trim_start).collect();
    assert_eq!(found.join("\n"), lines.join("\n").trim());
}

#[test]
fn widths_that_differ() {
    expect(
        |_, i| i.a + i.b,
        "`+` needs equal widths: `a` has 8 bits, `b` has 7 bits
         --> [|_, i| i.a + i.b,]
         `a` is made at [In { a: bits(8), b: bits(7), c: bit() }]
         `b` is made at [In { a: bits(8), b: bits(7), c: bit() }]
         help: widen the narrow side with `.zext(8)` or `.sext(8)`, or cut the wide one with `.trunc(7)`",
    );
}

#[test]
fn operands_that_are_expressions_are_shown() {
    expect(
        |_, i| (i.a & !i.a).eq(cat![i.b, i.c].slice(1..8)),
        "`eq` needs equal widths: `a & !a` has 8 bits, `cat![b, c].slice(1..8)` has 7 bits
         --> [|_, i| (i.a & !i.a).eq(cat![i.b, i.c].slice(1..8)),]
         `a & !a` is made at [|_, i| (i.a & !i.a).eq(cat![i.b, i.c].slice(1..8)),]
         `cat![b, c].slice(1..8)` is made at [|_, i| (i.a & !i.a).eq(cat![i.b, i.c].slice(1..8)),]
         help: widen the narrow side with `.zext(8)` or `.sext(8)`, or cut the wide one with `.trunc(7)`",
    );
}

/// Widths meet in every operator, choice and sink, and the message names which.
#[test]
fn every_meeting_of_widths_is_checked() {
    let cases: [(Build, &str); 13] = [
        (|_, i| i.a - i.b, "`-`"),
        (|_, i| i.a & i.b, "`&`"),
        (|_, i| i.a | i.b, "`|`"),
        (|_, i| i.a ^ i.b, "`^`"),
        (|_, i| i.a.lt(i.b), "`lt`"),
        (|_, i| i.a.add_carry(i.b), "`add_carry`"),
        (|_, i| (i.a.signed() + i.b.signed()).bits(), "`+`"),
        (|_, i| i.a.signed().ge(i.b.signed()), "`ge`"),
        (|_, i| mux(i.c, i.a, i.b), "`mux`"),
        (|_, i| select([(i.c, i.a)], i.b), "`select`"),
        (|_, i| case(i.c, [(1, i.a)], i.b), "`case`"),
        (
            |m, i| {
                let r = m.reg("r", 8);
                r.next(i.b);
                r.value()
            },
            "`next`",
        ),
        (
            |m, i| {
                let w = m.wire("w", 8);
                w.drive(i.b);
                w.value()
            },
            "`drive`",
        ),
    ];
    for (build, operator) in cases {
        let text = problems(&Case(build));
        assert!(text.starts_with(&format!("{operator} needs equal widths:")), "{text}");
        let place = text.lines().find(|line| line.starts_with("  --> ")).expect("a message has a place");
        assert!(place.starts_with("  --> ["), "the place is not the user's: {text}");
    }
}

#[test]
fn choices_between_bundles_name_the_users_line() {
    let text = problems(&Case(|_, i| mux_bundle(i.c, &Out { out: i.a }, &Out { out: i.b }).out));
    assert!(text.contains("`mux` needs equal widths") && !text.contains("select.rs"), "{text}");
    let text = problems(&Case(|_, i| select([(i.a, i.a)], i.a)));
    assert!(text.contains("the condition of `select` is 1 bit") && !text.contains("select.rs"), "{text}");
}

/// Also where the language calls itself in a closure, which is its own caller.
#[test]
fn messages_from_closures_name_the_users_line() {
    let cases: [(&str, Build); 5] = [
        ("the condition of `enable`", |m, i| m.pipe_when(i.a, "p", i.a)),
        ("`300` does not fit", |m, _| {
            let block = Inverter { registered: true };
            m.array("u_cell", 2, &block, |a| Link { x: a.constants(8, |_| 300) }).out.last()
        }),
        ("`2` does not fit", |m, _| m.fsm("lamp", Lamp::Off).constants(1, |_| 2)),
        ("`case` needs", |m, i| m.fsm("lamp", Lamp::Off).pick(|lamp| if lamp == Lamp::Off { i.a } else { i.b })),
        ("the condition of `select`", |m, i| {
            let lamp = m.fsm("lamp", Lamp::Off);
            lamp.next(|_| when(i.a, Lamp::On));
            lamp.value()
        }),
    ];
    for (message, build) in cases {
        let text = problems(&Case(build));
        let (first, place) = text.split_once("\n  --> ").expect("a message has a place");
        assert!(first.starts_with(message) && place.starts_with('['), "{text}");
    }
}

#[test]
fn nothing_is_wider_than_a_million_bits() {
    let text = problems(&Case(|_, i| i.a.repeat(600_000_000)));
    assert!(text.starts_with("`.repeat(600000000)` makes more than 1048576 bits of `a`"), "{text}");
    let text = problems(&Case(|_, i| i.a.zext(600_000_000)));
    assert!(text.starts_with("`.zext(600000000)` makes more than 1048576 bits of `a`"), "{text}");
    elaborate(&Case(|_, i| concat(&[i.a.repeat(131_071), i.a]))).expect("a million bits are allowed");
    expect(
        |_, i| concat(&[i.a.repeat(131_071), i.a, i.b]),
        "a concatenation of 1048583 bits is wider than 1048576
         --> [|_, i| concat(&[i.a.repeat(131_071), i.a, i.b]),]
         help: keep wide data in a memory",
    );
    // As many bits as would overflow a `u32`.
    let text = problems(&Case(|_, i| concat(&[i.a.repeat(131_072); 4097])));
    assert!(text.starts_with("a concatenation of 4296015872 bits is wider than 1048576"), "{text}");
}

#[test]
fn literals_that_do_not_fit() {
    expect(
        |_, i| i.b + 128,
        "`128` does not fit in 7 bits, unsigned
         --> [|_, i| i.b + 128,]
         help: an integer takes the width of the signal it meets",
    );
    expect(
        |_, i| i.b.signed().lt(64),
        "`64` does not fit in 7 bits, signed
         --> [|_, i| i.b.signed().lt(64),]
         help: an integer takes the width of the signal it meets",
    );
    assert!(problems(&Case(|_, i| i.a + -1)).starts_with("`-1` does not fit in 8 bits, unsigned"));
    assert!(problems(&Case(|_, i| i.a & Bits::new(7, 1))).starts_with("`7'h01` does not fit in 8 bits"));
    elaborate(&Case(|_, i| i.a.signed().lt(-128))).expect("-128 is an 8-bit number");
}

#[test]
fn slices_and_changes_of_width() {
    expect(
        |_, i| i.a.slice(4..9),
        "the slice 4..9 is outside of `a`, which has 8 bits
         --> [|_, i| i.a.slice(4..9),]
         `a` is made at [In { a: bits(8), b: bits(7), c: bit() }]
         help: a slice is `low..high` with low < high <= 8",
    );
    assert!(problems(&Case(|_, i| i.a.trunc(9))).starts_with("`.trunc(9)` cannot cut `a`, which has 8 bits"));
    assert!(problems(&Case(|_, i| i.a.zext(7))).starts_with("`.zext(7)` cannot widen `a`, which has 8 bits"));
    assert!(problems(&Case(|_, i| i.a.sext(7))).starts_with("`.sext(7)` cannot widen `a`, which has 8 bits"));
    assert!(problems(&Case(|_, i| i.c.repeat(0))).starts_with("`.repeat(0)` leaves nothing of `c`, which has 1 bit"));
}

#[test]
fn conditions_of_more_than_one_bit() {
    expect(
        |_, i| mux(i.a, i.b, i.b),
        "the condition of `mux` is 1 bit, but `a` has 8 bits
         --> [|_, i| mux(i.a, i.b, i.b),]
         `a` is made at [In { a: bits(8), b: bits(7), c: bit() }]
         help: compare it, as in `.ne(0)`, or take one `.bit(i)`",
    );
}

#[test]
fn choices_that_leave_something_open() {
    expect(
        |_, i| mux(i.c, 1, 0),
        "`mux` has only integers to choose from, which leaves its width open
         --> [|_, i| mux(i.c, 1, 0),]
         help: give one a width, as in `lit(8, 1)`",
    );
    assert!(problems(&Case(|_, i| case(i.c, [(2, i.a)], 0))).starts_with("the key 2 of `case` does not fit in 1 bit"));
    assert!(problems(&Case(|_, i| case(i.a, [(2, i.a), (2, i.a)], 0))).starts_with("the key 2 of `case` stands twice"));
}

#[test]
fn registers_and_wires_that_nothing_drives() {
    expect(
        |m, _| {
            let _lonely = m.reg("lonely", 3).reset(0);
            *m.wire("open", 2)
        },
        "register `lonely` of `Case` is never driven
         --> [let _lonely = m.reg(\"lonely\", 3).reset(0);]
         help: say what it takes at the next edge with `.next(value)`

         wire `open` of `Case` is never driven
         --> [*m.wire(\"open\", 2)]
         help: say what drives it with `.drive(value)`

         2 problems in this description",
    );
}

#[test]
fn registers_and_wires_that_are_driven_twice() {
    expect(
        |m, i| {
            let r = m.reg("r", 8);
            r.next(i.a);
            r.next(0);
            r.value()
        },
        "`r` is given a next value twice
         --> [r.next(0);]
         the first time is at [r.next(i.a);]
         `r` is declared at [let r = m.reg(\"r\", 8);]
         help: choose between the two with `mux` or `select`",
    );
    let enabled = |m: Module, i: In| {
        let r = m.reg("r", 8).enable(i.c).enable(!i.c);
        r.next(i.a);
        r.value()
    };
    assert!(problems(&Case(enabled)).starts_with("`r` is enabled twice"));
    let driven = |m: Module, i: In| {
        let w = m.wire("w", 8);
        w.drive(i.a);
        w.drive(i.a);
        w.value()
    };
    assert!(problems(&Case(driven)).starts_with("`w` is driven twice"));
}

states! { enum Lamp { Off, On } }

#[test]
fn handles_give_their_values_as_signals() {
    let build = |m: Module, i: In| {
        let (register, wire, lamp) = (m.reg("r", 8), m.wire("w", 8), m.fsm("lamp", Lamp::Off));
        register.next(i.a);
        wire.drive(i.a);
        lamp.next(|lamp| match lamp {
            Lamp::Off => when(i.c, Lamp::On),
            Lamp::On => goto(Lamp::Off),
        });
        let values: [Signal; 3] = [register.value(), wire.value(), lamp.value()];
        concat(&values).trunc(8)
    };
    elaborate(&Case(build)).unwrap();
}

#[test]
fn reset_values_that_are_not_constants() {
    let build = |m: Module, i: In| {
        let r = m.reg("r", 8).reset(i.a);
        r.next(i.a);
        r.value()
    };
    expect(
        build,
        "the reset value of `r` is not a constant of 8 bits
         --> [let r = m.reg(\"r\", 8).reset(i.a);]
         help: a reset value is a number known while the block is built",
    );
}

#[test]
fn names_that_clash_or_are_illegal() {
    expect(
        |_, i| (i.a.named("sum") + 1).named("sum"),
        "net `sum` has the name of another net
         --> [|_, i| (i.a.named(\"sum\") + 1).named(\"sum\"),]
         the other net `sum` is declared at [|_, i| (i.a.named(\"sum\") + 1).named(\"sum\"),]
         help: rename one of them",
    );
    assert!(problems(&Case(|_, i| (!i.a).named("b"))).starts_with("net `b` has the name of another input"));
    assert!(problems(&Case(|_, i| (!i.a).named("two words"))).starts_with("`two words` cannot be the name of a net"));
}

bundle! {
    struct Reserved<T> { table: T }
}

/// Drives its one output by its one input.
#[derive(Debug)]
struct Through;

impl Block for Through {
    type In = Reserved;
    type Out = Out;

    fn inputs(&self) -> Reserved<Width> {
        Reserved { table: bits(4) }
    }

    fn build(&self, _: Module, i: Reserved) -> Out {
        Out { out: i.table + 1 }
    }
}

#[test]
fn ports_with_reserved_names() {
    assert_eq!(
        problems(&Through),
        "input `table` has a reserved word of Verilog for a name\n  --> [Reserved { table: bits(4) }]\n  help: call it `table_` or something else"
    );
}

#[test]
fn ports_with_names_reserved_in_cpp() {
    bundle! { struct Distance<T> { near: T } }
    /// Has a port that Verilator refuses.
    #[derive(Debug)]
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
    assert!(problems(&Near).starts_with("input `near` has a reserved word of C++ for a name"));
}

#[test]
fn instances_that_hide_something() {
    expect(
        |m, i| m.instance("y", &Inverter { registered: true }, Link { x: i.a }).out,
        "instance `y` has the name of something inside of it
         --> [|m, i| m.instance(\"y\", &Inverter { registered: true }, Link { x: i.a }).out,]
         the inner `y` is declared at [Out { out: if self.registered { m.pipe(\"y\", !i.x) } else { !i.x } }]
         help: call the instance `u_y`",
    );
    /// Has a register called as every lane is.
    #[derive(Debug)]
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
    let text = problems(&Case(|m, i| m.array("u_street", 2, &Street, |a| Link { x: a.all(&i.a) }).out.last()));
    assert!(text.starts_with("the lanes of `u_street` hold something called `lane`"), "{text}");
}

#[test]
fn inner_names_that_are_reserved_get_an_underscore() {
    let design = elaborate(&Case(|_, i| (!i.a).named("cell"))).unwrap();
    assert!(design.top().nodes.iter().any(|node| node.name.as_deref() == Some("cell_")));
}

#[test]
fn combinational_loops_name_every_hop() {
    expect(
        |m, i| {
            let w = m.wire("w", 8);
            let once = (*w + i.a).named("once");
            w.drive(once ^ 1);
            once
        },
        "a combinational loop in `Case`: `w` -> `once` -> `once ^ 1` -> `w`
         --> [let w = m.wire(\"w\", 8);]
         `w` is computed at [let w = m.wire(\"w\", 8);]
         `once` is computed at [let once = (*w + i.a).named(\"once\");]
         `once ^ 1` is computed at [w.drive(once ^ 1);]
         help: put a register into the loop, or break it where a value does not depend on the others",
    );
}

bundle! {
    struct Link<T> { x: T }
}

/// Passes its input on, inverted, in the same cycle or the next.
#[derive(Debug)]
struct Inverter {
    registered: bool,
}

impl Block for Inverter {
    type In = Link;
    type Out = Out;

    fn inputs(&self) -> Link<Width> {
        Link { x: bits(8) }
    }

    fn build(&self, m: Module, i: Link) -> Out {
        Out { out: if self.registered { m.pipe("y", !i.x) } else { !i.x } }
    }
}

#[test]
fn loops_through_instances_are_found_and_registers_break_them() {
    let text = problems(&Case(|m, _| {
        let w = m.wire("w", 8);
        let back = m.instance("u_inverter", &Inverter { registered: false }, Link { x: *w }).out;
        w.drive(back);
        back
    }));
    assert!(text.starts_with("a combinational loop in `Case`: `w` -> `u_inverter.out` -> `w`"), "{text}");
    elaborate(&Case(|m, _| {
        let w = m.wire("w", 8);
        w.drive(m.instance("u_inverter", &Inverter { registered: true }, Link { x: *w }).out);
        *w
    }))
    .expect("a register breaks the loop");
}

#[test]
fn a_chain_of_lanes_is_no_loop_but_a_ring_is() {
    let chain = |m: Module, i: In| {
        m.array("u_cell", 4, &Inverter { registered: false }, |cells| Link { x: cells.out.out.previous(i.a) })
            .out
            .last()
    };
    elaborate(&Case(chain)).expect("lane 0 starts the chain");
    let text = problems(&Case(|m, _| {
        let w = m.wire("w", 8);
        let cells =
            m.array("u_cell", 3, &Inverter { registered: false }, |cells| Link { x: cells.out.out.previous(*w) });
        w.drive(cells.out.last());
        *w
    }));
    assert!(text.starts_with("a combinational loop in `Case`: "), "{text}");
    for lane in ["`u_cell.out[0]`", "`u_cell.out[1]`", "`u_cell.out[2]`", "`w`"] {
        assert!(text.lines().next().unwrap().contains(lane), "{lane} is missing in {text}");
    }
}

/// Leaves an input unused.
#[derive(Debug)]
struct Careless;

impl Block for Careless {
    type In = In;
    type Out = Out;

    fn inputs(&self) -> In<Width> {
        In { a: bits(8), b: bits(7), c: bit() }
    }

    fn build(&self, m: Module, i: In) -> Out {
        m.ignore(&i.c);
        Out { out: i.a }
    }
}

/// A fault gives no second message that calls its operands unused.
#[test]
fn inputs_in_faulty_expressions_are_used() {
    /// As [`Case`], but nothing is said of unused inputs.
    #[derive(Debug)]
    struct Strict(Build);
    impl Block for Strict {
        type In = In;
        type Out = Out;
        fn inputs(&self) -> In<Width> {
            In { a: bits(8), b: bits(7), c: bit() }
        }
        fn build(&self, m: Module, i: In) -> Out {
            Out { out: (self.0)(m, i) }
        }
        fn name(&self) -> String {
            "strict".to_owned()
        }
    }
    let cases: [(&str, Build); 9] = [
        ("`+` needs", |_, i| (i.a + i.b) ^ i.c.zext(8)),
        ("the slice", |_, i| i.a.slice(8..9) & i.b.bit(0) & i.c),
        ("the condition", |_, i| mux(i.a, i.b, i.c.zext(7))),
        ("the reset value", |m, i| {
            let r = m.reg("r", 8).reset(i.a);
            r.next(cat![i.b, i.c]);
            r.value()
        }),
        ("`r` is given a next value twice", |m, i| {
            let r = m.reg("r", 8);
            r.next(i.a);
            r.next(cat![i.b, i.c]);
            r.value()
        }),
        ("an address", |m, i| {
            let words = m.memory("words", 16, 1, ReadUnderWrite::Old);
            words.write(i.c, i.a, i.b);
            words.read(0)
        }),
        ("input `x` of `u_inverter`", |m, i| {
            m.instance("u_inverter", &Inverter { registered: true }, Link { x: i.b }).out + cat![i.a, i.c].trunc(8)
        }),
        ("an array of 3 lanes", |m, i| {
            let inverter = Inverter { registered: true };
            let cells = m.array("u_cell", 3, &inverter, |cells| Link { x: cells.each([i.a, i.b.zext(8)]) });
            mux(i.c, cells.out.last(), 0)
        }),
        ("`a` belongs to `Strict`", |m, i| {
            KEPT.set(Some(Kept::Result(i.a)));
            m.instance("u_keeper", &Keeper, ()).out & cat![i.b, i.c]
        }),
    ];
    for (message, build) in cases {
        let text = problems(&Strict(build));
        assert!(text.starts_with(message) && !text.contains("never used"), "{text}");
    }
}

#[test]
fn inputs_that_are_not_used() {
    assert_eq!(
        problems(&Careless),
        "input `b` of `Careless` is never used\n  --> [In { a: bits(8), b: bits(7), c: bit() }]\n  help: remove it, or say `m.ignore(&i.b)` if that is meant"
    );
}

const FAST: Clock = Clock::new("fast", Period::ns(4));

#[test]
fn paths_between_clocks_need_a_crossing() {
    expect(
        |m, i| {
            let slow = m.pipe("slow", i.a);
            m.on(FAST).pipe("fast", slow)
        },
        "`slow` is on clock `clk` but reaches register `fast` on clock `fast` without a crossing
         --> [m.on(FAST).pipe(\"fast\", slow)]
         `slow` is declared at [let slow = m.pipe(\"slow\", i.a);]
         help: cross with `m.synchronize`, a memory with a port on each clock, or `.quasi_static(reason)`; an input of another clock is declared `bits(n).on(clock)`",
    );
}

#[test]
fn declared_crossings_are_fine() {
    let crossed = |m: Module, i: In| {
        let fast = m.on(FAST);
        let flag = fast.synchronize("flag", m.pipe("slow_flag", i.c));
        let words = m.memory("words", 256, 8, ReadUnderWrite::Old);
        words.write(i.c, i.a, i.a);
        let word = words.on(FAST).read(fast.pipe("address", i.a.quasi_static("the address is held during a read")));
        fast.pipe("both", mux(flag, word, 0))
    };
    elaborate(&Case(crossed)).unwrap();
}

#[test]
fn a_child_may_declare_the_crossing() {
    /// Hands on an input of another clock as stable.
    #[derive(Debug)]
    struct Held;
    impl Block for Held {
        type In = Link;
        type Out = Out;
        fn inputs(&self) -> Link<Width> {
            Link { x: bits(8).on(FAST) }
        }
        fn build(&self, _: Module, i: Link) -> Out {
            Out { out: i.x.quasi_static("written before the start") }
        }
    }
    elaborate(&Case(|m, i| {
        m.ignore(&i);
        let fast = m.on(FAST).pipe("fast", lit(8, 1));
        m.pipe("slow", m.instance("u_held", &Held, Link { x: fast }).out)
    }))
    .unwrap();
}

bundle! {
    struct Pair<T> { left: T, right: T }
}

/// A block of two named clocks and none of its own, described by a function.
#[derive(Debug)]
struct TwoClocks {
    inputs: fn() -> Link<Width>,
    build: fn(Module, Module, Signal) -> (Signal, Signal),
}

impl Block for TwoClocks {
    type In = Link;
    type Out = Pair;

    fn inputs(&self) -> Link<Width> {
        (self.inputs)()
    }

    fn build(&self, m: Module, i: Link) -> Pair {
        m.ignore(&i);
        let (left, right) = (self.build)(m.on(FAST), m.on(SLOW), i.x);
        Pair { left, right }
    }

    fn name(&self) -> String {
        "two_clocks".to_owned()
    }
}

const SLOW: Clock = Clock::new("slow", Period::ns(6));

#[test]
fn inputs_of_a_block_without_a_clock_of_its_own_name_theirs() {
    let build = |fast: Module, slow: Module, x: Signal| (fast.pipe("r", x), slow.pipe("s", !x));
    assert_eq!(
        problems(&TwoClocks { inputs: || Link { x: bits(8) }, build }),
        "input `x` of `TwoClocks` does not say on which clock it is: `fast` or `slow`
  --> [problems(&TwoClocks { inputs: || Link { x: bits(8) }, build }),]
  register `r` on clock `fast` takes it at [let build = |fast: Module, slow: Module, x: Signal| (fast.pipe(\"r\", x), slow.pipe(\"s\", !x));]
  help: declare it as `bits(n).on(clock)`; only a block with a clock of its own may leave that out"
    );
    let text = problems(&TwoClocks { inputs: || Link { x: bits(8).on(FAST) }, build });
    assert!(text.starts_with("`x` is on clock `fast` but reaches register `s` on clock `slow`"), "{text}");
    // What is sampled by no clock, or may be by any, needs none.
    let crossed = |fast: Module, slow: Module, x: Signal| {
        let flag = slow.synchronize("flag", x.bit(0));
        (fast.pipe("r", x.quasi_static("held")), slow.pipe("s", x.quasi_static("held")) + flag.zext(8))
    };
    elaborate(&TwoClocks { inputs: || Link { x: bits(8) }, build: crossed }).unwrap();
    let through = |fast: Module, slow: Module, x: Signal| (fast.pipe("r", lit(8, 1)), slow.pipe("s", lit(8, 1)) ^ x);
    elaborate(&TwoClocks { inputs: || Link { x: bits(8) }, build: through }).unwrap();
}

#[test]
fn outputs_that_mix_clocks() {
    let mixed = |fast: Module, slow: Module, x: Signal| {
        let r = fast.pipe("r", x);
        let s = slow.pipe("s", lit(8, 1));
        (r + s, s)
    };
    let block = TwoClocks { inputs: || Link { x: bits(8).on(FAST) }, build: mixed };
    assert_eq!(
        problems(&block),
        "output `left` of `TwoClocks` mixes clocks `fast` and `slow`
  --> [(r + s, s)]
  `r`, on clock `fast`, is declared at [let r = fast.pipe(\"r\", x);]
  `s`, on clock `slow`, is declared at [let s = slow.pipe(\"s\", lit(8, 1));]
  help: give each clock an output of its own, or cross with `m.synchronize` or `.quasi_static(reason)` before"
    );
    // A parent that passes it on, or takes it, says nothing more.
    let parent = |m: Module, _: In| {
        let mixed =
            |fast: Module, slow: Module, _: Signal| (fast.pipe("r", lit(8, 1)) + slow.pipe("s", lit(8, 1)), lit(8, 0));
        let block = TwoClocks { inputs: || Link { x: bits(8) }, build: mixed };
        let out = m.instance("u_two", &block, Link { x: lit(8, 0) });
        let _ = m.on(FAST).pipe("taken", out.left);
        out.left
    };
    let text = problems(&Case(parent));
    assert!(text.starts_with("output `left` of `TwoClocks` mixes") && !text.contains("problems"), "{text}");
}

#[test]
fn logic_that_enters_a_synchronizer() {
    expect(
        |m, i| {
            let r = m.pipe("r", i.a);
            m.on(FAST).synchronize("flag", r.eq(3)).zext(8)
        },
        "`r.eq(3)` enters synchronizer `flag` but is logic, which glitches
         --> [m.on(FAST).synchronize(\"flag\", r.eq(3)).zext(8)]
         `r.eq(3)` is made at [m.on(FAST).synchronize(\"flag\", r.eq(3)).zext(8)]
         help: put a register on its own clock before the synchronizer, as in `m.pipe(name, value)`",
    );
    // Wiring and an inverter do no harm.
    elaborate(&Case(|m, i| {
        let wire = m.wire("w", 8);
        let cells = m.array("u_cell", 2, &Inverter { registered: true }, |cells| Link { x: cells.all(&i.a) });
        wire.drive(cat![m.pipe("r", i.b), i.c]);
        let fast = m.on(FAST);
        fast.synchronize("one", !wire.bit(2)).zext(8) ^ fast.synchronize("two", cells.out.lane(1).bit(0)).zext(8)
    }))
    .unwrap();
}

#[test]
fn logic_that_enters_a_synchronizer_in_an_instance_or_comes_from_one() {
    let inside = problems(&Case(|m, i| {
        let build = |fast: Module, _: Module, x: Signal| (fast.synchronize("flag", x.bit(0)), lit(1, 0));
        let block = TwoClocks { inputs: || Link { x: bits(8) }, build };
        m.instance("u_two", &block, Link { x: i.a + 1 }).left.zext(8)
    }));
    assert!(inside.starts_with("`a + 1` enters synchronizer `u_two.flag` but is logic"), "{inside}");
    let build = |m: Module, i: In| {
        /// Compares in the same clock.
        #[derive(Debug)]
        struct IsZero;
        impl Block for IsZero {
            type In = Link;
            type Out = Out;
            fn inputs(&self) -> Link<Width> {
                Link { x: bits(8) }
            }
            fn build(&self, _: Module, i: Link) -> Out {
                Out { out: i.x.eq(0) }
            }
        }
        let zero = m.instance("u_zero", &IsZero, Link { x: m.pipe("r", i.a) }).out;
        m.on(FAST).synchronize("flag", zero).zext(8)
    };
    let text = problems(&Case(build));
    assert!(text.starts_with("`u_zero.out` enters synchronizer `flag` but is logic"), "{text}");
}

#[test]
fn synchronizers_take_one_bit() {
    let text = problems(&Case(|m, i| m.on(FAST).synchronize("flag", i.a).zext(8)));
    assert!(text.starts_with("the condition of `synchronize` is 1 bit, but `a` has 8 bits"), "{text}");
    assert!(!text.contains("problems in this"), "{text}");
}

#[test]
fn an_instance_is_fed_on_its_own_clock() {
    let text = problems(&Case(|m, i| {
        let slow = m.pipe("slow", i.a);
        m.on(FAST).instance("u_inverter", &Inverter { registered: true }, Link { x: slow }).out
    }));
    let message = "`slow` is on clock `clk` but reaches input `x` of `u_inverter` on clock `fast` without a crossing";
    assert!(text.starts_with(message), "{text}");
}

#[test]
fn a_clock_has_one_period() {
    const OTHER: Clock = Clock::new("fast", Period::ns(6));
    /// Takes a clock as a parameter.
    #[derive(Debug)]
    struct Timed(Clock);
    impl Block for Timed {
        type In = Link;
        type Out = Out;
        fn inputs(&self) -> Link<Width> {
            Link { x: bits(8).on(self.0) }
        }
        fn build(&self, m: Module, i: Link) -> Out {
            Out { out: m.on(self.0).pipe("y", i.x) }
        }
        fn name(&self) -> String {
            format!("timed_{}", self.0.period.picoseconds())
        }
    }
    let text = problems(&Case(|m, _| {
        let one = m.instance("u_one", &Timed(FAST), Link { x: lit(8, 1) }).out;
        m.instance("u_two", &Timed(OTHER), Link { x: lit(8, 1) }).out & one
    }));
    let places = [
        "clock `fast` has a period of 6 ns here and of 4 ns elsewhere",
        "  --> [Link { x: bits(8).on(self.0) }]",
        "  `fast` is first used at [Link { x: bits(8).on(self.0) }]",
        "  help: a clock has one period in the whole design",
    ];
    assert!(text.starts_with(&places.join("\n")), "{text}");
}

#[test]
fn signals_of_another_module() {
    use std::cell::Cell;
    thread_local!(static LEAKED: Cell<Option<Signal>> = const { Cell::new(None) });
    /// Uses a signal of the module that instantiates it.
    #[derive(Debug)]
    struct Thief;
    impl Block for Thief {
        type In = ();
        type Out = Out;
        fn inputs(&self) {}
        fn build(&self, _: Module, _: ()) -> Out {
            Out { out: LEAKED.get().unwrap() + 1 }
        }
    }
    expect(
        |m, i| {
            LEAKED.set(Some(i.a));
            m.instance("u_thief", &Thief, ()).out
        },
        "`a` belongs to `Case` but is used inside of `Thief`
         --> [Out { out: LEAKED.get().unwrap() + 1 }]
         `a` is made at [In { a: bits(8), b: bits(7), c: bit() }]
         help: give the block an input for it",
    );
}

#[test]
#[should_panic(expected = "a signal of an earlier elaboration is used")]
fn signals_of_an_earlier_elaboration() {
    use std::cell::Cell;
    thread_local!(static LEAKED: Cell<Option<Signal>> = const { Cell::new(None) });
    let build = |_: Module, i: In| {
        let before = LEAKED.replace(Some(i.a));
        before.map_or(i.a, |leaked| leaked + i.a)
    };
    let _ = elaborate(&Case(build));
    let _ = elaborate(&Case(build));
}

#[test]
#[should_panic(expected = "signals exist only while a block is built")]
fn signals_outside_of_elaboration() {
    let _ = lit(8, 1);
}

#[test]
#[should_panic(expected = "use `m.instance` there")]
fn elaboration_inside_a_description() {
    let _ = elaborate(&Case(|_, i| {
        let _ = elaborate(&Through);
        i.a
    }));
}

#[test]
fn a_panic_in_a_description_leaves_nothing_behind() {
    let panicking = Case(|_, _| panic!("the user's own"));
    assert!(std::panic::catch_unwind(|| elaborate(&panicking)).is_err());
    elaborate(&Case(|_, i| i.a)).expect("the arena was cleared");
}

#[test]
#[should_panic(expected = "does it instantiate itself?")]
fn blocks_that_instantiate_themselves() {
    /// Has an endless inside.
    #[derive(Debug)]
    struct Doll(u32);
    impl Block for Doll {
        type In = ();
        type Out = Out;
        fn inputs(&self) {}
        fn build(&self, m: Module, _: ()) -> Out {
            m.instance("u_doll", &Doll(self.0 + 1), ())
        }
    }
    let _ = elaborate(&Doll(0));
}

#[test]
fn instances_fed_with_another_width() {
    expect(
        |m, i| m.instance("u_inverter", &Inverter { registered: true }, Link { x: i.b }).out,
        "input `x` of `u_inverter` has 8 bits, but `b` has 7 bits
         --> [|m, i| m.instance(\"u_inverter\", &Inverter { registered: true }, Link { x: i.b }).out,]
         `x` is declared at [Link { x: bits(8) }]
         `b` is made at [In { a: bits(8), b: bits(7), c: bit() }]
         help: spell the change of width where the instance is fed",
    );
}

#[test]
fn arrays_fed_with_the_wrong_number_of_lanes() {
    expect(
        |m, i| {
            let cells = m.array("u_cell", 3, &Inverter { registered: true }, |cells| Link { x: cells.each([i.a, i.a]) });
            cells.out.lane(3)
        },
        "an array of 3 lanes is fed 2 signals
         --> [let cells = m.array(\"u_cell\", 3, &Inverter { registered: true }, |cells| Link { x: cells.each([i.a, i.a]) });]
         help: give one signal for each lane, all of one width

         lane 3 of an array of 3 lanes
         --> [cells.out.lane(3)]
         help: lanes count from 0

         2 problems in this description",
    );
    let empty = |m: Module, i: In| {
        m.array("u_cell", 0, &Inverter { registered: true }, |cells| Link { x: cells.all(&i.a) }).out.lane(0)
    };
    assert!(problems(&Case(empty)).starts_with("the array `u_cell` has no lanes"));
}

#[test]
fn memories() {
    expect(
        |m, i| {
            let words = m.memory("words", 256, 8, ReadUnderWrite::Old);
            words.write(i.c, i.a, i.a);
            words.write(!i.c, i.a, 0);
            words.read(i.a)
        },
        "memory `words` gets a second write port
         --> [words.write(!i.c, i.a, 0);]
         `words` is declared at [let words = m.memory(\"words\", 256, 8, ReadUnderWrite::Old);]
         help: share one port with `mux`, or say `.true_dual_port()` if the target has such memories",
    );
    let long = |m: Module, i: In| {
        m.memory("words", 2, 8, ReadUnderWrite::Old)
            .words([Bits::new(8, 1), Bits::new(8, 2), Bits::new(8, 3)])
            .read(i.c)
    };
    assert!(problems(&Case(long)).starts_with("memory `words` has 2 words, but its contents have 3"));
    let wide = |m: Module, i: In| m.memory("words", 2, 8, ReadUnderWrite::Old).fill(Bits::new(9, 1)).read(i.c);
    assert!(problems(&Case(wide)).starts_with("memory `words` is 8 bits wide, but word 0 of its contents has 9"));
    let empty = |m: Module, i: In| m.memory("words", 0, 8, ReadUnderWrite::Old).read(i.c);
    assert!(problems(&Case(empty)).starts_with("memory `words` of 0 words of 8 bits holds nothing"));
}

#[test]
fn widths_that_do_not_fit_a_memory() {
    expect(
        |m, i| m.memory("words", 100, 8, ReadUnderWrite::Old).read(i.a),
        "an address of memory `words` has 7 bits, but `a` has 8 bits
         --> [|m, i| m.memory(\"words\", 100, 8, ReadUnderWrite::Old).read(i.a),]
         `words` is declared at [|m, i| m.memory(\"words\", 100, 8, ReadUnderWrite::Old).read(i.a),]
         `a` is made at [In { a: bits(8), b: bits(7), c: bit() }]
         help: cut it with `.trunc(7)`",
    );
    expect(
        |m, i| {
            let words = m.memory("words", 256, 8, ReadUnderWrite::Old);
            words.write(i.c, i.a, i.b);
            words.read_async(i.a)
        },
        "a word of memory `words` has 8 bits, but `b` has 7 bits
         --> [words.write(i.c, i.a, i.b);]
         `words` is declared at [let words = m.memory(\"words\", 256, 8, ReadUnderWrite::Old);]
         `b` is made at [In { a: bits(8), b: bits(7), c: bit() }]
         help: widen it with `.zext(8)` or `.sext(8)`",
    );
}

#[test]
fn modules_of_one_name_and_different_contents() {
    /// Named alike whatever its parameter.
    #[derive(Debug)]
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
    assert!(text.starts_with("`Twin(7)` and `Twin(8)` are both called `twin`"), "{text}");
}

#[test]
#[should_panic(expected = "a concatenation of nothing")]
fn concatenations_of_nothing() {
    let _ = elaborate(&Case(|_, _| concat(&[])));
}

#[test]
#[should_panic(expected = "a shift by -1 bits: an amount is 0 or more")]
fn shifts_by_less_than_nothing() {
    let _ = elaborate(&Case(|_, i| i.a << -1));
}

#[test]
#[should_panic(expected = "a clock period is an even number of picoseconds above 0")]
fn periods_that_have_no_half() {
    let _ = Period::ps(3);
}

#[test]
#[should_panic(expected = "an array is fed nothing")]
fn arrays_fed_with_nothing() {
    let _ = elaborate(&Case(|m, _| {
        let feed = |cells: Array<_>| Link { x: cells.each(Vec::<Signal>::new()) };
        m.array::<Inverter>("u_cell", 2, &Inverter { registered: true }, feed).out.last()
    }));
}

/// What a block may wrongly keep from the module that instantiates it.
#[derive(Clone, Copy)]
enum Kept {
    Memory(Mem),
    Lanes(Lanes),
    Result(Signal),
    Register(Reg),
}

thread_local!(static KEPT: std::cell::Cell<Option<Kept>> = const { std::cell::Cell::new(None) });

/// Uses what another module left.
#[derive(Debug)]
struct Keeper;

impl Block for Keeper {
    type In = ();
    type Out = Out;

    fn inputs(&self) {}

    fn build(&self, _: Module, _: ()) -> Out {
        let out = match KEPT.get().unwrap() {
            Kept::Memory(memory) => memory.read_async(0),
            Kept::Lanes(lanes) => lanes.lane(0),
            Kept::Result(signal) => !signal,
            Kept::Register(register) => {
                register.next(0);
                register.value()
            }
        };
        Out { out }
    }
}

#[test]
#[should_panic(expected = "a memory of another module is used")]
fn memories_of_another_module() {
    let _ = elaborate(&Case(|m, _| {
        KEPT.set(Some(Kept::Memory(m.memory("words", 4, 8, ReadUnderWrite::Old))));
        m.instance("u_keeper", &Keeper, ()).out
    }));
}

#[test]
#[should_panic(expected = "lanes of another module are used")]
fn lanes_of_another_module() {
    let _ = elaborate(&Case(|m, i| {
        let block = Inverter { registered: true };
        KEPT.set(Some(Kept::Lanes(m.array("u_cell", 2, &block, |cells| Link { x: cells.all(&i.a) }).out)));
        m.instance("u_keeper", &Keeper, ()).out
    }));
}

/// The register's node has the number of the stand-in for it in the module that drives it.
#[test]
fn registers_of_another_module() {
    /// Lends its register to an instance in it.
    #[derive(Debug)]
    struct Lender;
    impl Block for Lender {
        type In = ();
        type Out = Out;
        fn inputs(&self) {}
        fn build(&self, m: Module, _: ()) -> Out {
            let _zero = lit(8, 0);
            let r = m.reg("r", 8);
            r.next(1);
            KEPT.set(Some(Kept::Register(r)));
            m.instance("u_keeper", &Keeper, ())
        }
    }
    let text = problems(&Lender);
    assert!(
        text.starts_with("`r` belongs to `Lender` but is used inside of `Keeper`\n  --> [register.next(0);]"),
        "{text}"
    );
}

#[test]
fn signals_of_a_finished_module() {
    /// Leaves its output where others find it.
    #[derive(Debug)]
    struct Leaver;
    impl Block for Leaver {
        type In = ();
        type Out = Out;
        fn inputs(&self) {}
        fn build(&self, _: Module, _: ()) -> Out {
            let out = lit(8, 1);
            KEPT.set(Some(Kept::Result(out)));
            Out { out }
        }
    }
    let text = problems(&Case(|m, _| {
        let one = m.instance("u_leaver", &Leaver, ()).out;
        m.instance("u_keeper", &Keeper, ()).out & one
    }));
    assert!(text.starts_with("a signal of a module already finished is used inside of `Keeper`"), "{text}");
}

#[test]
fn modules_with_illegal_names() {
    /// Called by a word of Verilog.
    #[derive(Debug)]
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
    assert!(text.starts_with("input `x` has no bits\n  --> [Link { x: bits(0) }]"), "{text}");
    assert!(text.contains("`endmodule` cannot be the name of a module"), "{text}");
}

#[test]
fn things_without_bits() {
    let register = |m: Module, _: In| {
        let r = m.reg("r", 0);
        r.next(0);
        r.value()
    };
    assert!(problems(&Case(register)).starts_with("register `r` has no bits"));
}

#[test]
fn all_problems_are_reported_in_one_go() {
    let text = problems(&Case(|m, i| {
        let r = m.reg("r", 8);
        let _ = i.a + i.b;
        r.value().slice(0..9)
    }));
    assert!(text.ends_with("3 problems in this description"), "{text}");
}
