//! The whole machine without its geometry processors: renderers around a ring, the region allocator, and the frame
//! buffer (PP5-ARCH).
//!
//! ```text
//! regions ==>[ allocator ]--- given, region ---> host
//!                 ^
//!                 | free                .--------------.
//!            open & idle                |   renderer   |.
//!                                       |      ..      ||
//! bins ======.                          '--------------'|
//!            v       instructions         ^  '---------+'
//!          .------.=======================' finished   |
//!          | ring |<===================================+
//!          '------'=========>[ frame buffer ]---> words
//! ```
//!
//! | party | action | when |
//! |---|---|---|
//! | host | offers regions, the one with the most primitives first | at any time |
//! | host | offers the instructions of a region in the bin of the renderer that got it; the last one is a save | from the clock after `given` until the last one is taken; `open` is high in these clocks |
//! | host | reads the picture | when all renderers are idle and have sent everything |
//!
//! Latency: the time that the busiest renderer takes, and the ring.

use super::REGION_BITS;
use super::allocator::{RegionAllocator, RegionAllocatorIn};
use super::backing_store::BitPlane;
use super::frame_buffer::{FrameBuffer, FrameBufferIn, ReadLine, sides_on};
use super::instruction::Instruction;
use super::renderer::{Renderer, RendererIn};
use super::ring::{Ring, RingIn};
use crate::prelude::*;

block! {
    /// Renderers around a ring, with the region allocator and the frame buffer.
    pub struct PixelPlanes5 {
        /// The picture's size.
        pub screen: Screen,
        /// The number of renderers.
        pub renderers: u32,
        /// Pixels in a line of a region, and lines in a region.
        pub side: u32,
        /// The capacity of each renderer's queue, in instructions.
        pub queue: u32,
        /// Bits that the ring carries in a clock.
        pub rate: u32,
        /// Whether the renderers' expressions may be quadratic.
        pub quadratic: bool,
    }
    ranges(self) {
        renderers: 1..=Ring::MOST_RENDERERS,
        /// The regions of a screen have numbers of 16 bits.
        side: sides_on(self.screen),
        queue: 1..=Renderer::MOST,
        rate: 1..=Ring::MOST,
    }
    latency = "the clocks of the last renderer to finish; 1 clock to read a line";
    source = "Pixel-planes 5, section I.3.2.1 (PP5-ARCH, PP5-UT)";
    in(self) PixelPlanes5In {
        /// The numbers of the regions, the one with the most primitives first.
        regions: stream(bits(REGION_BITS)),
        /// The instructions for each renderer's region.
        bins: [stream(Instruction); self.renderers],
        /// The renderers whose bins have more instructions to come.
        open: bit().of(row(self.renderers)),
        /// Tree and memory may each execute an instruction. While `side_by_side` is low, an instruction begins only after its predecessor has ended.
        side_by_side: bit(),
        /// A line of a region to read.
        read: ReadLine = self.frame_buffer().inputs().read,
    }
    out(self) PixelPlanes5Out {
        /// The renderer that gets a region in this clock, if any.
        given: bit().of(row(self.renderers)),
        /// The number of the region that is given.
        region: bits(REGION_BITS),
        /// The renderers whose controllers take an instruction in this clock.
        takes: bit().of(row(self.renderers)),
        /// The renderers that have executed all instructions, except in the pixels.
        idle: bit().of(row(self.renderers)),
        /// A plane goes to the frame buffer in this clock.
        plane_goes: bit(),
        /// The words of the pixels of the line that was read.
        words: bits(WORD).of(row(self.side)),
    }
}

impl PixelPlanes5 {
    /// The machine's frame buffer.
    pub fn frame_buffer(&self) -> FrameBuffer {
        FrameBuffer { screen: self.screen, side: self.side }
    }

    fn build(&self, m: Module, i: PixelPlanes5In) -> PixelPlanes5Out {
        let &PixelPlanes5 { renderers, side, queue, rate, quadratic, .. } = self;
        let renderer = Renderer { side, queue, quadratic };
        let ring = Ring { renderers, side, rate };
        let numbers = 0..renderers;
        let finished: Vec<_> =
            numbers.clone().map(|number| m.stream_wire(&format!("finished{number}"), BitPlane::widths(side))).collect();
        def!(room = m.wire(bit().of(row(renderers))));
        let messages = RingIn { bins: i.bins, room: *room, finished: finished.iter().map(|planes| **planes).collect() };
        def!(ring = m.instance(&ring, messages));

        let (mut rooms, mut takes, mut idles) = (Vec::new(), Vec::new(), Vec::new());
        for ((number, instructions), planes) in numbers.zip(ring.instructions).zip(finished) {
            let inputs = RendererIn { instructions, side_by_side: i.side_by_side };
            let out = m.instance(&format!("u_renderer{number}"), &renderer, inputs);
            planes.drive(out.planes);
            rooms.push(out.room);
            takes.push(out.takes);
            idles.push(out.idle);
        }
        room.drive(stack(rooms));
        def!(idle = stack(idles));

        let allocation = RegionAllocatorIn { regions: i.regions, free: idle & !i.open };
        def!(allocator = m.instance(&RegionAllocator { renderers }, allocation));
        let plane_goes = ring.planes.valid;
        def!(frame_buffer = m.instance(&self.frame_buffer(), FrameBufferIn { planes: ring.planes, read: i.read }));
        PixelPlanes5Out {
            given: allocator.given,
            region: allocator.region,
            takes: stack(takes),
            idle,
            plane_goes,
            words: frame_buffer.words,
        }
    }
}

#[cfg(test)]
mod tests;
