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
//! The renderer is at rest if the controller has sent no bit for [`Renderer::REST`] clocks and no plane is taken. Then
//! nothing in the renderer changes.
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
use super::{SIDES, fields};
use crate::prelude::*;

block! {
    /// Draws regions of the screen, one after another.
    pub struct Renderer {
        /// Pixels in a line of a region, and lines in a region.
        pub side: u32,
        /// The capacity of the queue, in instructions.
        pub queue: u32,
        /// Whether expressions may be quadratic: with a [quadratic tree](super::quadratic_tree), the renderer also takes
        /// [curves](super::instruction::Operation::Curve).
        pub quadratic: bool,
    }
    ranges { side: powers_of_two(SIDES), queue: 1..=Renderer::MOST }
    latency = "a primitive takes the clocks of its instructions; a region is sent in 48 clocks a line";
    source = "Pixel-planes 5, section I.3.2.1 (PP5-ARCH, PP5-UT)";
    in RendererIn {
        /// The instructions; all coefficients are relative to the region.
        instructions: stream(Instruction),
        /// Tree and memory may each execute an instruction. While `side_by_side` is low, an instruction begins only after its predecessor has ended.
        side_by_side: bit(),
    }
    out(self) RendererOut {
        /// Finished regions, S bits a clock.
        planes: stream(BitPlane = BitPlane::widths(self.side)),
        /// The queue has room for an instruction in this clock: a copy of `instructions.ready`, for a sender that must know before it offers one.
        room: bit(),
        /// The controller takes an instruction from the queue in this clock.
        takes: bit(),
        /// All instructions have ended, except in the pixels, which are `Renderer::lag` clocks behind. The renderer can take another region.
        idle: bit(),
    }
}

impl Renderer {
    /// The largest capacity of the queue, in instructions.
    pub const MOST: u32 = 4096;
    /// This many clocks after an instruction's last bit, none of its bits is still on its way. The coefficients have
    /// been shifted out except for their signs, and their sums have passed the tree to the pixels.
    ///
    /// A quadratic tree of 256 x 256 pixels takes at most 95 clocks. From its first bit on, a coefficient changes for
    /// 39 clocks. The longest path, that of D or E, has 46 registers and 17 sums, whose carries may each change a clock
    /// later. An instruction has 8 bits or more.
    pub const REST: u64 = 96;

    /// Clocks that a bit takes from the controller to the pixels: 2 log2 S for a linear tree, 4 log2 S for a quadratic
    /// one.
    ///
    /// ```
    /// use tilewright_rtl::pixel_planes::renderer::Renderer;
    ///
    /// let lag = |quadratic| Renderer { side: 128, queue: 16, quadratic }.lag();
    /// assert_eq!([lag(false), lag(true)], [14, 28]);
    /// ```
    pub fn lag(&self) -> u32 {
        self.controller().lag()
    }

    fn controller(&self) -> ImageGenerationController {
        ImageGenerationController { side: self.side, quadratic: self.quadratic }
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
