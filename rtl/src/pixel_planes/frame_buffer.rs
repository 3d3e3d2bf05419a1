//! The frame buffer: assembles the picture from the regions that renderers send (PP5-ARCH, facts E3).
//!
//! ```text
//!            .---------------.  48th plane   .------------------.
//! planes ===>| words of S    |-------------->| S words at       |----> words
//!            | pixels >>     |               | region, line     |
//!            '---------------'               '------------------'
//! ```
//!
//! The 48 planes of a line come one after another, the least significant first, and shift into the words of its S
//! pixels. The last plane writes them. Regions are numbered row by row, from the upper left. Those at the right
//! and lower edges may extend beyond the screen.
//!
//! Latency: 1 clock from a line's last plane to the memory; a plane a clock. A line is read in 1 clock.

use super::backing_store::BitPlane;
use super::{REGION_BITS, SIDES, fields};
use crate::prelude::*;
use std::ops::RangeInclusive;

block! {
    /// Assembles the picture from regions.
    pub struct FrameBuffer {
        /// The picture's size.
        pub screen: Screen,
        /// Pixels in a line of a region, and lines in a region.
        pub side: u32,
    }
    ranges(self) {
        /// The regions of a screen have numbers of 16 bits.
        side: sides_on(self.screen),
    }
    latency = "1 clock from a line's last plane to the memory, 1 clock to read";
    source = "Pixel-planes 5, section I.3.2.1 (PP5-ARCH)";
    in(self) FrameBufferIn {
        /// Lines of regions, plane by plane; each is taken at once.
        planes: stream(BitPlane = BitPlane::widths(self.side)),
        /// A line of a region to read.
        read: pub struct ReadLine {
            /// A line is read; while `enable` is low, the words keep their values.
            enable: bit(),
            /// The number of the region.
            region: below(self.regions()),
            /// The line of the region.
            line: below(self.side),
        },
    }
    out(self) FrameBufferOut {
        /// The words of the pixels of the line that was read.
        words: bits(WORD).of(row(self.side)),
    }
}

/// What the side of a region may be on a screen, where at most 2^[`REGION_BITS`] regions have numbers.
pub(super) fn sides_on(screen: Screen) -> PowersOfTwo<RangeInclusive<u32>> {
    let is_numbered = |side: &u32| FrameBuffer { screen, side: *side }.regions() <= 1 << REGION_BITS;
    let least = SIDES.filter(|side| side.is_power_of_two()).find(is_numbered);
    powers_of_two(least.unwrap_or(*SIDES.end())..=*SIDES.end())
}

impl FrameBuffer {
    /// The number of regions side by side.
    pub fn columns(&self) -> u32 {
        self.screen.width.div_ceil(self.side)
    }

    /// The number of regions of the screen.
    pub fn regions(&self) -> u32 {
        self.columns() * self.screen.height.div_ceil(self.side)
    }

    fn build(&self, m: Module, i: FrameBufferIn) -> FrameBufferOut {
        let last_plane = fields::WORD.bits - 1;
        let plane = i.planes.take_when(1);
        def!(so_far = m.reg(bits(last_plane).of(row(self.side))));
        def!(word = cat![plane.bits, so_far]);
        so_far.when(plane.taken, word.slice(1..WORD));

        def!(lines = m.memory(self.regions() * self.side, bits(WORD).of(row(self.side)), ReadUnderWrite::Any));
        let address = |region: Signal, line: Signal| cat![region, line].low();
        let region = plane.region.trunc(below(self.regions()));
        lines.write(plane.taken & plane.plane.eq(last_plane), address(region, plane.line), word);

        def!(next = m.reg(below(fields::WORD.bits)).reset(0));
        next.when(plane.taken, mux(next.eq(last_plane), 0, next + 1));
        m.assume(plane.valid.implies(plane.plane.eq(next)), "the planes of a line arrive in sequence");
        m.assume(plane.valid.implies(plane.region.lt(self.regions())), "the region belongs to the screen");
        FrameBufferOut { words: lines.read_when(i.read.enable, address(i.read.region, i.read.line)) }
    }
}

#[cfg(test)]
mod tests;
