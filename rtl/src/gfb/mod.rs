//! The global frame buffer of the VC-1: a full screen with depth that collects the pixels of the local frame buffers.
//! Behind it, the accumulation buffer adds up the pictures of several passes.

mod accumulation;
mod crt;
mod multipass;
mod sequencer;
#[cfg(test)]
pub(crate) mod testing;
mod unit;

pub use accumulation::{Accumulation, AccumulationIn, AccumulationOut, Passes};
pub use crt::{BLANK_COLUMNS, BLANK_LINES, Blanking, CrtPixel, CrtReadOut, CrtReadOutIn, CrtReadOutOut, Display};
pub use multipass::{Multipass, MultipassControl, MultipassControlIn, MultipassControlOut};
pub use sequencer::{GfbSequencer, GfbSequencerIn, GfbSequencerOut, SCAN_LATENCY};
pub use unit::{Access, GfbUnit, GfbUnitIn, GfbUnitOut, Host, View};
