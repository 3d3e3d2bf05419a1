//! A row of processors, and the exclusive or of their results.

use tilewright_hdl::{Module, bit, bits, block, stack};

use super::instruction::Instruction;
use super::processor::{Processor, ProcessorIn};

block! {
    /// One of the rows.
    pub struct Row {
        pub processors: u32,
    }
    in(self) RowIn {
        rst: bit(),
        instruction: Instruction = Instruction::widths(),
        /// The term of the plane for each column.
        columns: [bits(8); self.processors],
        /// The growth of the plane from one row to the next.
        b: bits(8),
        /// The number of the row.
        y: bits(8),
    }
    out RowOut {
        /// The exclusive or, one clock later.
        sum: bits(8),
    }
}

impl Row {
    fn build(&self, m: Module, i: RowIn) -> RowOut {
        let term = i.b.times(i.y).trunc(8).named("term");
        let processors = m.array("u_processor", self.processors, &Processor, |_| ProcessorIn {
            rst: i.rst,
            instruction: i.instruction,
            column: stack(i.columns),
            row: term,
        });
        RowOut { sum: m.pipe("sum", processors.contribution.xor_all()) }
    }
}
