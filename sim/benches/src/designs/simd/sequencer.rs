//! The source of the instructions: opcodes from a short program, operands from a random generator.

use tilewright_hdl::{Module, bit, bits, block, case, mux};

use super::instruction::{Instruction, Opcode, Opcode::*};
use crate::word::xorshift;

const SEED: u64 = 0x123_4567;

const PROGRAM: [Opcode; 32] = [
    Everybody,
    Plane,
    Store,
    Add,
    AddPlane,
    IfAtLeast,
    Subtract,
    Store, //
    Load,
    Xor,
    IfLess,
    Plane,
    Store,
    Else,
    AddConstant,
    Store, //
    Everybody,
    Load,
    And,
    AddPlane,
    Halve,
    Store,
    XorConstant,
    IfAtLeast, //
    Add,
    Store,
    Subtract,
    IfLess,
    AddPlane,
    Store,
    Nothing,
    Xor,
];

block! {
    /// Issues an instruction every clock.
    pub struct Sequencer;
    in SequencerIn {
        rst: bit(),
    }
    out SequencerOut {
        instruction: Instruction = Instruction::widths(),
        /// The plane a x + b y + c, a clock after the address of the instruction's operand.
        plane: pub struct Plane {
            a: bits(8),
            b: bits(8),
            c: bits(8),
        },
    }
}

impl Sequencer {
    fn build(&self, m: Module, i: SequencerIn) -> SequencerOut {
        let (pc, random) = (m.reg("pc", 5), m.reg("random", 32));
        pc.next(mux(i.rst, 0, pc + 1));
        random.next(mux(i.rst, SEED, xorshift(*random)));
        let program = (0..).zip(PROGRAM.map(|opcode| opcode as u64));
        let opcode = case(*pc, program, tilewright_hdl::lit(4, 0));
        SequencerOut {
            instruction: Instruction {
                read_address: random.slice(0..8),
                opcode: m.pipe("opcode", opcode),
                write_address: m.pipe("write_address", random.slice(8..16)),
                constant: m.pipe("constant", random.slice(16..24)),
            },
            plane: m.pipe("plane", Plane { a: random.part(24, 8), b: random.part(4, 8), c: random.part(12, 8) }),
        }
    }
}
