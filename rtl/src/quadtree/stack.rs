//! The raster processor's form with the least hardware: one unit, and a stack for the windows that are still to be
//! divided (MPG-RP).
//!
//! ```text
//!            .-----------.      .------.
//! works ====>| [windows] |=====>| test |==+===> parts
//!            '-----------'      '------'  |
//!                  ^ last in, first out   |
//!                  '======================'
//! ```
//!
//! A window that passes is divided next if the unit is free; otherwise it is pushed. A polygon is taken when the stack
//! is empty. So the stack never stores more than three windows of each size. All of them belong to one polygon, which
//! is not stored with them.
//!
//! Latency and throughput are those of the unit, which never waits while there are windows to divide (MPG-EQ6).

use super::coverage_test::{CoverageTest, Test};
use super::divider::{DividerIn, DividerOut};
use super::format::{Format, Work};
use crate::prelude::*;

block! {
    /// Divides windows down to a size, with one unit and a stack.
    pub struct Stack {
        /// The generator's format.
        pub format: Format,
        /// How the edges are tested.
        pub test: Test,
        /// The size of the input windows: the binary logarithm of their side.
        pub from: u32,
        /// The number of divisions.
        pub levels: u32,
    }
    latency = "the clocks of all windows of a polygon, one after another";
    source = "sparse-raster quadtree generator, equation 6 (MPG-RP, MPG-EQ6)";
    in(self) = DividerIn::widths(self.format);
    out(self) = DividerOut::widths(self.format, self.levels);
}

impl Stack {
    fn build(&self, m: Module, i: DividerIn) -> DividerOut {
        let Stack { format, test, from, levels } = *self;
        def!(next = m.stream_wire(Work::widths(format)));
        let unit = CoverageTest { format, test, from, sizes: levels };
        def!(test = m.instance(&unit, DividerIn { works: *next }));

        // A quarter is a leaf, or is divided again.
        let part = &test.parts;
        def!(is_done = part.window.size.eq(from - levels));
        let (parts, _) = m.offer(part.valid & is_done, part.payload);
        part.take_when(!is_done | parts.ready);
        def!(comes_back = part.valid & !is_done);

        // The window to divide next: the newest. When the unit is free it takes whatever is offered.
        let depth = (3 * (levels - 1)).max(1);
        let word = part.with(part.window).packed();
        // A power of two, so that no word is beyond the memory: nothing gates what is read.
        def!(windows = m.memory(depth.next_power_of_two(), word.width(), ReadUnderWrite::Any));
        def!(used = m.reg(up_to(depth)).reset(0));
        let address = windows.address_width();
        let newest_address = (used - 1).trunc(address);
        let newest = match self.test {
            Test::Parallel => windows.read_async(newest_address),
            // A window is tested for 12 clocks or more, so a block RAM is in time.
            Test::Serial => windows.read(newest_address),
        };
        let newest = part.with(newest).unpacked(&part.window);
        def!(is_empty = used.eq(0));
        let again = Work { polygon: part.polygon, window: mux(comes_back, part.window, newest.payload) };
        def!(is_new = is_empty & !comes_back);
        let (offered, taken) = m.offer(!is_new | i.works.valid, mux(is_new, i.works.payload, again));
        i.works.take_when(is_new & offered.ready);
        next.drive(offered);

        def!(pushes = comes_back & !taken);
        def!(pops = taken & !comes_back & !is_empty);
        windows.write(pushes, (*used).trunc(address), *word);
        used.when(pushes, used + 1).when(pops, used - 1);
        m.assert(pushes.implies(used.ne(depth)), "the stack stores at most three windows of each size");
        m.cover("the stack is full", m.rose(used.eq(depth)));
        DividerOut { parts, idle: test.idle, tally: test.tally }
    }
}
