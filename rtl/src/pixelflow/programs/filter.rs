//! Texture filtering: interpolates the texels that the texture unit found along u, along v, and between levels.
//!
//! Interpolation between a and b with a weight of 8 bits is `floor((a (256 - weight) + b weight) / 2^8)`. It starts
//! with a. For each bit of the weight, from the lowest, the value becomes half of its sum with a or b. All channels
//! that share a weight use each bit together.

use super::super::fields::shading::*;
use super::super::fields::{Field, texture};
use super::super::instruction::Instruction;
use super::super::pixel::{Begin, Condition, Function, Mask};
use super::arithmetic::Writer;
use super::assembler::{carried, copy, load, set, with_accumulator, with_constant};

/// An interpolation between the bytes at `a` and `b`, written to `to`.
struct Between {
    a: u64,
    b: u64,
    to: u64,
}

/// The instructions that find the weights along u and v, on the level and the next finer one. No texture has a level
/// above `finest`.
pub(super) fn weights(finest: u8) -> Vec<Instruction<u64>> {
    let mut w = Writer::default();
    for (from, texels) in texture::UV.iter().zip(TEXELS) {
        w.push(copy(*from, texels));
    }
    let mut from = DETAIL.byte(1);
    for bit in 0..u8::BITS - finest.leading_zeros() {
        w.digit(from, DIGITS, Begin::Zero);
        from = DIGITS;
        for texels in TEXELS {
            shift_left(&mut w, texels, 1 << bit);
        }
    }
    for (axis, texels) in TEXELS.iter().enumerate() {
        let [on_level, on_finer] = [WEIGHTS[0][axis], WEIGHTS[1][axis]];
        let middle = |from: u64, to: u64| with_constant(Function::ExclusiveOr, Field::new(from, 1), 0x80).writes(to);
        w.extend([
            middle(texels.byte(1), on_level),
            carried(Function::ShiftLeft, texels.byte(0)).begins(Begin::Zero),
            carried(Function::ShiftLeft, texels.byte(1)).writes(on_finer),
            middle(on_finer, on_finer),
        ]);
    }
    w.0
}

/// Shifts a number of two bytes to the left if the flag is set.
fn shift_left(w: &mut Writer, field: Field, distance: u32) {
    if distance == 8 {
        w.push(copy(Field::new(field.byte(0), 1), Field::new(field.byte(1), 1)).only(Mask::Flagged));
        w.push(set(Field::new(field.byte(0), 1), 0).only(Mask::Flagged));
        return;
    }
    for _ in 0..distance {
        let shift = carried(Function::ShiftLeft, 0).from(field).to(field);
        w.push(shift.begins(Begin::Zero).only(Mask::Flagged));
    }
}

/// The instructions that interpolate between eight texels. The colour goes to the lower three bytes of [`TRIAL`].
pub(super) fn trilinear() -> Vec<Instruction<u64>> {
    let mut w = Writer::default();
    for level in 0..2 {
        let [along, up] = WEIGHTS[level];
        let texel = |x: u64, y: u64, channel: u64| texture::texel(level as u64, [x, y], channel).address;
        let row = |y: u64, channel: u64| ROWS[y as usize] + channel;
        let rows = (0..2).flat_map(|y| (0..3).map(move |channel| (y, channel)));
        let rows: Vec<Between> = rows
            .map(|(y, channel)| Between { a: texel(0, y, channel), b: texel(1, y, channel), to: row(y, channel) })
            .collect();
        between(&mut w, along, 8, &rows);
        let columns = [0, 1, 2].map(|c| Between { a: row(0, c), b: row(1, c), to: LEVELS[level] + c });
        between(&mut w, up, 8, &columns);
    }
    // The lower four bits of this weight are zero, and do not change the initial value a.
    let weight = DETAIL.byte(0);
    for _ in 0..4 {
        w.push(carried(Function::ShiftRight, weight).writes(weight).begins(Begin::Zero));
    }
    let [coarse, fine] = LEVELS;
    between(&mut w, weight, 4, &[0, 1, 2].map(|c| Between { a: coarse + c, b: fine + c, to: TRIAL.byte(c) }));
    w.0
}

/// Interpolates all values with the lowest `bits` bits of one weight, which it shifts out. Each bit takes 1 clock, and
/// 3 for each value.
fn between(w: &mut Writer, weight: u64, bits: u32, all: &[Between]) {
    for bit in 0..bits {
        w.digit(weight, weight, Begin::Zero);
        for Between { a, b, to } in all {
            w.push(load(*a));
            w.push(load(*b).only(Mask::Flagged));
            let from = if bit == 0 { *a } else { *to };
            w.push(with_accumulator(Function::AddHalved, from).writes(*to).begins(Begin::Zero));
        }
    }
}

/// The instructions that find the surface's colour: the word's colour times that of the texture, if there is one.
pub(super) fn base(word: u64) -> Vec<Instruction<u64>> {
    let mut w = Writer::default();
    let texel = Field::new(TRIAL.address, 3);
    let is_plain = with_constant(Function::Compare, texture::TEXTURE, super::shade::NO_TEXTURE);
    w.push(is_plain.begins(Begin::One).flags(Condition::Carry));
    w.push(set(texel, -1).only(Mask::Flagged));
    for (channel, (rgb, base)) in super::super::fields::appearance::RGB.iter().zip(BASE).enumerate() {
        w.scaled(texel.byte(channel as u64), rgb.of(word).address, base);
    }
    w.0
}
