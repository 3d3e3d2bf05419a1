//! Whole rendering machines: programs, hardware, a scene, a frame.

mod error;
mod mean;
pub mod pixel_planes;
pub mod pixelflow;
pub mod quadtree;
mod random;
mod run;
mod threads;
pub mod vc1;

pub use error::Error;
pub use mean::Mean;
pub use run::{Progress, Watch};
