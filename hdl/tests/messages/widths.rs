//! Widths that differ, that change wrongly, or that nothing may have.

use crate::common::*;
use tilewright_hdl::*;

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
fn things_without_bits() {
    let register = |m: Module, _: In| {
        let r = m.reg("r", 0);
        r.next(0);
        r.value()
    };
    assert!(problems(&Case(register)).starts_with("register `r` has no bits"));
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
