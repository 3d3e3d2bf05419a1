//! Whole rendering machines: programs, hardware, a scene, a frame.

mod error;
pub mod quadtree;
mod run;
pub mod vc1;

pub use error::Error;
pub use run::{Progress, Watch};
