//! Whole rendering machines: programs, hardware, a scene, a frame.

mod error;
pub mod quadtree;
mod run;
mod threads;
pub mod vc1;

pub use error::Error;
pub use run::{Progress, Watch};
