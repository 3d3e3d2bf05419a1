//! The raster processor's form with a unit for each level, all of which work at the same time (MPG-RP, MPG-EQ9).
//!
//! ```text
//!         .-------.   .------.   .-------.   .------.
//! works =>| queue |==>| test |==>| queue |==>| test |==> .. ==> parts
//!         '-------'   '------'   '-------'   '------'
//! ```
//!
//! Latency and throughput are those of the slowest unit. A queue takes a clock, and evens out the times that its
//! neighbours need for a window. If a queue is full, the units before it wait.

use tilewright_blocks::StreamBlocks;

use super::coverage_test::{CoverageTest, Test};
use super::divider::{DividerIn, DividerOut};
use super::format::Format;
use crate::prelude::*;

block! {
    /// Divides windows, with a unit for each level.
    pub struct Pipe {
        /// The generator's format.
        pub format: Format,
        /// How the edges are tested.
        pub test: Test,
        /// The size of the input windows: the binary logarithm of their side.
        pub from: u32,
        /// The number of divisions.
        pub levels: u32,
        /// The capacity of the queue before each unit, in windows.
        pub queue: u32,
    }
    latency = "the clocks of the slowest level; the units of all levels work at the same time";
    source = "sparse-raster quadtree generator, equation 9 (MPG-RP, MPG-EQ9)";
    in(self) = DividerIn::widths(self.format);
    out(self) = DividerOut::widths(self.format, self.levels);
}

impl Pipe {
    fn build(&self, m: Module, i: DividerIn) -> DividerOut {
        let Pipe { format, test, from, levels, queue } = *self;
        let (mut works, mut idle, mut tally) = (i.works, lit(1, 1), Vec::new());
        for level in 0..levels {
            works = m.fifo(&format!("u_queue{level}"), queue, works);
            let unit = CoverageTest { format, test, from: from - level, sizes: 1 };
            let tested = m.instance(&format!("u_test{level}"), &unit, DividerIn { works });
            works = tested.parts;
            idle &= tested.idle;
            tally.extend(tested.tally);
        }
        DividerOut { parts: works, idle, tally }
    }
}
