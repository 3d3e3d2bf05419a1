//! Steps of multiplication and division that shading is made of, and what a program is written with.

use super::super::fields::Field;
use super::super::fields::shading::{DIGITS, DOUBLED, ZERO};
use super::super::instruction::Instruction;
use super::super::pixel::{Begin, Condition, Enabling, Flagging, Function, Mask, Source};
use super::assembler::{alu, carried, copy, load, set, with_accumulator, with_constant};
use crate::prelude::Codes;

/// A program that is being written.
#[derive(Debug, Default)]
pub(super) struct Writer(pub Vec<Instruction<u64>>);

impl Writer {
    pub fn push(&mut self, instruction: Instruction<u64>) {
        self.0.push(instruction);
    }

    pub fn extend(&mut self, instructions: impl IntoIterator<Item = Instruction<u64>>) {
        self.0.extend(instructions);
    }

    /// The zero that products begin with: 1 clock.
    pub fn zero(&mut self) {
        self.push(set(Field::new(ZERO, 1), 0));
    }

    /// The flag becomes a multiplier's lowest digit, the others go on to another byte.
    pub fn digit(&mut self, from: u64, to: u64, begin: Begin) {
        self.push(carried(Function::ShiftRight, from).writes(to).begins(begin).flags(Condition::Carry));
    }

    /// To `to` goes half of what is at `from`, with the accumulator where the flag is set.
    pub fn half(&mut self, from: u64, to: u64) {
        self.push(alu(Function::AddHalved, Source::Multiplicand).reads(from).writes(to).begins(Begin::Zero));
    }

    /// The accumulator times so many digits of a multiplier, and the byte at `start`: its lower bits come to the top of `low`, and those
    /// above them to `high`. 1 clock and 2 a digit.
    pub fn product(&mut self, start: u64, multiplier: u64, digits: u32, [high, low]: [u64; 2]) {
        self.digit(multiplier, low, Begin::Zero);
        for number in 0..digits {
            self.half(if number == 0 { start } else { high }, high);
            self.digit(low, low, Begin::Kept);
        }
    }

    /// `floor(a (b + 1) / 2^8)` of the bytes at two addresses; a may be where it goes. 17 clocks.
    pub fn scaled(&mut self, a: u64, b: u64, to: u64) {
        self.push(load(a));
        self.digit(b, DIGITS, Begin::Zero);
        self.half(a, to);
        for _ in 1..8 {
            self.digit(DIGITS, DIGITS, Begin::Zero);
            self.half(to, to);
        }
    }

    /// The last result goes to the accumulator alone.
    pub fn last_to_accumulator(&mut self) {
        if let Some(last) = self.0.last_mut() {
            *last = Instruction { stores: 0, accumulates: 1, ..*last };
        }
    }

    /// A number with another of two bytes, which goes to a third: 4 clocks.
    pub fn pair(&mut self, function: Function, from: Field, other: Field, to: Field) {
        let begin = if function == Function::Add { Begin::Zero } else { Begin::One };
        for byte in 0..other.bytes {
            let begin = if byte == 0 { begin } else { Begin::Kept };
            self.push(load(other.byte(byte)));
            self.push(with_accumulator(function, from.byte(byte)).writes(to.byte(byte)).begins(begin));
        }
    }

    /// A number goes to another, negative where a number of two bytes is; `from` may be the same. The accumulator is 255. 5 clocks.
    pub fn with_sign(&mut self, sign: Field, from: Field, to: Field) {
        self.push(carried(Function::ShiftLeft, sign.top()).begins(Begin::Zero).flags(Condition::Carry));
        for byte in 0..from.bytes {
            let inverts = alu(Function::ExclusiveOr, Source::Multiplicand);
            self.push(inverts.reads(from.byte(byte)).writes(to.byte(byte)));
        }
        // And one more, which the carry is.
        self.push(with_constant(Function::Add, to, 0).to(to));
    }

    /// A step of restoring division, of a remainder of 16 bits that is less than the divisor: it and the digit that the carry is, less the divisor
    /// where that is not the greater. Where it is, the flag tells. 8 clocks, or 6 without the remainder.
    ///
    /// `from` are the addresses of the remainder's bytes before. It uses the top enable flag.
    pub fn divided(&mut self, from: [u64; 2], remainder: Field, divisor: Field, step: Division) {
        let doubled = Field::new(DOUBLED.address, 2);
        let begin = if step.comes_in { Begin::Kept } else { Begin::Zero };
        self.push(carried(Function::ShiftLeft, from[0]).writes(doubled.byte(0)).begins(begin));
        let upper = carried(Function::ShiftLeft, from[1]).writes(doubled.byte(1));
        // A bit that leaves makes it greater than any divisor.
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

    /// The digit of a quotient goes where the flag is set: 1 clock.
    pub fn quotient_digit(&mut self, quotient: Field, digit: u64) {
        let byte = Field::new(quotient.byte(digit / 8), 1);
        self.push(with_constant(Function::And, byte, !(1 << (digit % 8))).to(byte).only(Mask::Flagged));
    }
}

/// What is known of a step of division.
#[derive(Debug, Clone, Copy)]
pub(super) struct Division {
    /// The carry is a digit of the dividend; else it is 0.
    pub comes_in: bool,
    /// A bit may leave the remainder's 16: the divisor has as many.
    pub may_leave: bool,
    /// What remains is not needed.
    pub is_last: bool,
}
