//! A row of processors, and the exclusive or of their results.

use tilewright_hdl::{Block, Module, Width, bit, bits, bundle, stack};

use super::instruction::Instruction;
use super::processor::{Processor, ProcessorIn};

bundle! {
    /// The inputs of [`Row`].
    pub struct RowIn<T> {
        pub rst: T,
        pub instruction: Instruction<T>,
        /// The term of the plane for each column.
        pub columns: Vec<T>,
        /// What the plane grows by from a row to the next.
        pub b: T,
        /// The number of the row.
        pub y: T,
    }

    /// The outputs of [`Row`].
    pub struct RowOut<T> {
        /// Of the clock before.
        pub sum: T,
    }
}

/// One of the rows.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Row {
    pub processors: u32,
}

impl Block for Row {
    type In = RowIn;
    type Out = RowOut;

    fn inputs(&self) -> RowIn<Width> {
        let columns = vec![bits(8); self.processors as usize];
        RowIn { rst: bit(), instruction: Instruction::widths(), columns, b: bits(8), y: bits(8) }
    }

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

    fn name(&self) -> String {
        format!("simd_row_{}", self.processors)
    }
}
