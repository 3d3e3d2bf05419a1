//! The VC-1's swap control: decides when a local frame buffer, and when the global one, exchange their buffers (VC1-SW1
//! to SW4).
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
//! A frame ends when every program has ended it. All processing elements see the line at the same edge, and each swaps
//! as soon as its own guards are open. The banks of the global frame buffer change in a vertical blanking, after the
//! last has swapped and everything sent is stored.
//!
//! [`SwapControl`] is all of this in one block. Each rule of the paper is an assertion that runs in every frame.
//! `rtl/docs/mutants.md` lists the assertions, and a change that violates each.

mod control;
mod gfb_swap;
mod lfb_swap;
mod sync_line;

pub use control::{SwapControl, SwapControlIn, SwapControlOut};
pub use gfb_swap::{GfbSwap, GfbSwapIn, GfbSwapOut};
pub use lfb_swap::{LfbSwap, LfbSwapIn, LfbSwapOut, SwapState};
pub use sync_line::{SyncLine, SyncLineIn, SyncLineOut};
