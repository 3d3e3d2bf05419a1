//! The swap control of the global frame buffer (VC1-SW2).
//!
//! ```text
//! frames --> all have swapped --+--> T_m since -------.
//!                               '--> M N + 4 n pixels --+--> & --> swap --> [ shown ]
//! blanking ---------------------------------------------'
//! ```
//!
//! Latency: a swap comes in the first clock in which all of these are true:
//!
//! - all local frame buffers have swapped at the end of the frame;
//! - T_m has passed since the last of these swaps (VC1-SW2);
//! - the chain has since advanced by all pixels of the screen and its own length, so that the global frame buffer has
//!   stored everything. The paper does not name this condition. T_m is too short when the chain stops for overheads
//!   while the last pixels are in it;
//! - the display is in the part of its vertical blanking in which the banks may change.

use crate::prelude::*;

block! {
    /// Swaps the global frame buffer in a vertical blanking, when a frame is merged.
    pub struct GfbSwap {
        /// The number of processing elements.
        pub processors: u32,
        /// T_m in clocks of the merger (VC1-TM).
        pub merge_clocks: u64,
        /// The clocks with `enable` from the last swap of a local frame buffer until all pixels are stored.
        pub way: u32,
        /// The greatest number of clocks after T_m until all pixels are stored.
        pub late: u64,
    }
    ranges { processors: 1.., merge_clocks: 1.., way: 1.., late: 1.. }
    latency = "0 clocks, if all guards are true";
    source = "VC-1, section 3.3 and Figure 6, swap of the global frame buffer (VC1-SW2)";
    in(self) GfbSwapIn {
        /// For each processing element: toggles with the swap at the end of a frame.
        frames: [bit(); self.processors],
        /// For each processing element: a part of the back buffer is not sent yet.
        sending: [bit(); self.processors],
        /// The chain advances.
        enable: bit(),
        /// The display is in the part of its vertical blanking in which the banks may change.
        blanking: bit(),
    }
    out GfbSwapOut {
        /// For one clock: swap the banks.
        swap: bit(),
        /// A frame is stored, and waits for the blanking.
        merged: bit(),
        /// Toggles with each swap of the global frame buffer.
        shown: bit(),
    }
}

impl GfbSwap {
    fn build(&self, m: Module, i: GfbSwapIn) -> GfbSwapOut {
        def!(swap = m.wire(bit()));
        def!(shown = m.toggle(*swap));
        def!(frames = stack(i.frames));
        def!(all_swapped = frames.ne(shown).and_all());

        let longest = self.merge_clocks + self.late;
        def!(since = m.reg(up_to(longest)).reset(0));
        since.when(!all_swapped | *swap, 0).when(since.ne(longest), since + 1);
        def!(waited = since.ge(self.merge_clocks));
        def!(way_left = m.reg(up_to(self.way)).reset(self.way));
        def!(stored = way_left.eq(0));
        way_left.when(!all_swapped | *swap, self.way).when(i.enable & !stored, way_left - 1);
        def!(merged = waited & stored);
        swap.drive(merged & i.blanking);

        m.assert(swap.implies(i.blanking & stored), "the banks change in a blanking, with all of the frame stored");
        m.assume(swap.implies(!stack(i.sending).or_all()), "all of a frame is sent before the banks change");
        m.assert(since.eq(longest).implies(stored), "the frame is stored soon after T_m");
        m.assert(merged.implies(all_swapped), "a frame is merged only after all have ended it");
        m.assume(
            frames.ne(m.past(frames)).implies(frames.ne(shown)).and_all(),
            "a frame ends only when the previous one is on display",
        );
        m.cover("the banks change", *swap);
        m.cover("a merged frame waits for the blanking", merged & !i.blanking);
        GfbSwapOut { swap: *swap, merged, shown }
    }
}

#[cfg(test)]
mod tests;
