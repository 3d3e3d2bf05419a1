//! The local frame buffer unit of a processing element (VC1-LFB).
//!
//! ```text
//!            PE clock                      |      merge clock
//!                                          |      .--------------.
//! request -+- x, y --> locate              |      | scan counter |<-- restart, enable, preset
//!          |             | patch           |      '--------------'
//!          |             v                 |        locate | patch
//! clear ---|---->.---------------------------------------. |
//!          |     |             patch table               |<'
//!          |     '---------------------------------------'
//!          |        page |                 |     | resident, page
//!          |     .-------v-------------------------------v.
//!          '---->|            image memory                |--> word, to the merging unit
//!        word    '----------------------------------------'
//! ```
//!
//! Latency and throughput: an access every 3 clocks if its patch has a page, every 4 if not (VC1-ACC). A word for
//! every enabled clock of the merger, 2 of them after the scan counter shows its pixel.
//!
//! The unit has two buffers: the processor draws into the front one, while the merger is sent the back one. Each holds
//! the whole screen virtually, in pages that are given to the patches drawn into. A patch that has no page is sent as
//! empty, the greatest depth (VC1-MU).
//!
//! # Swapping
//!
//! `swap` exchanges the buffers for the processor at once, and for the merger two of its clocks later. The processor knows of
//! that two clocks of its own later still; until then its look-ups and clears wait, so that never both are in one buffer.
//! Whoever swaps has to see that the back buffer has been sent as a whole (VC1-SW3), and to clear the patch table then.

use tilewright_hdl::ir::About;
use tilewright_hdl::{Block, Module, Width, bit, bits, bundle, net, on};

use super::image_memory::{Draw, ImageMemory, ImageMemoryIn, SendPixel};
use super::patch_table::{Cleared, LookUp, PatchTable, PatchTableIn, ScanLookUp};
use super::patches::Patches;
use super::scan_counter::{ScanCounter, ScanCounterIn};
use crate::clocks::{MERGE, PE};
use crate::parameter::ParameterError;
use crate::scan::{Position, ScanControl};
use crate::word::WORD;

bundle! {
    /// A pixel that the processor draws.
    pub struct Request<T> {
        /// There is one.
        pub valid: T,
        /// Counted from the left.
        pub x: T,
        /// Counted from the top.
        pub y: T,
        /// Depth above colour.
        pub word: T,
    }

    /// A patch table entry that the processor clears.
    pub struct Clear<T> {
        /// There is one.
        pub valid: T,
        /// Its number.
        pub patch: T,
    }

    /// The inputs of [`LfbUnit`].
    pub struct LfbUnitIn<T> {
        /// The processor draws.
        pub request: Request<T>,
        /// The processor clears the patch table.
        pub clear: Clear<T>,
        /// For one clock, when idle or in overflow: exchange the buffers.
        pub swap: T,
        /// For one clock: try the held request again.
        pub resume: T,
        /// From the global frame buffer unit.
        pub scan: ScanControl<T>,
        /// Where a restart puts the scan counter; a constant, [`ScanCounter::preset`].
        pub preset: Position<T>,
    }

    /// The outputs of [`LfbUnit`].
    pub struct LfbUnitOut<T> {
        /// A request is accepted at this edge.
        pub ready: T,
        /// A clear is accepted at this edge. If a request is too, the clear comes first.
        pub clear_ready: T,
        /// A request is held, because its patch has no page and all pages are taken.
        pub overflow: T,
        /// How many pages of the front buffer are taken.
        pub pages_used: T,
        /// No request is under way.
        pub idle: T,
        /// The pixel sent to the merging unit.
        pub word: T,
    }

    /// What waits while the patch of the scan's pixel is looked up.
    struct Sought<T> {
        offset: T,
        /// The buffer that was looked into.
        buffer: T,
    }

    /// What waits while the patch of the processor's pixel is looked up.
    struct Wanted<T> { offset: T, word: T }
}

/// A virtual local frame buffer.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct LfbUnit {
    patches: Patches,
    pages: u32,
}

impl LfbUnit {
    /// A unit with that many pages in each of its two buffers.
    ///
    /// # Errors
    ///
    /// There are fewer than 2 pages, or more than patches.
    pub fn new(patches: Patches, pages: u32) -> Result<LfbUnit, ParameterError> {
        if (2..=patches.count()).contains(&pages) {
            return Ok(LfbUnit { patches, pages });
        }
        Err(ParameterError(format!(
            "a local frame buffer of {pages} pages: it has to have from 2 to {}, a page for each patch of the screen",
            patches.count()
        )))
    }

    /// The patches of its screen.
    pub fn patches(&self) -> &Patches {
        &self.patches
    }
}

impl Block for LfbUnit {
    type In = LfbUnitIn;
    type Out = LfbUnitOut;

    fn inputs(&self) -> LfbUnitIn<Width> {
        let position = ScanCounter::position(self.patches.screen());
        let Position { x, y } = position;
        LfbUnitIn {
            request: on(PE, Request { valid: bit(), x, y, word: bits(WORD) }),
            clear: on(PE, Clear { valid: bit(), patch: self.patches.patch_width() }),
            swap: bit().on(PE),
            resume: bit().on(PE),
            scan: on(MERGE, ScanControl { restart: bit(), enable: bit() }),
            preset: on(MERGE, position),
        }
    }

    fn build(&self, m: Module, i: LfbUnitIn) -> LfbUnitOut {
        let (pe, merge) = (m.on(PE), m.on(MERGE));

        // Which buffer is in front, as the processor knows it and as the merger knows it.
        let front = pe.reg("front", 1).reset(0);
        front.enable(i.swap).next(!front);
        let merge_front = merge.synchronize("merge_front", front.value());
        let known_front = pe.synchronize("known_front", merge_front);
        net!(settled = known_front.eq(front));
        net!(back = !merge_front);

        // The scan: a clock for the patch table, a clock for the image memory.
        let scan = i.scan;
        let counter = ScanCounter { screen: self.patches.screen() };
        let counted = merge.instance("u_scan_counter", &counter, ScanCounterIn { scan, preset: i.preset });
        let sought = self.patches.locate(counted.pixel);
        let step = scan.restart | scan.enable;
        let armed = merge.reg("sought_armed", 1).reset(0);
        armed.enable(step).next(counted.armed & !scan.restart);
        let beside = Sought { offset: sought.offset, buffer: back };
        let Sought { offset, buffer } = merge.pipe_when(scan.enable, "sought", beside);

        // The processor's request: its patch is looked up, the rest waits beside.
        let wanted = self.patches.locate(Position { x: i.request.x, y: i.request.y });
        let (clear, _) = pe.offer(i.clear.valid, Cleared { patch: i.clear.patch });
        let table = m.instance(
            "u_patch_table",
            &PatchTable { patches: self.patches.count(), pages: self.pages },
            PatchTableIn {
                look_up: LookUp { valid: i.request.valid, patch: wanted.patch },
                clear,
                front: front.value(),
                settled,
                restart: i.swap,
                resume: i.resume,
                scan: ScanLookUp { enable: scan.enable, patch: sought.patch, buffer: back },
            },
        );
        net!(accept = i.request.valid & table.ready);
        let beside = Wanted { offset: wanted.offset, word: i.request.word };
        let Wanted { offset: wanted_offset, word } = pe.pipe_when(accept, "wanted", beside);

        // A pixel sought before the buffers were swapped is not sent: its page may belong to another patch by now.
        net!(resident = armed & table.scan_entry.resident & buffer.eq(back));
        let image = m.instance(
            "u_image_memory",
            &ImageMemory { pages: self.pages, page_pixels: self.patches.pixels() },
            ImageMemoryIn {
                draw: Draw { valid: table.found, page: table.page, offset: wanted_offset, word },
                front: front.value(),
                send: SendPixel { enable: scan.enable, resident, page: table.scan_entry.page, offset, buffer: back },
            },
        );
        let idle = table.idle & image.idle;
        pe.assert(i.swap.implies(table.overflow | idle), "the buffers are swapped when idle or in overflow");
        pe.assert(i.swap.implies(settled), "the buffers are not swapped again before the merger has followed");
        LfbUnitOut {
            ready: table.ready,
            clear_ready: clear.ready,
            overflow: table.overflow,
            pages_used: table.pages_used,
            idle,
            word: image.sent,
        }
    }

    fn name(&self) -> String {
        let screen = self.patches.screen();
        format!("lfb_unit_{}x{}_patch{}_pages{}", screen.width, screen.height, self.patches.edge(), self.pages)
    }

    fn about(&self) -> About {
        let screen = self.patches.screen();
        About {
            summary: format!(
                "A virtual local frame buffer: a screen of {} x {} in {} pages of {} x {} pixels.",
                screen.width,
                screen.height,
                self.pages,
                self.patches.edge(),
                self.patches.edge()
            ),
            latency: "an access every 3 or 4 clocks; 2 clocks of the merger from the scan counter to the word"
                .to_owned(),
            source: "VC-1, section 3.3, local frame buffer (VC1-LFB, VC1-ACC, VC1-SCAN, VC1-CLR1)".to_owned(),
        }
    }
}

#[cfg(test)]
mod tests;
