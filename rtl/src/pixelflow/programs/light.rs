//! The light that a surface with a unit normal reflects.
//!
//! A cosine is the floor of `n . d / 2^8`. The direction d is constant. So in each of 8 steps bits of d decide which of
//! the normal's components are added or subtracted. Each sum of components that occurs is made once. The lowest bits
//! come first, and each step halves the result. So no value exceeds 16 bits, and the floors of all steps together are
//! the floor of the quotient. All sums have an offset of 2^14, so none is negative.

use std::collections::BTreeMap;

use super::super::fields::Field;
use super::super::fields::shading::*;
use super::super::pixel::{Begin, Condition, Enabling, Function, Mask};
use super::arithmetic::Writer;
use super::assembler::{alu, carried, load, set, with_accumulator, with_constant};
use super::shade::Light;
use crate::pixelflow::pixel::Source;

/// The offset of sums, in the upper byte.
const BIAS_BYTE: i64 = 0x40;

/// Sums and differences of a unit normal's components, each made when it is first needed.
#[derive(Debug, Default)]
pub(super) struct Combinations {
    made: BTreeMap<[i16; 3], Field>,
    has_bias: bool,
}

impl Combinations {
    /// The address of the sum of the components with these signs: each is -1, 0 or 1, and not all are 0.
    fn of(&mut self, w: &mut Writer, signs: [i16; 3]) -> Field {
        if let Some(field) = self.made.get(&signs) {
            return *field;
        }
        let last = signs.iter().rposition(|sign| *sign != 0).unwrap_or(0);
        let mut others = signs;
        others[last] = 0;
        let from = if others == [0; 3] { None } else { Some(self.of(w, others)) };
        let to = Field::new(COMBINATIONS + 2 * self.made.len() as u64, 2);
        match (from, signs[last] > 0) {
            (None, true) => {
                w.push(with_constant(Function::Add, UNIT[last], BIAS_BYTE << 8).to(to).begins(Begin::Zero));
            }
            (None, false) => {
                if !self.has_bias {
                    w.push(set(BIAS, BIAS_BYTE << 8));
                    self.has_bias = true;
                }
                w.pair(Function::Subtract, BIAS, UNIT[last], to);
            }
            (Some(from), is_added) => {
                w.pair(if is_added { Function::Add } else { Function::Subtract }, from, UNIT[last], to);
            }
        }
        self.made.insert(signs, to);
        to
    }

    /// The cosine between the unit normal and a direction, from 0 to 4095.
    pub fn cosine(&mut self, w: &mut Writer, direction: [i16; 3], to: Field) {
        let mut has_begun = false;
        for bit in 0..8 {
            let signs = direction.map(|part| part.signum() * (part.abs() >> bit & 1));
            match (signs == [0; 3], has_begun) {
                (true, false) => {}
                (true, true) => halve(w, to, to),
                (false, false) => {
                    let sum = self.of(w, signs);
                    halve(w, sum, to);
                    has_begun = true;
                }
                (false, true) => {
                    let sum = self.of(w, signs);
                    w.push(load(sum.byte(0)));
                    w.push(with_accumulator(Function::Add, to.byte(0)).writes(to.byte(0)).begins(Begin::Zero));
                    w.push(load(sum.byte(1)));
                    w.push(with_accumulator(Function::AddHalved, to.byte(1)).writes(to.byte(1)));
                    w.push(carried(Function::ShiftRight, to.byte(0)).writes(to.byte(0)));
                }
            }
        }
        if !has_begun {
            w.push(set(to, 0));
            return;
        }
        let upper = Field::new(to.byte(1), 1);
        w.push(
            with_constant(Function::Subtract, upper, BIAS_BYTE).to(upper).begins(Begin::One).flags(Condition::NoCarry),
        );
        w.push(set(to, 0).only(Mask::Flagged));
        // A unit normal is shorter than 2^12, so only a direction longer than 2^8 may give 2^12 or more.
        if direction.iter().map(|part| i32::from(*part).pow(2)).sum::<i32>() > 1 << 16 {
            w.push(with_constant(Function::Compare, upper, 0x10).begins(Begin::One).flags(Condition::Carry));
            w.push(set(to, 0xfff).only(Mask::Flagged));
        }
    }
}

/// Halves a sum, but not its offset.
fn halve(w: &mut Writer, from: Field, to: Field) {
    let upper = with_constant(Function::AddHalved, Field::new(from.byte(1), 1), BIAS_BYTE);
    w.push(upper.writes(to.byte(1)).begins(Begin::Zero));
    w.push(carried(Function::ShiftRight, from.byte(0)).writes(to.byte(0)));
}

/// Replaces a cosine by `floor(c^2 / 2^12)`, in the pixels of the mask: 40 clocks.
///
/// With c split into h || l, of 4 and 8 bits, that is `16 h^2 + floor((h l + floor(floor(l^2 / 2^8) / 2)) / 8)`.
pub(super) fn squared(w: &mut Writer, cosine: Field, mask: Mask) {
    let (l, h) = (cosine.byte(0), cosine.byte(1));
    w.push(load(h));
    w.product(ZERO, h, 4, [HIGH, LOW]);
    w.push(load(l));
    w.digit(l, DIGITS, Begin::Zero);
    w.half(ZERO, PARTIAL);
    for _ in 1..8 {
        w.digit(DIGITS, DIGITS, Begin::Zero);
        w.half(PARTIAL, PARTIAL);
    }
    w.push(carried(Function::ShiftRight, PARTIAL).writes(PARTIAL).begins(Begin::Zero));
    // Three digits of h, each of which halves the sum, and the fourth, which does not.
    w.digit(h, DIGITS, Begin::Zero);
    for _ in 0..3 {
        w.half(PARTIAL, PARTIAL);
        w.digit(DIGITS, DIGITS, Begin::Zero);
    }
    w.push(alu(Function::Add, Source::Multiplicand).reads(PARTIAL).writes(PARTIAL).begins(Begin::Zero));
    w.push(carried(Function::Add, HIGH).writes(HIGH));
    w.push(load(LOW));
    w.push(with_accumulator(Function::Add, PARTIAL).writes(l).begins(Begin::Zero).only(mask));
    w.push(carried(Function::Add, HIGH).writes(h).only(mask));
}

/// Adds `floor(brightness (c + 1) / 2^12)` to a byte, limited to 255, and destroys the cosine c: 27 clocks.
fn shine(w: &mut Writer, brightness: u8, cosine: Field, to: u64) {
    let start = set(Field::new(PARTIAL, 1), brightness.into());
    w.push(super::Instruction { accumulates: 1, ..start });
    for digit in 0..12 {
        let byte = cosine.byte(digit / 8);
        w.digit(byte, byte, Begin::Zero);
        w.half(PARTIAL, PARTIAL);
    }
    w.last_to_accumulator();
    w.push(with_accumulator(Function::Add, to).writes(to).begins(Begin::Zero).flags(Condition::Carry));
    w.push(set(Field::new(to, 1), 255).only(Mask::Flagged));
}

/// Adds the contribution of a light. `squarings` is the range of squarings over all materials that have highlights, or
/// `None` if no material has any.
pub(super) fn light(w: &mut Writer, sums: &mut Combinations, light: &Light, squarings: Option<[u8; 2]>) {
    if light.brightness == 0 {
        return;
    }
    sums.cosine(w, light.direction, LIT);
    if let Some([least, most]) = squarings {
        sums.cosine(w, light.half, HIGHLIGHT);
        // A light behind the surface, whose cosine is 0, has no highlight.
        w.push(with_constant(Function::Compare, LIT, 1).begins(Begin::One).flags(Condition::NoCarry));
        w.push(set(HIGHLIGHT, 0).only(Mask::Flagged));
        for number in 0..most {
            let mask = if number < least { Mask::Everybody } else { Mask::Enabled };
            if number >= least {
                let goes_on = with_constant(Function::Compare, Field::new(SQUARINGS, 1), i64::from(number) + 1);
                w.push(goes_on.begins(Begin::One).enables(Enabling::Replace, Condition::Carry));
            }
            squared(w, HIGHLIGHT, mask);
        }
        shine(w, light.brightness, HIGHLIGHT, REFLECTED);
    }
    shine(w, light.brightness, LIT, DIFFUSE);
}
