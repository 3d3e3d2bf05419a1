//! The whole generator without its geometry processor (MPG-ARCH).
//!
//! ```text
//!                        .-- video processor (0, 0) --.
//!          .-------.     +-- video processor (1, 0) --+      .------------.
//! packets  | queue |====>|            ..              |----->| controller |===> pixels
//!          '-------'     '-- video processor (p-1,q-1)'      '------------'
//!                broadcast                          words
//! ```
//!
//! Each packet goes to all video processors, and to each as soon as its queue has room. The next packet follows when all
//! have it.
//! So the matrix waits for the geometry processor only when a queue is empty. The geometry processor waits for the
//! matrix only when a queue is full.
//!
//! # Protocol
//!
//! | party | action | when |
//! |---|---|---|
//! | geometry processor | sends polygons | at any time, except from `swap` until the swap takes effect |
//! | host | swaps the banks, so that the drawn picture is shown | `idle`, and no picture is being read |
//! | host | reads and clears the picture | after the swap, while the next one is drawn |
//!
//! A bank must be read with `clear` before the next picture is drawn in it.

use tilewright_blocks::StreamBlocks;

use super::controller::{Show, VideoController, VideoControllerIn};
use super::format::{Format, Packet};
use super::processor::{VideoProcessor, VideoProcessorIn};
use super::tally::Tally;
use super::video_buffer::Scan;
use crate::prelude::*;

block! {
    /// The matrix of video processors of a sparse-raster quadtree generator, with its video controller.
    pub struct QuadtreeGenerator {
        /// Each of the video processors.
        pub video_processor: VideoProcessor,
    }
    latency = "the clocks of the slowest video processor; 2 clocks from `start` to the first pixels";
    source = "sparse-raster quadtree generator, figure 1 (MPG-ARCH, MPG-LIM)";
    in(self) QuadtreeGeneratorIn {
        /// The polygons to draw.
        packets: stream(Packet::widths(self.format())),
        /// Depth alone is compared, and the first drawn of equal depths stays; constant while a picture is being drawn.
        strict: bit(),
        /// High for one clock to swap the banks; only when idle and while no picture is being read.
        swap: bit(),
        /// The settings of the read-out.
        show: Show::widths(self.format()),
        /// The unit whose counters are read.
        probe: pub struct Probe {
            /// The number of the probed video processor, row by row.
            processor: below(self.format().matrix().processors()),
            /// The probed unit: 0 for the set-up, or a level of the raster processor.
            unit: up_to(self.format().levels()),
        },
    }
    out(self) QuadtreeGeneratorOut {
        /// Groups of p neighbouring pixels, line by line; pixels beyond the end of a line are to be ignored.
        pixels: stream(bits(self.format().word()).of(row(self.format().matrix().columns()))),
        /// No polygon is under way.
        idle: bit(),
        /// A picture is being read.
        showing: bit(),
        /// The counters of the probed unit.
        tally: Tally,
        /// The fragments of the probed video processor since the reset, modulo 2^32.
        fragments: bits(32),
        /// The counters of the broadcast: packets that all video processors have, and clocks in which a packet waited for room.
        broadcast: Tally,
    }
}

impl QuadtreeGenerator {
    /// The generator's format.
    pub fn format(&self) -> Format {
        self.video_processor.format
    }

    fn build(&self, m: Module, i: QuadtreeGeneratorIn) -> QuadtreeGeneratorOut {
        let format = self.format();
        let matrix = format.matrix();
        let each = row(matrix.processors());
        def!(back = m.toggle(i.swap));

        // The broadcast: processors that already have the packet wait for the others.
        let packets = m.fifo("u_queue", self.video_processor.queues.broadcast, i.packets);
        def!(has = m.reg(bit().of(each)).reset(0));
        let packet = packets.payload.map(|field| match field.shape() {
            Shape::Plain => field.of(each),
            _ => field.to_rows(matrix.processors()),
        });
        let (copies, sent) = m.offer(packets.valid & !has, packet);
        def!(all_have = (has | sent).and_all());
        let gone = packets.take_when(all_have);
        has.when(gone.taken, 0).when(sent, 1);
        def!(waits = packets.valid & !all_have);
        let broadcast = Tally { busy: gone.taken, stalled: waits, results: gone.taken };
        let broadcast = m.within("broadcast", || Tally::count(m, broadcast));

        def!(scan = m.wire(Scan::widths(format).of(each)));
        let places = format.place().map(|width| width.of(each));
        let p = matrix.columns();
        def!(
            processor = m.array(matrix.processors(), &self.video_processor, |_| VideoProcessorIn {
                packets: copies,
                place: constants(places, |lane| format.place_of(lane % p, lane / p)),
                strict: i.strict,
                back,
                scan: *scan,
            })
        );
        let control = VideoControllerIn { show: i.show, words: processor.word };
        def!(controller = m.instance(&VideoController { format }, control));
        scan.drive(controller.scan);

        def!(idle = !packets.valid & processor.idle.and_all());
        m.assume(i.swap.implies(idle & !controller.busy), "the banks are swapped only while nothing is drawn or read");
        let counted = |unit: &Tally| unit.map(|count| count.pick(i.probe.processor));
        let tallies: Vec<Tally> = processor.tally.iter().map(counted).collect();
        let units = (1..).zip(tallies[1..].iter().copied());
        let tally = case(i.probe.unit, units, tallies[0]);
        QuadtreeGeneratorOut {
            pixels: controller.pixels,
            idle,
            showing: controller.busy,
            tally,
            fragments: processor.fragments.pick(i.probe.processor),
            broadcast,
        }
    }
}

#[cfg(test)]
mod tests;
