//! Widths that differ, changes of width that are wrong, and invalid widths.

use crate::messages::common::*;
use tilewright_hdl::*;

#[test]
fn widths_that_differ() {
    expect(
        |_, i| i.a + i.b,
        "`+` needs equal widths: `a` has 8 bits, `b` has 7 bits [T101]
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
        "`eq` needs equal widths: `a & !a` has 8 bits, `cat![b, c].slice(1..8)` has 7 bits [T101]
         --> [|_, i| (i.a & !i.a).eq(cat![i.b, i.c].slice(1..8)),]
         `a & !a` is made at [|_, i| (i.a & !i.a).eq(cat![i.b, i.c].slice(1..8)),]
         `cat![b, c].slice(1..8)` is made at [|_, i| (i.a & !i.a).eq(cat![i.b, i.c].slice(1..8)),]
         help: widen the narrow side with `.zext(8)` or `.sext(8)`, or cut the wide one with `.trunc(7)`",
    );
}

#[test]
fn low_bits_of_too_few() {
    expect(
        |_, i| i.a + i.b.low(),
        "`+` needs equal widths: `a` has 8 bits, `b` has 7 bits [T101]
         --> [|_, i| i.a + i.b.low(),]
         `a` is made at [In { a: bits(8), b: bits(7), c: bit() }]
         `b` is made at [In { a: bits(8), b: bits(7), c: bit() }]
         help: widen the narrow side with `.zext(8)` or `.sext(8)`, or cut the wide one with `.trunc(7)`",
    );
    let of_memory = problems(&Case(|m, i| m.memory("words", 256, 8, ReadUnderWrite::Old).fill(0).read(i.b.low())));
    assert!(of_memory.starts_with("an address of memory `words` has 8 bits, but `b` has 7 bits"), "{of_memory}");
    let of_constant = problems(&Case(|m, i| {
        let r = m.reg("r", 7).reset(i.a.low());
        r.next(*r);
        *r
    }));
    assert!(of_constant.starts_with("the reset value of `r` is not a constant of 7 bits"), "{of_constant}");
}

/// Every operator, choice and sink checks widths, and the message names it.
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
                *r
            },
            "`next`",
        ),
        (
            |m, i| {
                let w = m.wire("w", 8);
                w.drive(i.b);
                *w
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
fn nothing_is_wider_than_a_million_bits() {
    let text = problems(&Case(|_, i| i.a.repeat(600_000_000)));
    assert!(
        text.starts_with("`.repeat(600000000)` makes more than 1048576 bits of `a`, which has 8 bits [T108]"),
        "{text}"
    );
    let text = problems(&Case(|_, i| i.a.zext(600_000_000)));
    assert!(text.starts_with("`.zext(600000000)` makes more than 1048576 bits of `a`"), "{text}");
    elaborate(&Case(|_, i| concat(&[i.a.repeat(131_071), i.a]))).expect("a million bits are allowed");
    expect(
        |_, i| concat(&[i.a.repeat(131_071), i.a, i.b]),
        "a concatenation of 1048583 bits is wider than 1048576 [T108]
         --> [|_, i| concat(&[i.a.repeat(131_071), i.a, i.b]),]
         help: keep wide data in a memory",
    );
    // A number of bits that would overflow a `u32`.
    let text = problems(&Case(|_, i| concat(&[i.a.repeat(131_072); 4097])));
    assert!(text.starts_with("a concatenation of 4296015872 bits is wider than 1048576"), "{text}");
}

#[test]
fn what_follows_is_one_bit_and_a_part_is_inside() {
    expect(
        |_, i| i.c.implies(i.a).zext(8) | i.a.part(6, 3).zext(8),
        "the condition of `implies` is 1 bit, but `a` has 8 bits [T106]
         --> [|_, i| i.c.implies(i.a).zext(8) | i.a.part(6, 3).zext(8),]
         `a` is made at [In { a: bits(8), b: bits(7), c: bit() }]
         help: compare it, as in `.ne(0)`, or take one `.bit(i)`

         the slice 6..9 is outside of `a`, which has 8 bits [T103]
         --> [|_, i| i.c.implies(i.a).zext(8) | i.a.part(6, 3).zext(8),]
         `a` is made at [In { a: bits(8), b: bits(7), c: bit() }]
         help: a slice is `low..high` with low < high <= 8

         2 problems in this description",
    );
}

#[test]
fn literals_that_do_not_fit() {
    expect(
        |_, i| i.b + 128,
        "`128` does not fit in 7 bits, unsigned [T102]
         --> [|_, i| i.b + 128,]
         help: an integer takes the width of the signal it meets",
    );
    expect(
        |_, i| i.b.signed().lt(64),
        "`64` does not fit in 7 bits, signed [T102]
         --> [|_, i| i.b.signed().lt(64),]
         help: an integer takes the width of the signal it meets",
    );
    assert!(problems(&Case(|_, i| i.a + -1)).starts_with("`-1` does not fit in 8 bits, unsigned [T102]"));
    assert!(problems(&Case(|_, i| i.a & Bits::new(7, 1))).starts_with("`7'h01` does not fit in 8 bits"));
    elaborate(&Case(|_, i| i.a.signed().lt(-128))).expect("-128 is an 8-bit number");
}

#[test]
fn slices_and_changes_of_width() {
    expect(
        |_, i| i.a.slice(4..9),
        "the slice 4..9 is outside of `a`, which has 8 bits [T103]
         --> [|_, i| i.a.slice(4..9),]
         `a` is made at [In { a: bits(8), b: bits(7), c: bit() }]
         help: a slice is `low..high` with low < high <= 8",
    );
    assert!(problems(&Case(|_, i| i.a.trunc(9))).starts_with("`.trunc(9)` cannot cut `a`, which has 8 bits [T104]"));
    assert!(problems(&Case(|_, i| i.a.zext(7))).starts_with("`.zext(7)` cannot widen `a`, which has 8 bits [T105]"));
    assert!(problems(&Case(|_, i| i.a.sext(7))).starts_with("`.sext(7)` cannot widen `a`, which has 8 bits"));
    assert!(
        problems(&Case(|_, i| i.c.repeat(0))).starts_with("`.repeat(0)` leaves nothing of `c`, which has 1 bit [T113]")
    );
}

/// Each message is a single one, at the user's line, and the stand-in for the faulty object causes no other.
#[test]
fn things_without_bits() {
    let cases: [(&str, Build); 5] = [
        ("register `r` has no bits [T107]", |m, _| {
            let r = m.reg("r", 0);
            r.next(0);
            *r
        }),
        ("wire `w` has no bits [T107]", |m, _| {
            let w = m.wire("w", 0);
            w.drive(0);
            *w
        }),
        ("a constant has no bits [T107]", |_, _| lit(0, 5)),
        ("a constant has no bits [T107]", |m, _| {
            let block = Inverter { registered: true };
            m.array("u_cell", 3, &block, |_| Link { x: constants(bits(0).of(3), u64::from) }).out.last()
        }),
        ("a constant has no bits [T107]", |m, _| m.fsm("lamp", Lamp::Off).constants(0, |lamp| lamp.code())),
    ];
    for (message, build) in cases {
        let text = problems(&Case(build));
        let (first, place) = text.split_once("\n  --> ").expect("a message has a place");
        assert!(first == message && place.starts_with('['), "{text}");
        assert!(place.contains("help: a width is at least 1"), "{text}");
    }
    expect(
        |_, _| lit(0, 0),
        "a constant has no bits [T107]
         --> [|_, _| lit(0, 0),]
         help: a width is at least 1",
    );
}

/// Inverts an input of some width.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Port(u32);

impl Block for Port {
    type In = Link;
    type Out = Out;

    fn inputs(&self) -> Link<Width> {
        Link { x: bits(self.0) }
    }

    fn build(&self, _: Module, i: Link) -> Out {
        Out { out: !i.x }
    }
}

#[test]
fn what_is_declared_has_at_most_a_million_bits() {
    let place = "\n  --> [Link { x: bits(self.0) }]\n  help: ";
    assert_eq!(problems(&Port(0)), format!("input `x` has no bits [T107]{place}a width is at least 1"));
    let message = "input `x` of 1048577 bits is wider than 1048576 [T108]";
    assert_eq!(problems(&Port((1 << 20) + 1)), format!("{message}{place}keep wide data in a memory"));
    elaborate(&Port(1 << 20)).expect("a million bits are allowed");
    expect(
        |m, _| {
            let r = m.reg("r", 600_000_000).reset(300);
            r.next(300);
            *r
        },
        "register `r` of 600000000 bits is wider than 1048576 [T108]
         --> [let r = m.reg(\"r\", 600_000_000).reset(300);]
         help: keep wide data in a memory",
    );
    expect(
        |m, _| {
            let w = m.wire("w", u32::MAX);
            w.drive(300);
            *w
        },
        "wire `w` of 4294967295 bits is wider than 1048576 [T108]
         --> [let w = m.wire(\"w\", u32::MAX);]
         help: keep wide data in a memory",
    );
    expect(
        |_, _| lit(600_000_000, 300),
        "a constant of 600000000 bits is wider than 1048576 [T108]
         --> [|_, _| lit(600_000_000, 300),]
         help: keep wide data in a memory",
    );
    let text = problems(&Case(|_, i| mux(i.c, Bits::ones(1_048_577), Bits::ones(1_048_576))));
    assert!(text.starts_with("a constant of 1048577 bits is wider than 1048576 [T108]\n  --> [let text"), "{text}");
    expect(
        |m, i| m.memory("words", 256, 600_000_000, ReadUnderWrite::Old).read(i.a),
        "memory `words` has words of 600000000 bits, more than 1048576 [T108]
         --> [|m, i| m.memory(\"words\", 256, 600_000_000, ReadUnderWrite::Old).read(i.a),]
         help: spread wider data over several words",
    );
}

#[test]
fn products_have_at_most_a_million_bits() {
    elaborate(&Case(|_, i| i.a.repeat(65_536) * i.a.repeat(65_536))).expect("a million bits are allowed");
    expect(
        |_, i| (i.a.repeat(131_071) * cat![i.a, i.c]).slice(100..108),
        "a product of 1048577 bits is wider than 1048576 [T108]
         --> [|_, i| (i.a.repeat(131_071) * cat![i.a, i.c]).slice(100..108),]
         help: keep wide data in a memory",
    );
    let cases: [Build; 3] = [
        |_, i| i.a.repeat(131_072).times(i.a),
        |_, i| i.a.repeat(131_072).signed().times(i.a.signed()).bits(),
        |_, i| (i.a.repeat(131_072).signed() * i.a.signed()).bits(),
    ];
    for build in cases {
        let text = problems(&Case(build));
        assert!(text.starts_with("a product of 1048584 bits is wider than 1048576 [T108]\n  --> [|_, i| "), "{text}");
        assert!(!text.contains("problems in this"), "{text}");
    }
}

#[test]
fn concatenations_of_nothing() {
    expect(
        |_, _| concat(&[]),
        "a concatenation of nothing [T109]
         --> [|_, _| concat(&[]),]
         help: give it at least one signal",
    );
}

#[test]
fn shifts_by_less_than_nothing() {
    expect(
        |_, i| i.a << -1,
        "a shift by -1 bits [T110]
         --> [|_, i| i.a << -1,]
         help: an amount must be 0 or more",
    );
}

#[test]
fn a_number_is_named_as_it_is_written() {
    assert!(problems(&Case(|_, i| i.a + hex(0x1ff))).starts_with("`0x1ff` does not fit in 8 bits, unsigned [T102]\n"));
    assert!(
        problems(&Case(|_, i| i.b & binary(0x80)))
            .starts_with("`0b10000000` does not fit in 7 bits, unsigned [T102]\n")
    );
    assert!(problems(&Case(|_, i| i.a + hex(u64::MAX))).starts_with("`0xffffffffffffffff` does not fit"));
}
