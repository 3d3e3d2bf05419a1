//! Where the instructions come from: opcodes from a short program, operands from a random generator.

use tilewright_hdl::{Block, Module, Width, bit, bundle, case, mux};

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

bundle! {
    /// The inputs of [`Sequencer`].
    pub struct SequencerIn<T> {
        pub rst: T,
    }

    /// The outputs of [`Sequencer`].
    pub struct SequencerOut<T> {
        pub instruction: Instruction<T>,
        /// a, b and c of the plane a x + b y + c, a clock after the address of the instruction's operand.
        pub coefficients: [T; 3],
    }
}

/// Issues an instruction every clock.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Sequencer;

impl Block for Sequencer {
    type In = SequencerIn;
    type Out = SequencerOut;

    fn inputs(&self) -> SequencerIn<Width> {
        SequencerIn { rst: bit() }
    }

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
            coefficients: [("a", 24), ("b", 4), ("c", 12)].map(|(name, low)| m.pipe(name, random.slice(low..low + 8))),
        }
    }

    fn name(&self) -> String {
        "simd_sequencer".to_owned()
    }
}
