//! A square of small processors that all execute the same instruction on their own data.
//!
//! ```text
//!                    sequencer                column terms a x + c, one for each column
//!                        | instruction           |    |         |
//!     row term b y       v                       v    v         v
//!          |      .-------------.
//!          '----->|   row 0     |  [processor][processor] .. [processor] --xor--> sum of the row
//!                 '-------------'
//!                       ..
//!                 [  row n - 1  ]
//! ```
//!
//! It tests thousands of small state machines under one select, and reductions of them.

mod instruction;
mod processor;
mod row;
mod sequencer;

use tilewright_hdl::{Module, bit, bits, block, constants, def, lit, mux};

use super::{BenchIn, BenchOut};
use row::{Row, RowIn};
use sequencer::{Plane, Sequencer, SequencerIn};

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
        let issued = m.instance("u_sequencer", &Sequencer, SequencerIn { rst: i.rst });
        let Plane { a, b, c } = issued.plane;
        let columns: Vec<_> = (0..self.edge).map(|x| a.times(lit(8, x)).trunc(8) + c).collect();
        let rows = m.array("u_row", self.edge, &Row { processors: self.edge }, |_| RowIn {
            rst: i.rst,
            instruction: issued.instruction,
            columns,
            b,
            y: constants(bits(8).of(self.edge), u64::from),
        });
        let folded = rows.sum.to_vec().into_iter().reduce(|folded, sum| folded.rotate_left(1) ^ sum);
        def!(csum = m.reg(32));
        let sum = csum.rotate_left(1) + folded.expect("an array has a lane").zext(32);
        csum.next(mux(i.rst, 0, sum));
        BenchOut { csum: *csum }
    }
}
