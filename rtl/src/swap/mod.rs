//! The VC-1's swap control: when a local frame buffer, and when the global one, exchange their buffers (VC1-SW1 to SW4).
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
//! A frame ends when every program has ended: all see the line at one edge, and each swaps as soon as its own guards hold. When the
//! last has swapped and the global frame buffer has stored what all have sent, its banks change in a vertical blanking.
//!
//! [`SwapControl`] is all of this in one block. Each rule of the paper is an assertion that runs in every frame: which one, and what breaks it, is in
//! `rtl/docs/mutants.md`.

mod control;
mod gfb_swap;
mod lfb_swap;
mod sync_line;

pub use control::{SwapControl, SwapControlIn, SwapControlOut};
pub use gfb_swap::{GfbSwap, GfbSwapIn, GfbSwapOut};
pub use lfb_swap::{LfbSwap, LfbSwapIn, LfbSwapOut, SwapState};
pub use sync_line::{SyncLine, SyncLineIn, SyncLineOut};
