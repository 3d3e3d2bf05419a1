//! A chain of merging units, each with a local frame buffer that draws at random: the frame path of a small VC-1.
//!
//! ```text
//!       [ frame buffer 0 ]  [ frame buffer 1 ]     [ frame buffer n-1 ]
//!               |                   |                      |
//! nothing -->[ merger 0 ]------>[ merger 1 ]--> .. -->[ merger n-1 ]--> checksum
//! ```
//!
//! It tests pipelines that are all alike and linked to their neighbours, and large memories read at addresses that
//! differ from lane to lane.

mod frame_buffer;
mod merger;

use tilewright_hdl::{Fields, Module, Width, bit, bits, block, bundle, cat, constants, def, lit, mux};

use crate::word::seed;
use frame_buffer::{FrameBuffer, FrameBufferIn};
use merger::{Merger, MergerIn};

use super::{BenchIn, BenchOut};

bundle! {
    /// A pixel on its way through the chain.
    struct Pixel<T> {
        /// The pixel has been drawn.
        valid: T,
        /// Colour, 24 bits.
        rgb: T,
        /// Depth, 24 bits; nearer is smaller.
        z: T,
    }
}

/// The widths of a pixel.
fn pixel() -> Pixel<Width> {
    Pixel { valid: bit(), rgb: bits(24), z: bits(24) }
}

block! {
    /// A chain of merging units with local frame buffers that draw at random.
    pub struct Pim {
        /// Merging units, at least 1.
        pub stages: u32,
        /// Patches of 4x4 pixels in a row of the screen, from 5.
        pub columns: u32,
        /// Rows of patches, from 2.
        pub rows: u32,
    }
    latency(self) = format!("{} clocks from the first frame buffer to the checksum", 4 * self.stages + 1);
    in = BenchIn { rst: bit() };
    out = BenchOut { csum: bits(32) };
}

impl Pim {
    /// A chain of `stages` units for 640x480 pixels.
    pub fn new(stages: u32) -> Pim {
        Pim { stages, columns: 160, rows: 120 }
    }

    fn build(&self, m: Module, i: BenchIn) -> BenchOut {
        // A merger takes 4 clocks, so each scan runs 4 pixels ahead of the next one.
        let frame_buffer = FrameBuffer { columns: self.columns, rows: self.rows };
        let (width, x_width) = (frame_buffer.width(), frame_buffer.x_width());
        let lead = |stage: u32| u64::from(4 * (self.stages - 1 - stage) % width);
        let chain = m.array("u_stage", self.stages, &Stage { frame_buffer }, |stages| StageIn {
            rst: i.rst,
            seed: constants(bits(32).of(self.stages), seed),
            start_x: constants(bits(x_width).of(self.stages), lead),
            left: stages.merged.map(|field| field.previous(0)),
        });
        let last = chain.merged.map(|field| field.last());
        def!(csum = m.reg(32));
        let sum = (csum.rotate_left(1) + cat![last.valid, lit(7, 0), last.rgb]) ^ last.z.zext(32);
        csum.next(mux(i.rst, 0, sum));
        BenchOut { csum: *csum }
    }
}

block! {
    /// A merger and its local frame buffer.
    struct Stage {
        frame_buffer: FrameBuffer,
    }
    in(self) StageIn {
        rst: bit(),
        /// The seed of the random generator.
        seed: bits(32),
        /// The start of the scan.
        start_x: bits(self.frame_buffer.x_width()),
        /// The pixel from the preceding stage.
        left: Pixel = pixel(),
    }
    out StageOut {
        merged: Pixel = pixel(),
    }
}

impl Stage {
    fn build(&self, m: Module, i: StageIn) -> StageOut {
        let StageIn { rst, seed, start_x, left } = i;
        let right = m.instance("u_frame_buffer", &self.frame_buffer, FrameBufferIn { rst, seed, start_x }).pixel;
        StageOut { merged: m.instance("u_merger", &Merger, MergerIn { left, right }).nearer }
    }
}
