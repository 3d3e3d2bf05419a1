//! The whole machine without its geometry processors: renderers around a ring, the allocator of regions, and the
//! picture (PP5-ARCH).
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
//! | host | offers regions, the one with most primitives first | at any time |
//! | host | offers the instructions of a region in the bin of the renderer that got it; the last one is a save | from the clock after `given`, in which `open` rises, until the last one is taken and it falls |
//! | host | reads the picture | when all renderers are idle and have sent everything |
//!
//! Latency: the time of the renderer with most to do, and of the ring.

use super::REGION_BITS;
use super::allocator::{RegionAllocator, RegionAllocatorIn};
use super::backing_store::BitPlane;
use super::frame_buffer::{FrameBuffer, FrameBufferIn, ReadLine};
use super::instruction::Instruction;
use super::renderer::{Renderer, RendererIn};
use super::ring::{Ring, RingIn};
use crate::prelude::*;

block! {
    /// Renderers around a ring, with the allocator of regions and the frame buffer.
    pub struct PixelPlanes5 {
        /// The picture's size.
        screen: Screen,
        /// Renderers.
        renderers: u32,
        /// Pixels in a line of a region, and lines.
        side: u32,
        /// The capacity of each renderer's queue, in instructions.
        queue: u32,
        /// Bits that the ring carries in a clock.
        rate: u32,
        /// Whether the renderers' expressions may be quadratic.
        quadratic: bool,
    }
    latency = "the clocks of the last renderer to finish; 1 clock to read a line";
    source = "Pixel-planes 5, section I.3.2.1 (PP5-ARCH, PP5-UT)";
    in(self) PixelPlanes5In {
        /// The numbers of the regions, the one with most primitives first.
        regions: stream(bits(REGION_BITS)),
        /// The instructions of the region that each renderer has.
        bins: [stream(Instruction); self.renderers],
        /// The renderers whose region has instructions that are still to come.
        open: bit().of(row(self.renderers)),
        /// Tree and memory may each have an instruction; while it is low, one begins when the one before has ended.
        side_by_side: bit(),
        /// A line of a region to read.
        read: ReadLine = self.frame_buffer().inputs().read,
    }
    out(self) PixelPlanes5Out {
        /// The renderer that gets a region in this clock, if one does.
        given: bit().of(row(self.renderers)),
        /// The number of the region that is given.
        region: bits(REGION_BITS),
        /// The renderers whose controllers take an instruction in this clock.
        takes: bit().of(row(self.renderers)),
        /// The renderers in which every instruction has ended except in the pixels.
        idle: bit().of(row(self.renderers)),
        /// A plane goes to the frame buffer.
        plane_goes: bit(),
        /// The words of the pixels of the line that was read.
        words: bits(WORD).of(row(self.side)),
    }
}

impl PixelPlanes5 {
    /// A machine with `renderers` renderers of regions with that side, each with a queue of `queue` instructions. The
    /// ring carries `rate` bits a clock.
    ///
    /// # Errors
    ///
    /// There is no such renderer, ring or frame buffer.
    ///
    /// ```
    /// use tilewright_rtl::{parameter::Screen, pixel_planes::machine::PixelPlanes5};
    ///
    /// let machine = PixelPlanes5::new(Screen::new(16, 16)?, 2, 8, 16, 125)?;
    /// assert_eq!(machine.frame_buffer().regions(), 4);
    /// # Ok::<(), tilewright_rtl::parameter::ParameterError>(())
    /// ```
    pub fn new(
        screen: Screen,
        renderers: u32,
        side: u32,
        queue: u32,
        rate: u32,
    ) -> Result<PixelPlanes5, ParameterError> {
        Renderer::new(side, queue)?;
        Ring::new(renderers, side, rate)?;
        FrameBuffer::new(screen, side)?;
        Ok(PixelPlanes5 { screen, renderers, side, queue, rate, quadratic: false })
    }

    /// The same, with renderers that [evaluate quadratics](Renderer::quadratic) if `quadratic` is true.
    #[must_use]
    pub fn quadratic(self, quadratic: bool) -> PixelPlanes5 {
        PixelPlanes5 { quadratic, ..self }
    }

    /// The number of renderers.
    pub fn renderers(&self) -> u32 {
        self.renderers
    }

    /// Its frame buffer.
    pub fn frame_buffer(&self) -> FrameBuffer {
        FrameBuffer::new(self.screen, self.side).expect("it was made once")
    }

    fn build(&self, m: Module, i: PixelPlanes5In) -> PixelPlanes5Out {
        let &PixelPlanes5 { renderers, side, queue, rate, .. } = self;
        let renderer = Renderer::new(side, queue).expect("it was made once").quadratic(self.quadratic);
        let ring = Ring::new(renderers, side, rate).expect("it was made once");
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
