//! The raster processor's form with a unit for each level, all of which work at the same time (MPG-RP, MPG-EQ9).
//!
//! ```text
//!         .-------.   .------.   .-------.   .------.
//! works =>| queue |==>| test |==>| queue |==>| test |==> .. ==> leaves
//!         '-------'   '------'   '-------'   '------'
//! ```
//!
//! Latency and throughput: those of the slowest unit. A queue takes a clock, and evens out what the units before and behind it
//! need for a window; one that is full makes them wait.

use tilewright_blocks::StreamBlocks;

use super::coverage_test::{CoverageTest, CoverageTestIn, Test};
use super::format::{Format, Work};
use super::tally::Tally;
use crate::prelude::*;

block! {
    /// Divides windows in a unit for each level.
    pub struct Pipe {
        /// The generator that it is a part of.
        pub format: Format,
        /// How the edges are tested.
        pub test: Test,
        /// The size of the windows that come in: the binary logarithm of their side.
        pub from: u32,
        /// How often they are divided.
        pub levels: u32,
        /// The windows that the queue before each unit holds.
        pub queue: u32,
    }
    latency = "the units of all levels work at the same time";
    source = "sparse-raster quadtree generator, equation 9 (MPG-RP, MPG-EQ9)";
    in(self) PipeIn {
        /// Windows with their polygons.
        works: stream(Work = self.format.work()),
    }
    out(self) PipeOut {
        /// What is left of them when they are divided.
        leaves: stream(Work = self.format.work()),
        /// No window is held.
        idle: bit(),
        /// What was done on each level.
        tally: [Tally = Tally::widths(); self.levels],
    }
}

impl Pipe {
    fn build(&self, m: Module, i: PipeIn) -> PipeOut {
        let Pipe { format, test, from, levels, queue } = *self;
        let (mut works, mut idle, mut tally) = (i.works, lit(1, 1), Vec::new());
        for level in 0..levels {
            works = m.fifo(&format!("u_queue{level}"), queue, works);
            let unit = CoverageTest { format, test, from: from - level, sizes: 1 };
            let tested = m.instance(&format!("u_test{level}"), &unit, CoverageTestIn { works });
            works = tested.children;
            idle &= tested.idle;
            tally.extend(tested.tally);
        }
        PipeOut { leaves: works, idle, tally }
    }
}
