//! A small assembler: functions that make instructions.

use super::super::fields::Field;
use super::super::instruction::{COEFFICIENT, Instruction, Sync};
use super::super::pixel::{Begin, Condition, Enabling, Flagging, Function, Mask, Source};
use super::Expression;
use crate::prelude::Codes;

/// An instruction of one byte that only selects an ALU function and its operand.
pub(super) fn alu(function: Function, source: Source) -> Instruction<u64> {
    Instruction { function: function.code(), source: source.code(), ..Instruction::NOTHING }
}

/// Writes a constant to a number.
pub(super) fn set(to: Field, constant: i64) -> Instruction<u64> {
    alu(Function::Operand, Source::Constant).constant(constant).to(to)
}

/// Copies a number to another field.
pub(super) fn copy(from: Field, to: Field) -> Instruction<u64> {
    alu(Function::Word, Source::Constant).from(from).to(to)
}

/// Copies a byte to the accumulator.
pub(super) fn load(from: u64) -> Instruction<u64> {
    alu(Function::Word, Source::Constant).reads(from).loads()
}

/// Writes a constant to the accumulator.
pub(super) fn load_constant(constant: u8) -> Instruction<u64> {
    alu(Function::Operand, Source::Constant).constant(constant.into()).loads()
}

/// Combines a byte with the accumulator.
pub(super) fn with_accumulator(function: Function, from: u64) -> Instruction<u64> {
    alu(function, Source::Accumulator).reads(from)
}

/// Combines a number with a constant.
pub(super) fn with_constant(function: Function, from: Field, constant: i64) -> Instruction<u64> {
    alu(function, Source::Constant).from(from).constant(constant)
}

/// Combines a byte with the carry and the constant 0.
pub(super) fn carried(function: Function, from: u64) -> Instruction<u64> {
    alu(function, Source::Constant).reads(from)
}

/// Synchronizes with a port.
pub(super) fn port(sync: Sync, number: u64) -> Instruction<u64> {
    Instruction { sync: sync.code(), c: number, ..Instruction::NOTHING }
}

/// Changes only the enable flags.
pub(super) fn enable(enabling: Enabling) -> Instruction<u64> {
    Instruction { enabling: enabling.code(), ..Instruction::NOTHING }
}

/// A number modulo 2 to the width of a coefficient.
fn modular(number: i64) -> u64 {
    number as u64 & ((1 << COEFFICIENT) - 1)
}

impl Instruction<u64> {
    /// Reads a number.
    pub(super) fn from(self, field: Field) -> Self {
        Instruction { length: field.bytes, ..self.reads(field.address) }
    }

    /// Reads from this byte on.
    pub(super) fn reads(self, read: u64) -> Self {
        Instruction { read, ..self }
    }

    /// Writes a number at every pixel.
    pub(super) fn to(self, field: Field) -> Self {
        Instruction { length: field.bytes, ..self.writes(field.address) }
    }

    /// Writes from this byte on, at every pixel.
    pub(super) fn writes(self, write: u64) -> Self {
        Instruction { write, stores: 1, mask: Mask::Everybody.code(), ..self }
    }

    /// Writes the accumulator of every pixel.
    pub(super) fn loads(self) -> Self {
        Instruction { accumulates: 1, mask: Mask::Everybody.code(), ..self }
    }

    /// Restricts the write to these pixels.
    pub(super) fn only(self, mask: Mask) -> Self {
        Instruction { mask: mask.code(), ..self }
    }

    /// Sets the carry into the first byte, which is otherwise the previous carry.
    pub(super) fn begins(self, begin: Begin) -> Self {
        Instruction { begin: begin.code(), ..self }
    }

    /// Sets the flag to the condition.
    pub(super) fn flags(self, condition: Condition) -> Self {
        Instruction { flagging: Flagging::Condition.code(), condition: condition.code(), ..self }
    }

    /// Changes the enable flags by the condition.
    pub(super) fn enables(self, enabling: Enabling, condition: Condition) -> Self {
        Instruction { enabling: enabling.code(), condition: condition.code(), ..self }
    }

    /// Uses this constant.
    pub(super) fn constant(self, constant: i64) -> Self {
        Instruction { c: modular(constant), ..self }
    }

    /// Uses the bytes of an expression from byte `skip` on.
    pub(super) fn expression(self, skip: u64, &Expression { a, b, c }: &Expression) -> Self {
        let [a, b, c] = [a, b, c].map(modular);
        Instruction { source: Source::Expression.code(), skip, a, b, c, ..self }
    }
}

const _: () = assert!(Begin::Kept as u64 == Instruction::NOTHING.begin);
