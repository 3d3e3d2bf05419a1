//! PixelFlow: identical nodes that rasterize, shade or hold the frame, with a network between them that composes images.
//!
//! Here is what the paper says of the latency of three software systems on such a machine, in formulas; and packets and shaders as the programs of a
//! node take them.
//!
//! Source: "Reducing Latency on PixelFlow", facts A4 (PFL).

mod constants;
mod costs;
mod latency;
mod packets;

pub use constants::constants;
pub use costs::Costs;
pub use latency::{Nodes, Samples, Software, System, Times, crossover, overlap};
pub use packets::Corner;
