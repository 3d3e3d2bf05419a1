//! Steps of multiplication and division that shading is made of, and what a program is written with.

use super::super::fields::Field;
use super::super::fields::shading::{DIGITS, ONES, TRIAL, ZERO};
use super::super::instruction::Instruction;
use super::super::pixel::{Begin, Condition, Function, Mask, Source};
use super::assembler::{alu, carried, copy, load, set, with_accumulator, with_constant};

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

    /// The constants of [`shading`](super::super::fields::shading): 2 clocks.
    pub fn constants(&mut self) {
        self.push(set(Field::new(ZERO, 2), 0xff00));
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

    /// `floor(a (b + 1) / 2^8)`; the last instruction, which is left to the caller's choice, is the one that writes it. 17 clocks.
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

    /// A step of restoring division, 10 clocks: the carry comes into a remainder of 16 bits, and what leaves it counts; then the carry is the digit
    /// of the quotient. `from` are the addresses of the remainder's bytes before.
    pub fn divided(&mut self, from: [u64; 2], remainder: Field, divisor: Field, step: Division) {
        let begin = if step.comes_in { Begin::Kept } else { Begin::Zero };
        self.push(carried(Function::ShiftLeft, from[0]).writes(remainder.byte(0)).begins(begin));
        let upper = carried(Function::ShiftLeft, from[1]).writes(remainder.byte(1));
        self.push(if step.may_leave { upper.flags(Condition::Carry) } else { upper });
        let trial = Field::new(TRIAL.address, 2);
        self.pair(Function::Subtract, remainder, divisor, trial);
        if step.may_leave {
            // The divisor's upper byte still is in the accumulator; it is not 0 where a bit has left.
            self.push(alu(Function::Add, Source::Multiplicand).reads(ONES));
        }
        if let Some(last) = self.0.last_mut() {
            *last = last.flags(Condition::Carry);
        }
        if !step.is_last {
            self.push(copy(trial, remainder).only(Mask::Flagged));
        }
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
