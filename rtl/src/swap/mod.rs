//! The VC-1's swap control: decides when each local frame buffer swaps its buffers, and when the global one does
//! (VC1-SW1 to SW4).
//!
//! ```text
//!            done                 line                            frames, sending
//! program ---------> [LFB swap] <------- [sync line]  [LFB swap] ---------------> [GFB swap] <-- blanking
//!            state    |  ^   |            ^  ^  ^                                    |  |
//!         <-----------'  |   '--- ready --'  |  '-- bus, host                 swap --'  '-- shown
//!                        '------- shown -----|-----------------------------------------------'
//!                                            '-- ready of the other processing elements
//! ```
//!
//! A frame ends when every program has drawn it. All processing elements see the line at the same edge, and each swaps
//! as soon as its own guards are true. The banks of the global frame buffer change in a vertical blanking, after the
//! last processing element has swapped and everything sent is stored.
//!
//! [`SwapControl`] is all of this in one block. Each rule of the paper is an assertion that is checked in every frame.
//! `rtl/docs/mutants.md` lists each assertion with a change that violates it.

mod control;
mod gfb_swap;
mod lfb_swap;
mod sync_line;

pub use control::{SwapControl, SwapControlIn, SwapControlOut};
pub use gfb_swap::{GfbSwap, GfbSwapIn, GfbSwapOut};
pub use lfb_swap::{LfbSwap, LfbSwapIn, LfbSwapOut, SwapState};
pub use sync_line::{SyncLine, SyncLineIn, SyncLineOut};
