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
//! Latency and throughput: an access every 3 clocks if its patch has a page, and otherwise every 4 (VC1-ACC). The
//! merger gets a word in every clock with `enable`, 2 such clocks after the scan counter shows the pixel.
//!
//! The unit has two buffers: the processor draws into the front one while the back one is sent to the merger. Each
//! contains the whole screen virtually: a patch gets a page when it is first drawn into. A patch without a page is sent
//! as empty pixels, with the greatest depth (VC1-MU).
//!
//! # Swapping
//!
//! `swap` exchanges the buffers at once for the processor, and two merger clocks later for the merger. The processor
//! learns of that two of its own clocks later. Until then its look-ups and clears wait, so the two never access
//! the same buffer. The swap control has to ensure that the whole back buffer has been sent (VC1-SW3). After the swap
//! the patch table has to be cleared.

use super::*;
use crate::gfb::SCAN_LATENCY;
use crate::prelude::*;

block! {
    /// A virtual local frame buffer: a full screen, of which only the patches drawn into take memory.
    pub struct LfbUnit {
        /// The patches of the screen.
        pub patches: Patches,
        /// The number of pages in each of the two buffers.
        pub pages: u32,
    }
    ranges(self) {
        /// A patch of the screen has one page at most.
        pages: 2..=self.patches.count(),
    }
    latency = "an access every 3 or 4 clocks; 2 clocks of the merger from the scan counter to the word";
    source = "VC-1, section 3.3, local frame buffer (VC1-LFB, VC1-ACC, VC1-SCAN, VC1-CLR1)";
    in(self) LfbUnitIn {
        /// A pixel that the processor draws.
        request: stream(Request::widths(self.patches.screen())).on(PE),
        /// A patch table entry that the processor clears. If a request is accepted at the same edge, the clear comes first.
        clear: stream(Wanted { patch: below(self.patches.count()) }).on(PE),
        /// For one clock, when idle or in overflow: swap the buffers.
        swap: bit().on(PE),
        /// For one clock: try the waiting request again.
        resume: bit().on(PE),
        /// The control of the scan, from the global frame buffer unit.
        scan: ScanControl.on(MERGE),
        /// The pixel to which a restart sets the scan counter; a constant, [`ScanCounter::preset`].
        preset: Position::widths(self.patches.screen()).on(MERGE),
    }
    out(self) LfbUnitOut {
        /// A request waits, because its patch has no page and all pages are taken.
        overflow: bit(),
        /// The number of pages taken in the front buffer.
        pages_used: up_to(self.pages),
        /// No request is under way.
        idle: bit(),
        /// A request is accepted.
        draws: bit(),
        /// An entry of the patch table is cleared.
        clears: bit(),
        /// The pixel sent to the merging unit.
        word: bits(WORD),
        /// A part of the back buffer has not been sent since the last swap.
        sending: bit(),
        /// The pixel that the scan counter shows; the pixel's word is sent 2 clocks later.
        scanned: Position::widths(self.patches.screen()),
    }
}

record! {
    /// A pixel that a processor draws.
    pub struct Request(screen: Screen) {
        /// The column of the pixel, counted from the left.
        x: below(screen.width),
        /// The line of the pixel, counted from the top.
        y: below(screen.height),
        /// The word of the pixel: depth above colour.
        word: bits(WORD),
    }
}

impl LfbUnit {
    fn build(&self, m: Module, i: LfbUnitIn) -> LfbUnitOut {
        let (pe, merge) = (m.on(PE), m.on(MERGE));
        let enable = i.scan.enable;

        // The front buffer, as the processor knows it and as the merger knows it.
        def!(front = pe.toggle(i.swap));
        def!(merge_front = merge.synchronize(front));
        def!(known_front = pe.synchronize(merge_front));
        def!(settled = known_front.eq(front));
        def!(back = !merge_front);

        // The scan: one clock for the patch table, one clock for the image memory.
        let counter = ScanCounter { screen: self.patches.screen() };
        def!(scan_counter = merge.instance(&counter, ScanCounterIn { scan: i.scan, preset: i.preset }));
        let sought = self.patches.locate(scan_counter.pixel);
        def!(sought_armed = merge.reg(bit()).reset(0).when(enable, scan_counter.armed));
        def!(sought_offset = merge.pipe_when(enable, sought.offset));
        def!(sought_buffer = merge.pipe_when(enable, back));

        // Any run of as many pixels as a frame has sends each pixel of the back buffer once. The last word is sent
        // 2 clocks after the scan.
        let pixels = self.patches.screen().pixels() + SCAN_LATENCY;
        def!(was_front = merge.reg(bit()).reset(0));
        was_front.next(merge_front);
        def!(swapped = was_front.ne(merge_front));
        def!(passes = enable & scan_counter.armed);
        def!(pixels_left = merge.reg(up_to(pixels)).reset(0));
        def!(all_sent = pixels_left.eq(0));
        pixels_left
            .when(swapped, mux(passes, lit(up_to(pixels), pixels - 1), pixels))
            .when(passes & !all_sent, pixels_left - 1);
        // A register, because the signal crosses to the processor's clock.
        def!(sending = merge.reg(bit()).reset(0));
        sending.next(!all_sent | swapped);
        merge.assert(swapped.implies(all_sent), "the buffers are swapped only when the back buffer has been sent");
        merge
            .assume(i.scan.restart.implies(all_sent & !swapped), "the scan restarts only when nothing is left to send");
        merge.cover("the buffers are swapped while the scan is within a frame", swapped & passes);

        // The processor's request: offset and word wait while the patch is looked up.
        let wanted = self.patches.locate(Position { x: i.request.x, y: i.request.y });
        let look_up = i.request.with(Wanted { patch: wanted.patch });
        def!(accept = i.request.valid & i.request.ready);
        def!(clears = i.clear.valid & i.clear.ready);
        let seek = ScanLookUp { enable, patch: sought.patch, buffer: back };
        let table = PatchTable { patches: self.patches.count(), pages: self.pages };
        let asked =
            PatchTableIn { look_up, clear: i.clear, front, settled, restart: i.swap, resume: i.resume, scan: seek };
        def!(patch_table = m.instance(&table, asked));
        def!(wanted_offset = pe.pipe_when(accept, wanted.offset));
        def!(wanted_word = pe.pipe_when(accept, i.request.word));

        // A pixel looked up before the buffers were swapped is not sent: its page may belong to another patch by now.
        def!(resident = sought_armed & patch_table.scan_entry.resident & sought_buffer.eq(back));
        let draw = Draw { valid: patch_table.found, page: patch_table.page, offset: wanted_offset, word: wanted_word };
        let send =
            SendPixel { enable, resident, page: patch_table.scan_entry.page, offset: sought_offset, buffer: back };
        let image = ImageMemory { pages: self.pages, page_pixels: self.patches.pixels() };
        def!(image_memory = m.instance(&image, ImageMemoryIn { draw, front, send }));

        // A pixel that was sent is cleared: if it passes again before the next swap, it is empty.
        def!(again = all_sent & !swapped);
        def!(sought_again = merge.reg(bit()).reset(0).when(enable, again));
        def!(sent_again = merge.reg(bit()).reset(0).when(enable, sought_again));
        merge.assert(sent_again.implies(image_memory.sent.eq(empty())), "a back buffer that has been sent is cleared");
        merge.cover("a pixel is scanned again after it was sent", passes & again);
        let idle = patch_table.idle & image_memory.idle;
        pe.assume(i.swap.implies(patch_table.overflow | idle), "the buffers are swapped only when idle or in overflow");
        pe.assume(i.swap.implies(settled), "the buffers are not swapped again before the merger has followed");
        LfbUnitOut {
            overflow: patch_table.overflow,
            pages_used: patch_table.pages_used,
            idle,
            draws: accept,
            clears,
            word: image_memory.sent,
            sending: *sending,
            scanned: scan_counter.pixel,
        }
    }
}

#[cfg(test)]
mod tests;
