//! Normalization of the normal: three squares, their sum, the square root digit by digit, and three divisions by the
//! root plus one.
//!
//! Each component becomes `sign(n) floor(|n| 2^12 / (s + 1))` with `s = floor(sqrt(x^2 + y^2 + z^2))`. Source: facts E4.

use super::super::fields::Field;
use super::super::fields::appearance::NORMAL;
use super::super::fields::shading::*;
use super::super::instruction::Instruction;
use super::super::pixel::{Begin, Condition, Function, Mask};
use super::arithmetic::{Division, Writer};
use super::assembler::{carried, copy, load, load_constant, set, with_accumulator, with_constant};

/// The number of digits of a component of a unit normal.
const DIGITS_OF_UNIT: u64 = 12;

/// The instructions that normalize the normal of an appearance word.
pub(super) fn normalize(word: u64) -> Vec<Instruction<u64>> {
    let mut w = Writer::default();
    w.push(load_constant(0xff));
    for (normal, magnitude) in NORMAL.iter().zip(MAGNITUDE) {
        w.with_sign(normal.of(word), normal.of(word), magnitude);
    }
    for (number, magnitude) in MAGNITUDE.iter().enumerate() {
        let to = if number == 0 { SUM } else { SQUARE };
        square(&mut w, *magnitude, to);
        if number > 0 {
            w.pair(Function::Add, SUM, SQUARE, SUM);
        }
    }
    root(&mut w);
    let divisor = Field::new(ROOT.address, 2);
    w.push(with_constant(Function::Add, divisor, 1).to(divisor).begins(Begin::Zero));
    for (magnitude, unit) in MAGNITUDE.iter().zip(UNIT) {
        quotient(&mut w, *magnitude, divisor, unit);
    }
    w.push(load_constant(0xff));
    for (normal, unit) in NORMAL.iter().zip(UNIT) {
        w.with_sign(normal.of(word), unit, unit);
    }
    w.0
}

/// The square of 16 bits h || l: `h^2 2^16 + 2 h l 2^8 + l^2`. If 2 h has more than 8 bits, l is 0.
fn square(w: &mut Writer, of: Field, to: Field) {
    let (l, h) = (of.byte(0), of.byte(1));
    w.push(carried(Function::ShiftLeft, h).loads().begins(Begin::Zero));
    w.product(ZERO, l, 8, [CROSS.byte(1), CROSS.byte(0)]);
    w.push(load(h));
    w.product(CROSS.byte(1), h, 8, [to.byte(3), to.byte(2)]);
    w.push(load(l));
    w.product(ZERO, l, 8, [to.byte(1), to.byte(0)]);
    w.push(load(CROSS.byte(0)));
    w.push(with_accumulator(Function::Add, to.byte(1)).writes(to.byte(1)).begins(Begin::Zero));
    let above = Field::new(to.byte(2), 2);
    w.push(with_constant(Function::Add, above, 0).to(above));
}

/// Writes the square root of [`SUM`] to the lower half of [`ROOT`].
///
/// Before digit j, ROOT is the root found so far times 2^(j + 1), in bits 2 j + 2 to 16 + j. The remainder of the sum
/// is below 2^(18 + j).
fn root(w: &mut Writer) {
    let top = ROOT.byte(3);
    w.extend([
        with_constant(Function::Subtract, Field::new(SUM.byte(3), 1), 0x40)
            .writes(TRIAL.byte(3))
            .begins(Begin::One)
            .flags(Condition::Carry),
        copy(Field::new(TRIAL.byte(3), 1), Field::new(SUM.byte(3), 1)).only(Mask::Flagged),
        set(Field::new(top, 1), 0),
        set(Field::new(top, 1), 0x40).only(Mask::Flagged),
    ]);
    // The lowest byte of ROOT written so far.
    let mut written = 3;
    for digit in (0..15_u64).rev() {
        let (lowest, highest) = (digit / 4, ((17 + digit) / 8).min(3));
        let bit = 1 << (2 * digit % 8);
        for byte in lowest..=highest {
            subtract(w, byte, digit, if byte == lowest { bit } else { 0 });
        }
        if let Some(last) = w.0.last_mut() {
            *last = last.flags(Condition::Carry);
        }
        let part = |of: Field| Field::new(of.byte(lowest), highest + 1 - lowest);
        w.push(copy(part(TRIAL), part(SUM)).only(Mask::Flagged));
        let first = (16 + digit) / 8;
        for byte in ((2 * digit + 1) / 8..=first).rev() {
            let from = if byte < written { ZERO } else { ROOT.byte(byte) };
            let begin = if byte == first { Begin::Zero } else { Begin::Kept };
            w.push(carried(Function::ShiftRight, from).writes(ROOT.byte(byte)).begins(begin));
            written = written.min(byte);
        }
        let set_digit = with_constant(Function::Or, Field::new(ROOT.byte(lowest), 1), bit);
        w.push(set_digit.writes(ROOT.byte(lowest)).only(Mask::Flagged));
    }
}

/// A byte of the trial subtraction for a digit: the sum's byte minus the root's byte with this digit's bit set.
fn subtract(w: &mut Writer, byte: u64, digit: u64, bit: i64) {
    let begin = if byte == digit / 4 { Begin::One } else { Begin::Kept };
    // Whether the root has no bits in this byte.
    let is_empty = 8 * byte + 8 <= 2 * digit + 2 || 8 * byte > 16 + digit;
    let sum = Field::new(SUM.byte(byte), 1);
    let difference = if is_empty {
        with_constant(Function::Subtract, sum, bit)
    } else {
        let root = Field::new(ROOT.byte(byte), 1);
        w.push(with_constant(Function::Or, root, bit).loads());
        with_accumulator(Function::Subtract, sum.address)
    };
    w.push(difference.writes(TRIAL.byte(byte)).begins(begin));
}

/// `floor(remainder 2^12 / divisor)`, where the remainder is less than the divisor.
fn quotient(w: &mut Writer, remainder: Field, divisor: Field, to: Field) {
    // All digits are set at first.
    w.push(set(to, (1 << DIGITS_OF_UNIT) - 1));
    for digit in (0..DIGITS_OF_UNIT).rev() {
        let step = Division { comes_in: false, may_leave: true, is_last: digit == 0 };
        w.divided([remainder.byte(0), remainder.byte(1)], remainder, divisor, step);
        w.quotient_digit(to, digit);
    }
}
