//! Designs that measure the simulator.

pub mod designs;
mod subject;
mod word;

pub use subject::{Family, HandWritten, Subject, USUAL};

/// For so many cycles `rst` is held high at the start.
pub const RESET_CYCLES: u64 = 4;
