//! The properties that a derived value keeps from its operand: its lanes, and whether it is signed.

use tilewright_hdl::*;
use tilewright_sim::traced;

fn looks_back(m: Module, signed_first: bool) {
    def!(level = m.reg(8).reset(0xfd));
    level.next(level + 1);
    let first = signed_first.then(|| m.past(level.signed()));
    let bits = m.past(*level);
    let signed = first.unwrap_or_else(|| m.past(level.signed()));
    def!(below_0 = signed.lt(0));
    def!(half = (signed >> 1).bits());
    def!(half_of_bits = bits >> 1);
    m.ignore(&[below_0, half, half_of_bits]);
    m.assert(!m.stable(level.signed()), "it counts");
}

/// A past value has the kind of its own operand, even if an equal one with another kind came first.
#[test]
fn a_past_is_signed_where_what_it_is_of_is() {
    for example in [traced(|m| looks_back(m, false)), traced(|m| looks_back(m, true))] {
        assert_eq!(example.values("level"), [0xfd, 0xfe, 0xff, 0, 1]);
        assert_eq!(example.values("below_0"), [0, 1, 1, 1, 0]);
        assert_eq!(example.values("half"), [0, 0xfe, 0xff, 0xff, 0]);
        assert_eq!(example.values("half_of_bits"), [0, 0x7e, 0x7f, 0x7f, 0]);
    }
}

#[test]
fn a_shift_keeps_the_lanes_also_where_nothing_is_left() {
    let _ = traced(|m| {
        let lanes = constants(bits(8).of(row(4)), |lane| lane + 1);
        for (amount, left, right) in [(1, 20, 4), (7, 0, 0), (8, 0, 0), (200, 0, 0)] {
            m.assert((lanes >> amount).sum().eq(right), "the sum of what is shifted right");
            m.assert((lanes << amount).sum().eq(left), "the sum of what is shifted left");
            assert_eq!(((lanes << amount).shape(), (lanes >> amount).shape()), (lanes.shape(), lanes.shape()));
        }
    });
}

/// A concatenation of bits is an unsigned number, even if nothing moves.
#[test]
fn a_rotation_a_repetition_and_a_concatenation_are_numbers_by_any_amount() {
    let _ = traced(|m| {
        let level = lit(8, 0xfe).signed();
        for places in 0..=8 {
            m.assert(level.rotate_left(places).rotate_right(places).eq(0xfe), "as it was");
        }
        m.assert(level.repeat(1).eq(0xfe) & cat![level].eq(0xfe), "no sign");
    });
}
