//! The renderer: S x S pixels that compute under one instruction stream, and a store for the previous region (PP5-ARCH,
//! PP5-UT).
//!
//! ```text
//! instructions ==>[ queue ]==>[ controller ]--->[     tree    ]--.
//!                                   |   ^                        v
//!                                   |   '-- free --.   [ pixel processors ]
//!                                   |              |             | word
//!                                   '-- save -->[ backing store ]<'
//!                                                      '=========================> planes
//! ```
//!
//! The tree is [linear](super::linear_tree) or [quadratic](super::quadratic_tree).
//!
//! The renderer is at rest if no bit of an instruction was sent for [`Renderer::REST`] clocks and no plane is taken.
//! Then nothing in it changes.
//!
//! Latency and throughput are those of the instructions, one after another. A primitive takes the clocks of its program
//! ([`programs`](super::programs)), as long as the queue gets its instructions in time.

use tilewright_blocks::StreamBlocks;

use super::backing_store::{BackingStore, BackingStoreIn, BitPlane};
use super::controller::{ImageGenerationController, ImageGenerationControllerIn};
use super::instruction::Instruction;
use super::linear_tree::{LinearTree, LinearTreeIn};
use super::pixel::{PixelProcessor, PixelProcessorIn};
use super::quadratic_tree::{QuadraticTree, QuadraticTreeIn};
use super::{fields, side};
use crate::prelude::*;

block! {
    /// Draws regions of the screen, one after another.
    pub struct Renderer {
        /// Pixels in a line of a region, and lines.
        side: u32,
        /// The capacity of its queue, in instructions.
        queue: u32,
        /// Whether its expressions may be quadratic.
        quadratic: bool,
    }
    latency = "a primitive takes the clocks of its instructions; a region is sent in 48 clocks a line";
    source = "Pixel-planes 5, section I.3.2.1 (PP5-ARCH, PP5-UT)";
    in RendererIn {
        /// The instructions; all coefficients are relative to the region.
        instructions: stream(Instruction),
        /// Tree and memory may each have an instruction; while it is low, one begins when the one before has ended.
        side_by_side: bit(),
    }
    out(self) RendererOut {
        /// Finished regions, S bits a clock.
        planes: stream(BitPlane = BitPlane::widths(self.side)),
        /// The queue takes an instruction in this clock: `instructions.ready`, for a sender that has to know before it sends one.
        room: bit(),
        /// The controller takes an instruction from the queue in this clock.
        takes: bit(),
        /// Every instruction has ended except in the pixels, which are `Renderer::lag` clocks behind: it can be given another region.
        idle: bit(),
    }
}

impl Renderer {
    /// The largest capacity of its queue, in instructions.
    pub const MOST: u32 = 4096;
    /// This many clocks after an instruction's last bit, nothing of it is on its way any more. The coefficients have
    /// been shifted out except for their signs, and their sums have passed the tree to the pixels.
    ///
    /// A quadratic tree of 256 x 256 pixels takes 88 clocks. From its first bit on, a coefficient changes for 39
    /// clocks. The longest path has 39 registers and 17 sums, whose carries may each change a clock later. An
    /// instruction has 8 bits or more.
    pub const REST: u64 = 96;

    /// A renderer of regions with that side, a power of two from 2 to 256, with a queue of `queue` instructions.
    ///
    /// # Errors
    ///
    /// There is no such renderer.
    pub fn new(pixels: u32, queue: u32) -> Result<Renderer, ParameterError> {
        if !(1..=Renderer::MOST).contains(&queue) {
            let most = Renderer::MOST;
            return Err(ParameterError(format!("a queue of {queue} instructions: it has to hold from 1 to {most}")));
        }
        Ok(Renderer { side: side(pixels)?, queue, quadratic: false })
    }

    /// The same; with `quadratic`, it has a [quadratic tree](super::quadratic_tree), which also takes
    /// [curves](super::instruction::Operation::Curve).
    ///
    /// ```
    /// use tilewright_rtl::pixel_planes::renderer::Renderer;
    ///
    /// let linear = Renderer::new(128, 16)?;
    /// assert_eq!([linear.lag(), linear.quadratic(true).lag()], [14, 28]);
    /// # Ok::<(), tilewright_rtl::parameter::ParameterError>(())
    /// ```
    #[must_use]
    pub fn quadratic(self, quadratic: bool) -> Renderer {
        Renderer { quadratic, ..self }
    }

    /// Whether its expressions may be quadratic.
    pub fn is_quadratic(&self) -> bool {
        self.quadratic
    }

    /// Clocks from a bit that its controller sends to the pixels: 2 log2 S for a linear tree, 4 log2 S for a quadratic
    /// one.
    pub fn lag(&self) -> u32 {
        self.controller().lag()
    }

    fn controller(&self) -> ImageGenerationController {
        ImageGenerationController { side: self.side, quadratic: self.quadratic }
    }

    /// Pixels in a line of a region, and lines.
    pub fn side(&self) -> u32 {
        self.side
    }

    /// The capacity of its queue, in instructions.
    pub fn queue(&self) -> u32 {
        self.queue
    }

    fn build(&self, m: Module, i: RendererIn) -> RendererOut {
        let Renderer { side, queue, .. } = *self;
        let pixels = grid(side, side);
        let room = i.instructions.ready;
        let instructions = m.fifo("u_queue", queue, i.instructions);
        let takes = instructions.valid & instructions.ready;
        def!(store_free = m.wire(bit()));
        let control =
            ImageGenerationControllerIn { instructions, side_by_side: i.side_by_side, store_free: *store_free };
        def!(controller = m.instance(&self.controller(), control));

        let (coefficients, first) = (controller.coefficients, controller.first);
        let expression = match controller.curve[..] {
            [curve] => {
                def!(tree = m.instance(&QuadraticTree { side }, QuadraticTreeIn { coefficients, curve, first }));
                tree.value
            }
            _ => {
                def!(tree = m.instance(&LinearTree { side }, LinearTreeIn { coefficients, first }));
                tree.value
            }
        };
        let control = controller.control.map(|field| field.of(pixels));
        let pixel = PixelProcessorIn { control, expression };
        def!(pixel = m.array(pixels, &PixelProcessor, |_| pixel));

        let number = controller.control.write.trunc(below(fields::WORD.bits));
        let store = BackingStoreIn { save: controller.save, number, word: pixel.word };
        def!(store = m.instance(&BackingStore { side }, store));
        store_free.drive(store.free);
        RendererOut { planes: store.planes, room, takes, idle: controller.idle }
    }
}

#[cfg(test)]
mod tests;
