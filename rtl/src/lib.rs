//! The hardware blocks of the rendering machines.

pub mod clocks;
pub mod lfb;
pub mod parameter;
pub mod scan;
pub mod word;
