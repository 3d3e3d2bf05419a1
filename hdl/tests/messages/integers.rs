//! Numbers that are no valid place, width or value.

use crate::messages::common::*;
use tilewright_hdl::*;

#[test]
#[expect(clippy::reversed_empty_ranges, reason = "it is the mistake")]
fn numbers_that_fit_nowhere() {
    let cases: [(&str, Build); 17] = [
        ("the slice -1..0 is outside of `a`, which has 8 bits", |_, i| i.a.bit(-1)),
        ("the slice 4294967296..4294967297 is outside of `a`, which has 8 bits", |_, i| i.a.bit(1u64 << 32)),
        ("the slice -2..3 is outside of `a`, which has 8 bits", |_, i| i.a.slice(-2..3)),
        ("the slice -4..4 is outside of `a`, which has 8 bits", |_, i| i.a.part(-4, 8)),
        ("`.repeat(-1)` leaves nothing of `a`, which has 8 bits", |_, i| i.a.repeat(-1)),
        ("`.repeat(4294967297)` makes more than 1048576 bits of `a`", |_, i| i.a.repeat((1u64 << 32) + 1)),
        ("lane -1 of a signal of 3 lanes", |_, i| i.a.of(3).lane(-1)),
        ("lane 4294967296 of a signal of 3 lanes", |_, i| i.a.of(3).lane(1u64 << 32)),
        ("`-1` does not fit in 8 bits, unsigned [T102]", |_, _| lit(8, -1)),
        ("the slice 7..4 takes no bits of `a`, which has 8 bits [T103]", |_, i| i.a.slice(7..4)),
        ("`128` does not fit in 8 bits, signed", |_, _| lit(bits(8).signed(), 128).bits()),
        ("`256` does not fit in 8 bits, unsigned", |_, _| constants(bits(8).of(4), |lane| 254 + lane).sum()),
        ("`-1` does not fit in 8 bits, unsigned [T102]", |_, _| constants(bits(8).of(4), |_| -1).sum()),
        ("the key -1 of `case` does not fit in 8 bits", |_, i| case(i.a, [(-1, i.a)], 0)),
        ("the key 255 of `case` does not fit in 8 bits", |_, i| case(i.a.signed(), [(255, i.a)], 0)),
        ("memory `words` of -4 words of 8 bits holds nothing", |m, i| {
            m.memory("words", -4, 8, ReadUnderWrite::Old).read(i.c)
        }),
        ("memory `words` has 4294967296 words, more than 4294967295 [T308]", |m, i| {
            m.memory("words", 1u64 << 32, 1, ReadUnderWrite::Old).read(i.a.zext(32))
        }),
    ];
    for (message, build) in cases {
        let text = problems(&Case(build));
        let (first, place) = text.split_once("\n  --> ").expect("a message has a place");
        assert!(first.starts_with(message) && place.starts_with('['), "{text}");
    }
}

/// The stand-in has the bits that were meant: a register as wide as it takes it.
#[test]
#[expect(clippy::reversed_empty_ranges, reason = "it is the mistake")]
fn a_slice_from_high_to_low_is_one_problem() {
    expect(
        |m, i| {
            let high = i.a.slice(7..4);
            let held = m.reg("held", 4);
            let same = m.reg("same", high.width());
            held.next(same);
            same.next(high);
            held.zext(8)
        },
        "the slice 7..4 takes no bits of `a`, which has 8 bits [T103]
         --> [let high = i.a.slice(7..4);]
         `a` is made at [In { a: bits(8), b: bits(7), c: bit() }]
         help: the lower bound comes first: bits 7 down to 4 are `.slice(4..8)`",
    );
}

#[test]
fn a_negative_number_beside_an_unsigned_signal() {
    expect(
        |_, i| i.a + -1,
        "`-1` does not fit in 8 bits, unsigned [T102]
         --> [|_, i| i.a + -1,]
         help: subtract a positive number, or read the signal as signed, by `.signed()`",
    );
}

#[test]
fn rotations_by_less_than_nothing() {
    expect(
        |_, i| i.a.rotate_right(-1),
        "a rotation by -1 places [T111]
         --> [|_, i| i.a.rotate_right(-1),]
         help: `rotate_left` and `rotate_right` take 0 or more",
    );
}

#[test]
fn counts_of_less_than_nothing() {
    expect(
        |_, i| i.a.of(3).to_rows(-1).sum(),
        "a number of -1 [T112]
         --> [|_, i| i.a.of(3).to_rows(-1).sum(),]
         help: it must be 0 or more",
    );
}
