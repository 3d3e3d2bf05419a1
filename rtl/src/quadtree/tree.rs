//! The raster processor's form with the most hardware: the quarters of a window are divided side by side (MPG-RP,
//! MPG-TREE).
//!
//! ```text
//!                               .-- 0 -->[ tree ]--.
//!         .-------.   .------.  +-- 1 -->[ tree ]--+
//! works =>| queue |==>| test |=>|                  |==> parts
//!         '-------'   '------'  +-- 2 -->[ tree ]--+
//!                               '-- 3 -->[ tree ]--'
//! ```
//!
//! A tree of one level is its unit alone. Windows at the same place always take the same path, so they stay in the
//! sequence of their polygons.
//!
//! Latency and throughput are those of the first unit, unless the parts, which come one after another, take longer.

use tilewright_blocks::{StreamBlocks, Turns};

use super::coverage_test::{CoverageTest, Test};
use super::divider::{DividerIn, DividerOut};
use super::format::{Format, Work};
use crate::prelude::*;

block! {
    /// Divides windows in a tree of units, which divide the quarters side by side.
    pub struct Tree {
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
    latency = "the clocks of the slowest unit; the quarters of a window are divided at the same time";
    source = "sparse-raster quadtree generator, figure 1 (MPG-RP, MPG-TREE)";
    in(self) = DividerIn::widths(self.format);
    out(self) = DividerOut::widths(self.format, self.levels);
}

impl Tree {
    fn build(&self, m: Module, i: DividerIn) -> DividerOut {
        let Tree { format, test, from, levels, queue } = *self;
        let works = m.fifo("u_queue", queue, i.works);
        let unit = CoverageTest { format, test, from, sizes: 1 };
        def!(test = m.instance(&unit, DividerIn { works }));
        let DividerOut { parts, idle, mut tally } = test;
        if levels == 1 {
            return DividerOut { parts, idle, tally };
        }
        let quarter = |work: &Work| cat![work.window.y.bit(from - 1), work.window.x.bit(from - 1)];
        let quarters: [_; 4] = m.split_by(parts, quarter);
        let tree = Tree { from: from - 1, levels: levels - 1, ..*self };
        def!(branch = m.array(4, &tree, |_| DividerIn { works: stack(quarters) }));
        tally.extend(branch.tally.iter().map(|unit| unit.map(|count| count.sum())));
        let parts = m.arbiter("u_arbiter", Turns::RoundRobin, branch.parts.lanes());
        DividerOut { parts, idle: idle & branch.idle.and_all(), tally }
    }
}
