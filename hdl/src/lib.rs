//! A synchronous hardware language embedded in Rust.

mod bits;
pub mod clock;
pub mod ir;
mod loc;

pub use bits::{Bits, limbs_for, top_mask};
pub use clock::{Clock, Period};
pub use loc::Loc;
