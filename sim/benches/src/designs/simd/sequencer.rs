//! The source of the instructions: opcodes from a short program, operands from a random generator.

use tilewright_hdl::{Module, Signal, bit, bits, block, case, def, one_of};

use super::opcode::{Opcode, Opcode::*};
use crate::word::xorshift;

const SEED: u64 = 0x123_4567;

const PROGRAM: [[Opcode; 8]; 4] = [
    [Everybody, Plane, Store, Add, AddPlane, IfAtLeast, Subtract, Store],
    [Load, Xor, IfLess, Plane, Store, Else, AddConstant, Store],
    [Everybody, Load, And, AddPlane, Halve, Store, XorConstant, IfAtLeast],
    [Add, Store, Subtract, IfLess, AddPlane, Store, Nothing, Xor],
];

block! {
    /// Issues an instruction every clock.
    pub struct Sequencer;
    in SequencerIn {
        rst: bit(),
    }
    out SequencerOut {
        /// An instruction, in its two clocks.
        instruction: pub struct Instruction {
            /// The operand's address, a clock ahead of the rest.
            read_address: bits(8),
            /// The operation.
            opcode: one_of::<Opcode>(),
            /// The address of a result.
            write_address: bits(8),
            /// A constant.
            constant: bits(8),
        },
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
        def!(pc = m.reg(5));
        def!(random = m.reg(32));
        pc.when(i.rst, 0).otherwise(pc + 1);
        random.when(i.rst, SEED).otherwise(xorshift(*random));
        let opcode = case(*pc, (0..).zip(PROGRAM.into_iter().flatten()), Signal::from(Nothing));
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
