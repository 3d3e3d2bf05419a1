//! The multiplication and division steps of shading, and the builder of its programs.

use super::super::fields::Field;
use super::super::fields::shading::{DIGITS, DOUBLED, ZERO};
use super::super::instruction::Instruction;
use super::super::pixel::{Begin, Condition, Enabling, Flagging, Function, Mask, Source};
use super::assembler::{alu, carried, copy, load, set, with_accumulator, with_constant};
use crate::prelude::Codes;

/// A program under construction.
#[derive(Debug, Default)]
pub(super) struct Writer(pub Vec<Instruction<u64>>);

impl Writer {
    pub fn push(&mut self, instruction: Instruction<u64>) {
        self.0.push(instruction);
    }

    pub fn extend(&mut self, instructions: impl IntoIterator<Item = Instruction<u64>>) {
        self.0.extend(instructions);
    }

    /// Writes the zero that starts a product: 1 clock.
    pub fn zero(&mut self) {
        self.push(set(Field::new(ZERO, 1), 0));
    }

    /// Moves the lowest digit of a multiplier to the flag, and writes the other digits to `to`.
    pub fn digit(&mut self, from: u64, to: u64, begin: Begin) {
        self.push(carried(Function::ShiftRight, from).writes(to).begins(begin).flags(Condition::Carry));
    }

    /// Writes to `to` half of the byte at `from`, to which it first adds the accumulator if the flag is set.
    pub fn half(&mut self, from: u64, to: u64) {
        self.push(alu(Function::AddHalved, Source::Multiplicand).reads(from).writes(to).begins(Begin::Zero));
    }

    /// Multiplies the accumulator by `digits` digits of a multiplier, and adds the byte at `start`. The lower bits of
    /// the result go to the top of `low`, and the others to `high`. 1 clock, and 2 per digit.
    pub fn product(&mut self, start: u64, multiplier: u64, digits: u32, [high, low]: [u64; 2]) {
        self.digit(multiplier, low, Begin::Zero);
        for number in 0..digits {
            self.half(if number == 0 { start } else { high }, high);
            self.digit(low, low, Begin::Kept);
        }
    }

    /// `floor(a (b + 1) / 2^8)` for the bytes at addresses `a` and `b`. The result may replace a. 17 clocks.
    pub fn scaled(&mut self, a: u64, b: u64, to: u64) {
        self.push(load(a));
        self.digit(b, DIGITS, Begin::Zero);
        self.half(a, to);
        for _ in 1..8 {
            self.digit(DIGITS, DIGITS, Begin::Zero);
            self.half(to, to);
        }
    }

    /// Changes the last instruction to write only the accumulator.
    pub fn last_to_accumulator(&mut self) {
        if let Some(last) = self.0.last_mut() {
            *last = Instruction { stores: 0, accumulates: 1, ..*last };
        }
    }

    /// Combines a number with one of two bytes into a third: 4 clocks.
    pub fn pair(&mut self, function: Function, from: Field, other: Field, to: Field) {
        let begin = if function == Function::Add { Begin::Zero } else { Begin::One };
        for byte in 0..other.bytes {
            let begin = if byte == 0 { begin } else { Begin::Kept };
            self.push(load(other.byte(byte)));
            self.push(with_accumulator(function, from.byte(byte)).writes(to.byte(byte)).begins(begin));
        }
    }

    /// Copies a number of two bytes, and negates it if `sign` is negative; `from` may be `sign`. The accumulator must
    /// be 255. 5 clocks.
    pub fn with_sign(&mut self, sign: Field, from: Field, to: Field) {
        self.push(carried(Function::ShiftLeft, sign.top()).begins(Begin::Zero).flags(Condition::Carry));
        for byte in 0..from.bytes {
            let inverts = alu(Function::ExclusiveOr, Source::Multiplicand);
            self.push(inverts.reads(from.byte(byte)).writes(to.byte(byte)));
        }
        // The carry, which is 1 for a negative sign, adds one.
        self.push(with_constant(Function::Add, to, 0).to(to));
    }

    /// A step of restoring division, for a remainder of 16 bits that is less than the divisor. It appends the digit in
    /// the carry to the remainder, and subtracts the divisor unless that is greater. The flag is set if it does not
    /// subtract. 8 clocks, or 6 if the remainder is not restored.
    ///
    /// `from` has the addresses of the previous remainder's bytes. The step may change the top enable flag.
    pub fn divided(&mut self, from: [u64; 2], remainder: Field, divisor: Field, step: Division) {
        let doubled = Field::new(DOUBLED.address, 2);
        let begin = if step.comes_in { Begin::Kept } else { Begin::Zero };
        self.push(carried(Function::ShiftLeft, from[0]).writes(doubled.byte(0)).begins(begin));
        let upper = carried(Function::ShiftLeft, from[1]).writes(doubled.byte(1));
        // A bit that leaves makes the remainder greater than any divisor.
        self.push(if step.may_leave { upper.enables(Enabling::Replace, Condition::NoCarry) } else { upper });
        self.pair(Function::Subtract, doubled, divisor, remainder);
        let flagging = if step.may_leave { Flagging::EnabledCondition } else { Flagging::Condition };
        if let Some(last) = self.0.last_mut() {
            *last = Instruction { flagging: flagging.code(), condition: Condition::NoCarry.code(), ..*last };
        }
        if !step.is_last {
            self.push(copy(doubled, remainder).only(Mask::Flagged));
        }
    }

    /// Clears the quotient's digit if the flag is set: 1 clock.
    pub fn quotient_digit(&mut self, quotient: Field, digit: u64) {
        let byte = Field::new(quotient.byte(digit / 8), 1);
        self.push(with_constant(Function::And, byte, !(1 << (digit % 8))).to(byte).only(Mask::Flagged));
    }
}

/// The options of a step of division.
#[derive(Debug, Clone, Copy)]
pub(super) struct Division {
    /// The carry is a digit of the dividend; otherwise it is 0.
    pub comes_in: bool,
    /// A bit may leave the remainder's 16 bits, because the divisor also has 16.
    pub may_leave: bool,
    /// The remainder is not needed afterwards.
    pub is_last: bool,
}
