//! The whole swap control (Figure 6): the controls of all local frame buffers, the sync line between them, and the
//! control of the global frame buffer.
//!
//! ```text
//!  done, idle    .--------.-- ready --.           .--------.
//! -------------->|  LFB   |           '---> & --->|        |
//!  state         |  swap, |<----- line ----|      |  GFB   |<-- enable, blanking
//! <--------------|  each  |               bus,    |  swap  |
//!  swap, resume  |        |               host    |        |--> gfb_swap
//! <--------------|        |-- frame ------------->|        |
//!                '--------'<------------- shown --'--------'
//! ```
//!
//! Latency: that of the parts; the block adds no register.
//!
//! # The events of Figure 6
//!
//! | event | signals |
//! |---|---|
//! | 1: all are done, and swap | the line is high; `swap` in the next clock |
//! | 2: the table is cleared, and the next frame is drawn | states `Clear` and `Draw` |
//! | 3: the back buffers are merged | `sending`, until T_m has passed |
//! | 4: the global frame buffer swaps in a blanking | `gfb_swap` |
//! | 5: an early frame waits for the previous frame's swap | state `Due` |
//! | 6: a buffer overflows | state `Overflow` |
//! | 7: an extra swap of that buffer | `swap` of one lane |
//! | 8: the table is cleared, and drawing continues | `resume` |

use super::{GfbSwap, GfbSwapIn, LfbSwap, LfbSwapIn, SwapState, SyncLine, SyncLineIn};
use crate::prelude::*;

block! {
    /// Decides when each local frame buffer swaps its buffers, and when the global one does.
    pub struct SwapControl {
        /// The swap control of each local frame buffer.
        pub local: LfbSwap,
        /// The swap control of the global frame buffer. It defines the number of processing elements.
        pub global: GfbSwap,
    }
    latency = "0 clocks from the last guard to a swap";
    source = "VC-1, section 3.3 and Figure 6, buffer swap control (VC1-SW1 to SW4)";
    in(self) SwapControlIn {
        /// For each processing element: the program has drawn its frame.
        done: bit().of(self.lanes()).on(PE),
        /// For each processing element: no pixel is under way, and no word waits in the receive queue.
        idle: bit().of(self.lanes()).on(PE),
        /// For each processing element: a pixel waits, because all pages are taken.
        overflow: bit().of(self.lanes()).on(PE),
        /// For each processing element: a pixel is accepted.
        draws: bit().of(self.lanes()).on(PE),
        /// For each processing element: an entry of the patch table is cleared.
        clears: bit().of(self.lanes()).on(PE),
        /// For each processing element: the patch whose entry is cleared.
        patch: below(self.local.patches).of(self.lanes()).on(PE),
        /// The broadcast bus is idle.
        bus: bit().on(PE),
        /// The host releases the sync line.
        host: bit().on(PE),
        /// For each local frame buffer: a part of the back buffer is not sent yet.
        sending: bit().of(self.lanes()).on(MERGE),
        /// The chain advances.
        enable: bit().on(MERGE),
        /// The display is in the part of its vertical blanking in which the banks may change.
        blanking: bit().on(MERGE),
    }
    out(self) SwapControlOut {
        /// The sync line: all have drawn the frame.
        line: bit(),
        /// For each local frame buffer, for one clock: swap the buffers.
        swap: bit().of(self.lanes()),
        /// For each local frame buffer, for one clock: try the waiting request again.
        resume: bit().of(self.lanes()),
        /// For each processing element: what the program may do.
        state: one_of::<SwapState>().of(self.lanes()),
        /// For one clock: swap the banks of the global frame buffer.
        gfb_swap: bit(),
        /// A frame is stored, and waits for the blanking.
        merged: bit(),
        /// Toggles with each swap of the global frame buffer.
        shown: bit(),
    }
}

impl SwapControl {
    fn lanes(&self) -> Shape {
        row(self.global.processors)
    }

    fn build(&self, m: Module, i: SwapControlIn) -> SwapControlOut {
        let (pe, merge) = (m.on(PE), m.on(MERGE));
        let SwapControlIn { done, idle, overflow, draws, clears, patch, sending, .. } = i;
        let processors = self.global.processors;

        def!(line = pe.wire(bit()));
        def!(shown = merge.wire(bit()));
        let (line_here, shown_here) = (*line, *shown);
        def!(
            lfb_swap = m.array(processors, &self.local, |_| LfbSwapIn {
                done,
                idle,
                overflow,
                draws,
                clears,
                patch,
                line: line_here,
                shown: shown_here,
                sending,
            })
        );
        let sync = SyncLineIn { ready: lfb_swap.ready.to_vec(), bus: i.bus, host: i.host };
        def!(sync_line = pe.instance(&SyncLine { processors }, sync));
        line.drive(sync_line.line);

        let (frames, sending) = (lfb_swap.frame.to_vec(), sending.to_vec());
        let banks = GfbSwapIn { frames, sending, enable: i.enable, blanking: i.blanking };
        def!(gfb_swap = merge.instance(&self.global, banks));
        shown.drive(gfb_swap.shown);
        SwapControlOut {
            line: *line,
            swap: lfb_swap.swap,
            resume: lfb_swap.resume,
            state: lfb_swap.state,
            gfb_swap: gfb_swap.swap,
            merged: gfb_swap.merged,
            shown: *shown,
        }
    }
}

#[cfg(test)]
mod tests;
