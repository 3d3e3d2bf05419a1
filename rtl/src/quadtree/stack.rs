//! The raster processor's form of least hardware: one unit, and a stack for the windows that are still to be divided (MPG-RP).
//!
//! ```text
//!            .-----------.      .------.
//! works ====>| [windows] |=====>| test |==+===> leaves
//!            '-----------'      '------'  |
//!                  ^ last in, first out   |
//!                  '======================'
//! ```
//!
//! A window that passes is divided next if the unit is free, else put on the stack; a polygon is taken when that is empty. So the
//! stack never holds more than three windows of each size, and all windows are of one polygon, which is not stored with
//! them.
//!
//! Latency and throughput: those of the unit, which never waits while there are windows to divide (MPG-EQ6).

use super::coverage_test::{CoverageTest, CoverageTestIn, Test};
use super::format::{Format, Work};
use super::tally::Tally;
use crate::prelude::*;

block! {
    /// Divides windows down to a size, with one unit and a stack.
    pub struct Stack {
        /// The generator that it is a part of.
        pub format: Format,
        /// How the edges are tested.
        pub test: Test,
        /// The size of the windows that come in: the binary logarithm of their side.
        pub from: u32,
        /// How often they are divided.
        pub levels: u32,
    }
    latency = "one unit tests all windows of a polygon, one after another";
    source = "sparse-raster quadtree generator, equation 6 (MPG-RP, MPG-EQ6)";
    in(self) StackIn {
        /// Windows with their polygons.
        works: stream(Work = self.format.work()),
    }
    out(self) StackOut {
        /// What is left of them when they are divided.
        leaves: stream(Work = self.format.work()),
        /// No window is held.
        idle: bit(),
        /// What was done on each level.
        tally: [Tally = Tally::widths(); self.levels],
    }
}

impl Stack {
    fn build(&self, m: Module, i: StackIn) -> StackOut {
        let Stack { format, test, from, levels } = *self;
        let next = m.stream_wire("next", format.work());
        let unit = CoverageTest { format, test, from, sizes: levels };
        let tested = m.instance("u_test", &unit, CoverageTestIn { works: next.value() });

        // A quarter is a leaf, or is divided again.
        let child = &tested.children;
        net!(is_leaf = child.window.size.eq(from - levels));
        let (leaves, _) = m.offer(child.valid & is_leaf, child.payload);
        child.take_when(!is_leaf | leaves.ready);
        net!(comes_back = child.valid & !is_leaf);

        // What is divided next: the newest window. Of what it offers the unit takes what is there when it is free.
        let depth = (3 * (levels - 1)).max(1);
        let word = child.with(child.window).packed();
        let windows = m.memory("windows", depth, word.width(), ReadUnderWrite::Any);
        let used = m.reg("used", up_to(depth)).reset(0);
        let newest = child.with(windows.read_async((used - 1).trunc(windows.address_width()))).unpacked(&child.window);
        net!(is_empty = used.eq(0));
        let again = Work { polygon: child.polygon, window: mux(comes_back, child.window, newest.payload) };
        net!(is_new = is_empty & !comes_back);
        let (offered, taken) = m.offer(!is_new | i.works.valid, mux(is_new, i.works.payload, again));
        i.works.take_when(is_new & offered.ready);
        next.drive(offered);

        net!(pushes = comes_back & !taken);
        net!(pops = taken & !comes_back & !is_empty);
        windows.write(pushes, used.trunc(windows.address_width()), *word);
        used.when(pushes, used + 1).when(pops, used - 1);
        m.assert(pushes.implies(used.ne(depth)), "of each size three windows are held at most");
        m.cover("the stack is full", m.rose(used.eq(depth)));
        StackOut { leaves, idle: tested.idle, tally: tested.tally }
    }
}
