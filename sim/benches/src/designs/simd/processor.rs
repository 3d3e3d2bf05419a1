//! A processor of the array: an accumulator, 256 bytes, and a flag that says whether it is active.

use tilewright_hdl::{Bits, Module, ReadUnderWrite, bit, bits, block, case, def, lit, mux};

use super::instruction::{Instruction, Opcode};

block! {
    /// One of the processors.
    pub struct Processor;
    in ProcessorIn {
        rst: bit(),
        instruction: Instruction = Instruction::widths(),
        /// The term of the plane that depends on the column.
        column: bits(8),
        /// The term of the plane that depends on the row.
        row: bits(8),
    }
    out ProcessorOut {
        /// The accumulator, or 0 if it is inactive.
        contribution: bits(8),
    }
}

impl Processor {
    fn build(&self, m: Module, i: ProcessorIn) -> ProcessorOut {
        let Instruction { read_address, opcode, write_address, constant } = i.instruction;
        def!(memory = m.memory(256, 8, ReadUnderWrite::Old).fill(Bits::zero(8)));
        def!(operand = memory.read(read_address));
        let (a, active) = (m.reg("accumulator", 8), m.reg("active", 1));
        def!(plane = i.column + i.row);

        let results = [
            (Opcode::Load, operand),
            (Opcode::Add, a + operand),
            (Opcode::Subtract, a - operand),
            (Opcode::Plane, plane),
            (Opcode::AddConstant, a + constant),
            (Opcode::And, a & operand),
            (Opcode::Xor, a ^ operand),
            (Opcode::Halve, a >> 1),
            (Opcode::AddPlane, a + plane),
            (Opcode::XorConstant, a ^ constant),
        ];
        def!(result = case(opcode, results.map(|(opcode, result)| (opcode as u64, result)), a));
        a.enable(i.rst | active).next(mux(i.rst, 0, result));

        let conditions = [
            (Opcode::IfLess, active & a.lt(operand)),
            (Opcode::Everybody, lit(1, 1)),
            (Opcode::IfAtLeast, active & a.ge(constant)),
            (Opcode::Else, !active),
        ];
        def!(remains = case(opcode, conditions.map(|(opcode, condition)| (opcode as u64, condition)), active));
        active.next(i.rst | remains);

        memory.write(active & opcode.eq(Opcode::Store as u64), write_address, a);
        ProcessorOut { contribution: mux(active, *a, 0) }
    }
}
