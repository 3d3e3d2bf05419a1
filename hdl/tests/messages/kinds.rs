//! Signed values and codes of enums, and operations that mix them.

use crate::messages::common::*;
use tilewright_hdl::*;

codes! {
    enum Operation { Add, Subtract, And }
    enum Source { Memory, Constant }
}

#[test]
fn signed_and_unsigned() {
    expect(
        |_, i| i.a + i.a.signed(),
        "`+` mixes `a`, a number, and `a`, signed [T201]
         --> [|_, i| i.a + i.a.signed(),]
         `a` is made at [In { a: bits(8), b: bits(7), c: bit() }]
         `a` is made at [In { a: bits(8), b: bits(7), c: bit() }]
         help: `.signed()` reads bits in two's complement, `.code::<Enum>()` as a code, `.bits()` as a number",
    );
    let cases: [(&str, Build); 6] = [
        ("`next` mixes `level`, signed, and `a`, a number", |m, i| {
            let level = m.reg("level", bits(8).signed());
            level.next(i.a);
            level.bits()
        }),
        ("a word of memory `words` is signed, but `a` is a number [T201]", |m, i| {
            let words = m.memory("words", 4, bits(8).signed(), ReadUnderWrite::Old);
            words.write(i.c, 0, i.a);
            words.read(0).bits()
        }),
        ("`-` makes a negative number, but `a` is not signed [T202]", |_, i| -i.a),
        ("`.zext(9)` would lose the sign of `a`, which has 8 bits [T203]", |_, i| i.a.signed().zext(9)),
        ("`-129` does not fit in 8 bits, signed", |_, i| i.a.signed().lt(-129).zext(8)),
        ("input `x` of `u_inverter` is a number, but `a` is signed [T503]", |m, i| {
            m.instance("u_inverter", &Inverter { registered: false }, Link { x: i.a.signed() }).out
        }),
    ];
    for (start, build) in cases {
        let text = problems(&Case(build));
        assert!(text.starts_with(start), "{text}");
    }
}

#[test]
fn constants_stand_in_messages_as_a_description_writes_them() {
    let text = problems(&Case(|_, i| i.a + lit(bits(8).signed(), -3)));
    assert!(text.starts_with("`+` mixes `a`, a number, and `-3`, signed [T201]\n"), "{text}");
    let text = problems(&Case(|_, i| i.a + Signal::from(Operation::Subtract)));
    assert!(text.contains("`Operation::Subtract`"), "{text}");
}

#[test]
fn codes_and_numbers() {
    let cases: [(&str, Build); 8] = [
        ("`<<` computes with `operation`, a code of `Operation`", |m, _| operation(m) << 1),
        ("`eq` mixes `operation`, a code of `Operation`, and `1`", |m, _| operation(m).eq(1)),
        ("`+` computes with `operation`, a code of `Operation` [T204]", |m, _| operation(m) + 1),
        ("`is` mixes `operation`, a code of `Operation`, and `Source::Memory` [T201]", |m, _| {
            operation(m).is(Source::Memory)
        }),
        ("`lt` computes with `operation`, a code of `Operation`", |m, _| operation(m).lt(Operation::And)),
        ("`+` mixes `a`, a number, and `Operation::And`", |_, i| i.a + Operation::And),
        ("a `Operation` has 2 bits, but `a` has 8 bits [T205]", |_, i| i.a.code::<Operation>().is(Operation::Add)),
        ("`choose` needs a code of `Source`, but `operation` is a code of `Operation` [T206]", |m, _| {
            operation(m).choose(|source| match source {
                Source::Memory => 1,
                Source::Constant => 0,
            })
        }),
    ];
    for (start, build) in cases {
        let text = problems(&Case(build));
        assert!(text.starts_with(start), "{text}");
    }
}

/// A constant of the circuit must satisfy the same rules as a number.
#[test]
fn constants_that_are_signals() {
    bundle! { struct Step<T> { operation: T, by: T } }

    let cases: [(&str, Build); 5] = [
        ("`reset` mixes `operation`, a code of `Operation`, and `3`, a number", |m, i| {
            let operation = m.reg("operation", one_of::<Operation>()).reset(lit(2, 3));
            operation.when(i.c, Operation::Add);
            operation.bits()
        }),
        ("`initial` mixes `level`, signed, and `200`, a number", |m, i| {
            let level = m.reg("level", bits(8).signed()).initial(lit(8, 200));
            level.when(i.c, -1);
            level.bits()
        }),
        ("the reset value of `lanes` is not a constant of 8 bits", |m, i| {
            let lanes = m.reg("lanes", bits(8).of(row(4))).reset(lit(8, 5).of(row(4)));
            lanes.when(i.c, i.a);
            lanes.or_all()
        }),
        ("field `by` of word 0 of memory `steps` is signed, but `200` is a number", |m, i| {
            let layout = Step { operation: one_of::<Operation>(), by: bits(8).signed() };
            let step = Step { operation: lit(2, 1).code::<Operation>(), by: lit(8, 200) };
            m.rom("steps", layout, [step]).read_async(i.c).by.bits()
        }),
        ("word 0 of memory `levels` is signed, but `200` is a number", |m, i| {
            m.rom("levels", bits(8).signed(), [lit(8, 200)]).read_async(i.c).bits()
        }),
    ];
    for (start, build) in cases {
        let text = problems(&Case(build));
        assert!(text.starts_with(start), "{text}");
    }
}

fn operation(m: Module) -> Signal {
    let operation = m.reg("operation", one_of::<Operation>()).reset(Operation::And);
    operation.next(mux(operation.is(Operation::Add), Operation::Subtract, Operation::Add));
    *operation
}

/// The output of an instance has the declared kind, whatever drives it.
#[test]
fn outputs_stand_for_what_the_block_says() {
    #[derive(Debug, Clone, PartialEq, Eq, Hash)]
    struct Smallest;

    impl Block for Smallest {
        type In = Link;
        type Out = Out;

        fn inputs(&self) -> Link<Width> {
            Link { x: bits(8).signed().of(row(3)) }
        }

        fn build(&self, _: Module, i: Link) -> Out {
            Out { out: i.x.minimum().bits() }
        }
    }

    elaborate(&Case(|m, i| m.instance("u_smallest", &Smallest, Link { x: i.a.signed().of(row(3)) }).out + i.a))
        .unwrap();
    let text = problems(&Case(|m, i| m.instance("u_smallest", &Smallest, Link { x: i.a.of(row(3)) }).out));
    assert!(text.starts_with("input `x` of `u_smallest` is signed, but `a.of(..)` is a number [T503]\n"), "{text}");
}
