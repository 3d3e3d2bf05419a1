//! Processors of the RISC-V kind, each with a program and memories of its own.
//!
//! It tests one long chain from a register through a table, two reads and a choice of many results, with nothing
//! similar beside it.

mod processor;
mod program;

use tilewright_hdl::{Module, bit, bits, block, constants, def, mux};

use super::{BenchIn, BenchOut};
use crate::word::seed;
pub use processor::{Processor, ProcessorIn, ProcessorOut};

block! {
    /// Processors that sort and mix words, and a checksum of everything that they write.
    pub struct Core {
        /// The number of processors, at least 1.
        pub processors: u32,
    }
    in = BenchIn { rst: bit() };
    out = BenchOut { csum: bits(32) };
}

impl Core {
    fn build(&self, m: Module, i: BenchIn) -> BenchOut {
        let processors = m.array("u_processor", self.processors, &Processor, |_| ProcessorIn {
            rst: i.rst,
            word: constants(bits(32).of(self.processors), seed),
        });
        let folded = processors.sum.to_vec().into_iter().reduce(|folded, sum| folded.rotate_left(1) ^ sum);
        def!(csum = m.reg(32));
        csum.next(mux(i.rst, 0, csum.rotate_left(3) + folded.expect("an array has a lane")));
        BenchOut { csum: *csum }
    }
}
