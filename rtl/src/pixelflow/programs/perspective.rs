//! A pixel's position on its texture: two divisions, and the level of detail.
//!
//! u is the lower 16 bits of `floor((u/w) 2^16 / (1/w))`, in 24 steps. The first 8 steps give whole repeats of the
//! texture. The level, in 1/16, is `2 level - (511 - L)`, but at least 0. L is a piecewise linear logarithm of 1/w: 32
//! times the position of its leading one, plus the 5 bits below that.

use super::super::fields::appearance::{LEVEL as NEAREST, SCALE, UV, ZERO as EMPTY};
use super::super::fields::shading::*;
use super::super::fields::{Field, texture};
use super::super::instruction::Instruction;
use super::super::pixel::{Begin, Condition, Function, Mask};
use super::arithmetic::{Division, Writer};
use super::assembler::{carried, copy, load, set, with_accumulator, with_constant};

/// The instructions that divide u/w and v/w by 1/w, for the texture unit.
pub(super) fn coordinates(word: u64) -> Vec<Instruction<u64>> {
    let mut w = Writer::default();
    for (part, to) in UV.iter().zip(texture::UV) {
        coordinate(&mut w, part.of(word), SCALE.of(word), to);
    }
    w.0
}

fn coordinate(w: &mut Writer, part: Field, scale: Field, to: Field) {
    // All digits are set at first.
    w.push(set(to, -1));
    for digit in (0..24_u64).rev() {
        // The first remainder is the upper byte.
        let from = if digit == 23 { [part.byte(1), ZERO] } else { [REMAINDER.byte(0), REMAINDER.byte(1)] };
        let comes_in = digit >= 16;
        if comes_in {
            let rest = if digit == 23 { part.byte(0) } else { REST };
            w.push(carried(Function::ShiftLeft, rest).writes(REST).begins(Begin::Zero));
        }
        // While digits come in, the remainder has fewer than 16 bits, so no bit can leave it.
        w.divided(from, REMAINDER, scale, Division { comes_in, may_leave: !comes_in, is_last: digit == 0 });
        if !comes_in {
            w.quotient_digit(to, digit);
        }
    }
}

/// The instructions that find the level for the texture unit, and the weight between levels. The level is at most the
/// finest level of the material's texture.
pub(super) fn level(word: u64) -> Vec<Instruction<u64>> {
    let mut w = Writer::default();
    leading_one(&mut w, SCALE.of(word));
    let [weight, whole] = [DETAIL.byte(0), DETAIL.byte(1)];
    w.extend([
        // The leading one is dropped. Of the bits below it, only those that belong to L stay.
        carried(Function::ShiftLeft, LEADING.byte(1)).writes(weight).begins(Begin::Zero),
        carried(Function::ShiftLeft, weight).writes(weight).begins(Begin::Zero),
        carried(Function::ShiftLeft, PLACE).writes(whole),
        with_constant(Function::And, Field::new(weight, 1), 0xf0).writes(weight),
    ]);
    // 32 times the nearest level: the level times 2^8, shifted to the right by three bits.
    let nearest = Field::new(LEADING.address, 2);
    for number in 0..3 {
        let from = if number == 0 { [ZERO, NEAREST.of(word).address] } else { [nearest.byte(0), nearest.byte(1)] };
        w.push(carried(Function::ShiftRight, from[1]).writes(nearest.byte(1)).begins(Begin::Zero));
        w.push(carried(Function::ShiftRight, from[0]).writes(nearest.byte(0)));
    }
    w.pair(Function::Add, DETAIL, nearest, DETAIL);
    w.extend([
        with_constant(Function::Subtract, DETAIL, 16 * 511).to(DETAIL).begins(Begin::One).flags(Condition::NoCarry),
        set(DETAIL, 0).only(Mask::Flagged),
        load(FINEST),
        with_accumulator(Function::Compare, whole).begins(Begin::One).flags(Condition::Carry),
        copy(Field::new(FINEST, 1), Field::new(whole, 1)).only(Mask::Flagged),
        set(Field::new(weight, 1), 0).only(Mask::Flagged),
        copy(Field::new(whole, 1), texture::LEVEL),
        // A pixel that nothing covers has no texture.
        with_constant(Function::Compare, EMPTY.of(word), 1).begins(Begin::One).flags(Condition::Carry),
        set(texture::TEXTURE, super::shade::NO_TEXTURE).only(Mask::Flagged),
    ]);
    w.0
}

/// Shifts 1/w until its leading one is the top bit, and finds the original position of that one. The steps shift by 8,
/// 4, 2 and 1 bits, each only if that number of top bits is 0.
fn leading_one(w: &mut Writer, scale: Field) {
    let upper = Field::new(LEADING.byte(1), 1);
    w.push(copy(scale, LEADING));
    w.push(set(Field::new(PLACE, 1), 15));
    for distance in [8, 4, 2, 1] {
        let least = (1 << (8 - distance)).max(1);
        w.push(with_constant(Function::Compare, upper, least).begins(Begin::One).flags(Condition::NoCarry));
        if distance == 8 {
            w.push(copy(Field::new(LEADING.byte(0), 1), upper).only(Mask::Flagged));
            w.push(set(Field::new(LEADING.byte(0), 1), 0).only(Mask::Flagged));
        } else {
            for _ in 0..distance {
                let shift = Instruction { length: 2, ..carried(Function::ShiftLeft, LEADING.address) };
                w.push(
                    Instruction { length: 2, ..shift.writes(LEADING.address) }.begins(Begin::Zero).only(Mask::Flagged),
                );
            }
        }
        let place = with_constant(Function::Subtract, Field::new(PLACE, 1), distance);
        w.push(place.writes(PLACE).begins(Begin::One).only(Mask::Flagged));
    }
}
