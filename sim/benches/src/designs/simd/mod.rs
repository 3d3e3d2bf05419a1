//! A square of small processors that all execute the same instruction on their own data, as a grid of lanes.
//!
//! ```text
//!                    sequencer          column terms a x + c
//!                        | instruction     |   |       |
//!     row terms b y      v                 v   v       v
//!          |           .------------------------------------.
//!          '---------->|  processors: accumulator, active,  |--xor of each row--> sums --> checksum
//!                      |  256 bytes each                    |
//!                      '------------------------------------'
//! ```
//!
//! It tests thousands of small state machines under one select, and reductions of them.

mod opcode;
mod sequencer;

use tilewright_hdl::{Module, ReadUnderWrite, bit, bits, block, choose, constants, def, grid, mux, row};

use super::{BenchIn, BenchOut};
use opcode::Opcode;
use sequencer::{Instruction, Plane, Sequencer, SequencerIn};

block! {
    /// A square of processors under one instruction.
    pub struct Simd {
        /// Processors in a row, and rows; from 1 to 256.
        pub edge: u32,
    }
    in = BenchIn { rst: bit() };
    out = BenchOut { csum: bits(32) };
}

impl Simd {
    fn build(&self, m: Module, i: BenchIn) -> BenchOut {
        let (edge, rst) = (self.edge, i.rst);
        let processors = grid(edge, edge);
        def!(sequencer = m.instance(&Sequencer, SequencerIn { rst }));
        let Instruction { read_address, opcode, write_address, constant } = sequencer.instruction;

        // The plane a x + b y + c at each processor.
        let Plane { a, b, c } = sequencer.plane;
        let numbers = constants(bits(8).of(row(edge)), u64::from);
        def!(column = a.times(numbers).trunc(8) + c);
        def!(term = b.times(numbers).trunc(8));
        def!(plane = column.to_rows(edge) + term.to_columns(edge));

        def!(accumulator = m.reg(bits(8).of(processors)));
        def!(active = m.reg(bit().of(processors)));
        def!(memory = m.memory(256, bits(8).of(processors), ReadUnderWrite::Old).fill(0));
        def!(operand = memory.read(read_address));
        let result = choose!(opcode, Opcode {
            Load => operand,
            Add => accumulator + operand,
            Subtract => accumulator - operand,
            Plane => plane,
            AddConstant => accumulator + constant,
            And => accumulator & operand,
            Xor => accumulator ^ operand,
            Halve => accumulator >> 1,
            AddPlane => accumulator + plane,
            XorConstant => accumulator ^ constant,
            _ => accumulator,
        });
        accumulator.when(rst, 0).when(active, result);
        active
            .when(rst | opcode.is(Opcode::Everybody), 1)
            .when(opcode.is(Opcode::IfLess), active & accumulator.lt(operand))
            .when(opcode.is(Opcode::IfAtLeast), active & accumulator.ge(constant))
            .when(opcode.is(Opcode::Else), !active);
        memory.write(active & opcode.is(Opcode::Store), write_address, accumulator);

        def!(sums = m.pipe(mux(active, *accumulator, 0).columns().xor_all()));
        let folded = sums.to_vec().into_iter().reduce(|folded, sum| folded.rotate_left(1) ^ sum);
        def!(csum = m.reg(32));
        let sum = csum.rotate_left(1) + folded.expect("a row has a lane").zext(32);
        csum.when(rst, 0).otherwise(sum);
        BenchOut { csum: *csum }
    }
}
