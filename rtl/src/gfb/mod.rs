//! The global frame buffer of the VC-1: a full screen with depth, which collects what the local frame buffers send.

mod sequencer;
mod unit;

pub use sequencer::{SCAN_LATENCY, Sequencer, SequencerIn, SequencerOut};
pub use unit::{GfbUnit, GfbUnitIn, GfbUnitOut, Host, View};
