//! Whole rendering machines: programs, hardware, a scene, a frame.

mod areas;
mod error;
mod history;
mod looks;
mod mean;
pub mod pixel_planes;
pub mod pixelflow;
pub mod quadtree;
mod random;
mod run;
mod threads;
mod told;
mod tracer;
pub mod vc1;
mod way;

pub use areas::Area;
pub use error::Error;
pub use history::{History, Lane, Recorder, Span, Write};
pub use mean::Mean;
pub use run::{Progress, Watch};
pub use tracer::Tracer;
pub use way::{Apart, Compared, Follower, Primitive, Step, Way};
