//! Inputs that nothing uses.

use crate::messages::common::*;
use tilewright_hdl::*;

/// Leaves an input unused.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
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

/// A fault does not also report its operands as unused.
#[test]
fn inputs_in_faulty_expressions_are_used() {
    /// Like [`Case`], but unused inputs are not reported.
    #[derive(Debug, Clone, PartialEq, Eq, Hash)]
    #[allow(
        unpredictable_function_pointer_comparisons,
        reason = "a block that is built twice for one function is no harm"
    )]
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
            *r
        }),
        ("`r` is given a next value twice [T302]", |m, i| {
            let r = m.reg("r", 8);
            r.next(i.a);
            r.next(cat![i.b, i.c]);
            *r
        }),
        ("an address", |m, i| {
            let words = m.memory("words", 16, 1, ReadUnderWrite::Old);
            words.write(i.c, i.a, i.b);
            words.read(0)
        }),
        ("input `x` of `u_inverter`", |m, i| {
            m.instance("u_inverter", &Inverter { registered: true }, Link { x: i.b }).out + cat![i.a, i.c].trunc(8)
        }),
        ("input `x` of `u_cell`", |m, i| {
            let inverter = Inverter { registered: true };
            let cells = m.array("u_cell", 3, &inverter, |_| Link { x: stack([i.a, i.b.zext(8)]) });
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
        "input `b` of `Careless` is never used [T312]\n  --> [In { a: bits(8), b: bits(7), c: bit() }]\n  help: remove it, or say `m.ignore(&i.b)` if that is intended"
    );
}
