//! The swap control of a local frame buffer (VC1-SW1, VC1-SW3, VC1-SW4, VC1-CLR2).
//!
//! ```text
//!            .-------------------- the last entry is cleared ---------------------.
//!            v                                                                    |
//! reset --> Draw --- the line is high -------> Due ----- swap: a frame ends ---> Clear <-- reset
//!              '---- all pages are taken --> Overflow -- swap: in a frame -------^
//! ```
//!
//! Latency: a swap comes in the first clock in which all of its guards are true. That is at least one clock after the
//! line or the overflow. A swap at the end of a frame and a swap in an overflow have the same guards:
//!
//! - the global frame buffer has swapped for every frame that ended earlier (`shown`, VC1-SW3);
//! - T_m has passed since the last swap of this local frame buffer (VC1-SW3);
//! - the merger has sent the whole back buffer (`sending` is low). The paper does not name this guard. T_m alone may
//!   be too short, because of the crossing into the merger's clock and the overheads in which the chain stops.
//!
//! After a swap the program clears the patch table, entry by entry. The control observes this, and then retries the
//! waiting request by itself (`resume`).
//!
//! The control asserts `ready` only in `Draw`. A fast processing element may have drawn its next frame while a slow one
//! still waits to swap. If `ready` were high in `Due`, the line would rise, and end the next frame at once.
//!
//! The swap at the end of a frame toggles `frame`, which reaches the merger one clock after the buffers' exchange does.
//!
//! # How long an overflow waits
//!
//! Another processing element may have overflowed late, which delays its swap at the end of the previous frame by T_m.
//! The merger takes T_m more, and the banks wait for a blanking. So the swap of an overflow comes within 2 T_m and a
//! refresh (VC1-SW4). It may take 2 refreshes more when an average of several passes is shown.
//!
//! A refresh is measured in the display's clock. So [`Vc1::lfb_swap`](crate::vc1::Vc1::lfb_swap), which knows all
//! periods, computes `overflow_clocks`. The T_m in this bound includes crossings and overheads.

use crate::prelude::*;

codes! {
    /// The state of a local frame buffer: how it is used, or why it waits.
    pub enum SwapState {
        /// The program clears the patch table.
        Clear,
        /// The program draws.
        Draw,
        /// All processing elements have drawn the frame; the swap waits for its guards.
        Due,
        /// All pages are taken; the swap waits for its guards.
        Overflow,
    }
}

impl SwapState {
    /// The state that has this code.
    ///
    /// # Panics
    ///
    /// No state has this code.
    pub fn of_code(code: u64) -> SwapState {
        SwapState::ALL[code as usize]
    }
}

block! {
    /// Swaps a local frame buffer at the end of a frame and in an overflow, as soon as all guards are true.
    pub struct LfbSwap {
        /// The number of patches, and so of table entries to clear.
        pub patches: u32,
        /// T_m in clocks of the processing element (VC1-TM).
        pub merge_clocks: u64,
        /// The greatest number of processing element clocks from a swap until the whole back buffer is sent.
        pub sent_clocks: u64,
        /// The greatest number of processing element clocks from an overflow to its swap.
        pub overflow_clocks: u64,
    }
    ranges { patches: 2.., merge_clocks: 1.., sent_clocks: 1.., overflow_clocks: 1.. }
    latency = "1 clock from the line to the swap, if all guards are true";
    source = "VC-1, section 3.3 and Figure 6, swap of a local frame buffer (VC1-SW1, VC1-SW3, VC1-SW4)";
    in(self) LfbSwapIn {
        /// The program has drawn its frame: high until the swap is due, and low before the program clears the table.
        done: bit().on(PE),
        /// No pixel is under way in the local frame buffer, and no word waits in the receive queue.
        idle: bit().on(PE),
        /// A pixel waits, because all pages are taken.
        overflow: bit().on(PE),
        /// A pixel is accepted.
        draws: bit().on(PE),
        /// An entry of the patch table is cleared.
        clears: bit().on(PE),
        /// The patch whose entry is cleared.
        patch: below(self.patches).on(PE),
        /// The sync line.
        line: bit().on(PE),
        /// Toggles with each swap of the global frame buffer.
        shown: bit().on(MERGE),
        /// A part of the back buffer is not sent yet.
        sending: bit().on(MERGE),
    }
    out LfbSwapOut {
        /// The processing element's contribution to the sync line.
        ready: bit(),
        /// For one clock: swap the buffers.
        swap: bit(),
        /// For one clock: try the waiting request again.
        resume: bit(),
        /// What the program may do.
        state: one_of::<SwapState>(),
        /// Toggles with each swap at the end of a frame, in the merger's clock.
        frame: bit(),
    }
}

impl LfbSwap {
    fn build(&self, m: Module, i: LfbSwapIn) -> LfbSwapOut {
        use SwapState::*;
        let (pe, merge) = (m.on(PE), m.on(MERGE));
        def!(state = pe.fsm(Clear));
        let [clear, draw, due, overflow] = [Clear, Draw, Due, Overflow].map(|it| state.is(it));

        // The guards.
        def!(swap = pe.wire(bit()));
        def!(frame_end = due & *swap);
        def!(parity = pe.toggle(frame_end));
        def!(shown_here = pe.synchronize(i.shown));
        def!(sending_here = pe.synchronize(i.sending));
        def!(is_sent = !sending_here);
        def!(is_shown = shown_here.eq(parity));
        let longest = self.merge_clocks.max(self.sent_clocks);
        def!(since = pe.reg(up_to(longest)).reset(longest));
        since.when(*swap, 0).when(since.ne(longest), since + 1);
        def!(waited = since.ge(self.merge_clocks));
        swap.drive((due | overflow) & is_shown & waited & is_sent);

        // The table is cleared in sequence.
        def!(entry = pe.reg(below(self.patches)).reset(0));
        def!(last_entry = i.clears & entry.eq(self.patches - 1));
        entry.when(last_entry, 0).when(i.clears, entry + 1);
        let moves = state.next(|state| match state {
            Clear => when(last_entry, Draw),
            Draw => when(i.overflow, Overflow).or_when(i.line, Due),
            Due | Overflow => when(*swap, Clear),
        });
        def!(holds = pe.reg(bit()).reset(0));
        def!(resume = last_entry & holds);
        holds.when(overflow, 1).when(resume, 0);
        def!(ready = draw & i.done & i.idle);

        pe.assume(
            i.clears.implies(clear & i.patch.eq(entry)),
            "after a swap the entries are cleared in sequence, each once",
        );
        pe.assume(i.draws.implies(draw), "no pixel is drawn between a swap and the last entry cleared");
        pe.assume(i.line.implies(ready), "the line is high only while this processing element releases it");
        pe.assume(i.done.implies(!clear), "`done` is low while the program clears the table");
        pe.assume(
            since.eq(self.sent_clocks).implies(is_sent),
            "the merger sends the back buffer within T_m, the crossings and the overheads",
        );
        pe.assert(swap.implies(shown_here.eq(parity)), "the global frame buffer has swapped for the previous frame");
        pe.assert(swap.implies(since.ge(self.merge_clocks)), "T_m has passed since the last swap");
        def!(overflow_clocks = pe.reg(up_to(self.overflow_clocks)).reset(0));
        overflow_clocks.when(!overflow | *swap, 0).when(overflow_clocks.ne(self.overflow_clocks), overflow_clocks + 1);
        pe.assert(
            overflow_clocks.ne(self.overflow_clocks),
            "the swap of an overflow comes within 2 T_m and the refreshes that the banks wait for",
        );
        pe.cover("a frame ends", frame_end);
        pe.cover("an overflow ends with a swap", overflow & *swap);
        pe.cover("the last entry is cleared", last_entry);
        pe.cover("a buffer overflows", moves.enters(Overflow));
        pe.cover("a swap waits for the global frame buffer alone", (due | overflow) & waited & is_sent & !is_shown);
        pe.cover("a swap waits for T_m alone", (due | overflow) & is_shown & is_sent & !waited);
        pe.cover("a swap waits for the merger alone", (due | overflow) & is_shown & waited & !is_sent);

        def!(frame_here = merge.synchronize(parity));
        def!(frame_late = merge.reg(bit()).reset(0));
        frame_late.next(frame_here);
        LfbSwapOut { ready, swap: *swap, resume, state: *state, frame: *frame_late }
    }
}

#[cfg(test)]
mod tests;
