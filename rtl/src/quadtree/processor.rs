//! A video processor: everything between the broadcast of polygons and the pixels of its sparse raster (MPG-ARCH,
//! MPG-SPR).
//!
//! ```text
//! packets ==>[ queue ]==>[ set-up ]==>[ raster processor ]==>[ pixel processor ]-->[ video buffer ]--> word
//!                                                                                        ^
//!                                                                           scan --------'
//! ```

use tilewright_blocks::StreamBlocks;

use super::coverage_test::Test;
use super::divider::DividerIn;
use super::format::{Bounds, Format, Packet};
use super::pixel::{PixelProcessor, PixelProcessorIn};
use super::raster::{Form, RasterProcessor};
use super::set_up::{SetUp, SetUpIn};
use super::tally::Tally;
use super::video_buffer::{Scan, VideoBuffer, VideoBufferIn};
use crate::prelude::*;

/// The capacities of a generator's queues.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Queues {
    /// Packets from the geometry processor, before the broadcast.
    pub broadcast: u32,
    /// Packets, before each video processor.
    pub packets: u32,
    /// Windows, before each unit of a pipe or tree.
    pub windows: u32,
}

impl Queues {
    /// The largest capacity of a queue.
    pub const MOST: u32 = 4096;
}

block! {
    /// Draws polygons in a raster of its own: every p-th pixel of every q-th line.
    pub struct VideoProcessor {
        /// The generator's format.
        pub format: Format,
        /// The form of the raster processor.
        pub form: Form,
        /// How the edges are tested.
        pub test: Test,
        /// The capacities of the queues.
        pub queues: Queues,
    }
    ranges {
        queues.broadcast: 1..=Queues::MOST,
        queues.packets: 1..=Queues::MOST,
        queues.windows: 1..=Queues::MOST,
    }
    latency = "a polygon takes a clock for each edge, but at least 4, and the clocks of the windows that it covers";
    source = "sparse-raster quadtree generator, figure 1 (MPG-ARCH, MPG-SPR)";
    in(self) VideoProcessorIn {
        /// The polygons to draw.
        packets: stream(Packet::widths(self.format)),
        /// The outermost pixels of this video processor, widened by half the aperture; constants from [`Format::place_of`].
        place: Bounds = self.format.place(),
        /// Depth alone is compared, and the first drawn of equal depths stays.
        strict: bit(),
        /// The number of the bank to draw in.
        back: bit(),
        /// The pixel of the other bank to send.
        scan: Scan::widths(self.format),
    }
    out(self) VideoProcessorOut {
        /// The word sent to the video controller.
        word: bits(self.format.word()),
        /// No polygon is under way.
        idle: bit(),
        /// The counters of the set-up, and of each level of the raster processor.
        tally: [Tally; self.format.levels() + 1],
        /// Fragments since the reset, modulo 2^32.
        fragments: bits(32),
    }
}

impl VideoProcessor {
    fn build(&self, m: Module, i: VideoProcessorIn) -> VideoProcessorOut {
        let VideoProcessor { format, test, queues, .. } = *self;
        let packets = m.fifo("u_queue", queues.packets, i.packets);
        def!(set_up = m.instance(&SetUp { format }, SetUpIn { packets, place: i.place }));

        let raster = RasterProcessor { format, form: self.form.clone(), test, queue: queues.windows };
        def!(raster = m.instance(&raster, DividerIn { works: set_up.roots }));
        let pixel = PixelProcessorIn { leaves: raster.parts };
        def!(pixel = m.instance(&PixelProcessor { format }, pixel));
        let buffer = VideoBufferIn { draw: pixel.fragment, strict: i.strict, back: i.back, scan: i.scan };
        def!(buffer = m.instance(&VideoBuffer { format }, buffer));

        // A fragment takes a clock in the pixel processor, and another in the buffer.
        def!(drawn = m.reg(bit()).reset(0));
        drawn.next(pixel.fragment.valid);
        let idle = set_up.idle & raster.idle & !pixel.fragment.valid & !drawn;
        let tally = [set_up.tally].into_iter().chain(raster.tally).collect();
        VideoProcessorOut { word: buffer.word, idle, tally, fragments: pixel.fragments }
    }
}
