//! The backing store of a renderer: stores a finished region, and sends it while the next one is drawn (PP5-ARCH, facts
//! E3).
//!
//! ```text
//!                   48 planes of S x S bits
//! words of pixels  .-----------------------.   S bits of a line   .--------.
//! ================>| [ plane ][ plane ] .. |--------------------->| choice |==> planes, a line after another
//!  a plane a clock '-----------------------'      of each line    '--------'
//! ```
//!
//! A region arrives plane by plane, in 48 clocks, and leaves line by line. The 48 planes of a line follow one another,
//! the least significant first, S bits a clock. With S = 128 at 40 MHz that is 5.12 Gbit/s, and 48 S = 6144 clocks a
//! region.
//!
//! Latency and throughput: 2 clocks from the last plane in to the first one out. Then one plane leaves in each clock in
//! which the receiver takes it.

use super::controller::Save;
use super::{REGION_BITS, SIDES, fields};
use crate::prelude::*;

block! {
    /// Stores a finished region, and sends it line by line while the next one is drawn.
    pub struct BackingStore {
        /// Pixels in a line of a region, and lines in a region.
        pub side: u32,
    }
    ranges { side: powers_of_two(SIDES) }
    latency(self) = format!("2 clocks from the last plane; a region is sent in {} clocks", fields::WORD.bits * self.side);
    source = "Pixel-planes 5, section I.3.2.1 (PP5-ARCH)";
    in(self) BackingStoreIn {
        /// The commands of the controller.
        save: Save,
        /// The number of the plane that arrives.
        number: below(fields::WORD.bits),
        /// The bits of the plane that arrives, a row for each line.
        word: bit().of(grid(self.side, self.side)),
    }
    out(self) BackingStoreOut {
        /// The store can take a region.
        free: bit(),
        /// The planes of the region, line by line.
        planes: stream(BitPlane::widths(self.side)),
    }
}

record! {
    /// One bit of each pixel of a line.
    pub struct BitPlane(side: u32) {
        /// The number of the region.
        region: bits(REGION_BITS),
        /// The line of the region.
        line: below(side),
        /// The number of the bit in the visibility word.
        plane: below(fields::WORD.bits),
        /// The plane's bit of each pixel of the line, from the left.
        bits: bit().of(row(side)),
    }
}

impl BackingStore {
    fn build(&self, m: Module, i: BackingStoreIn) -> BackingStoreOut {
        let last_plane = fields::WORD.bits - 1;
        def!(free = m.reg(bit()).reset(1));
        def!(region = m.reg(REGION_BITS));
        region.when(i.save.claim, i.save.region);
        def!(bits = m.memory(fields::WORD.bits, bit().of(grid(self.side, self.side)), ReadUnderWrite::Old));
        bits.write(i.save.plane, i.number, i.word);
        def!(complete = i.save.plane & i.number.eq(last_plane));

        // A plane of a line is read in each clock in which its predecessor can leave.
        def!(reading = m.reg(bit()).reset(0));
        def!(plane = m.reg(below(fields::WORD.bits)).reset(0));
        def!(line = m.reg(below(self.side)).reset(0));
        def!(arrived = m.reg(bit()).reset(0));
        def!(reads = m.wire(bit()));
        let read = bits.read_when(reads, plane);
        let (read_plane, read_line) =
            (m.pipe_when(reads, "read_plane", *plane), m.pipe_when(reads, "read_line", *line));
        let sent_bits = read.rows().pick(read_line);
        let payload = BitPlane { region: *region, line: read_line, plane: read_plane, bits: sent_bits };
        let (planes, sent) = m.offer(*arrived, payload);
        reads.drive(reading & (!arrived | sent));
        def!(line_ends = reads & plane.eq(last_plane));
        def!(ends = line_ends & line.eq(self.side - 1));
        reading.when(complete, 1).when(ends, 0);
        plane.when(line_ends, 0).when(reads, plane + 1);
        line.when(line_ends, line + 1);
        arrived.when(reads, 1).when(sent, 0);
        free.when(i.save.claim, 0).when(sent & !reading, 1);

        m.assume(i.save.claim.implies(free), "a region is claimed only when the previous one has left");
        m.assume(
            i.save.plane.implies(!free & !reading & !arrived),
            "a plane arrives only for a region that was claimed",
        );
        BackingStoreOut { free: *free, planes }
    }
}

#[cfg(test)]
mod tests;
