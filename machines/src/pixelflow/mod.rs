//! PixelFlow: equal nodes that rasterize, shade or have the frame buffer, and a network between them that composes images.
//!
//! | file | content |
//! |---|---|
//! | `latency` | the paper's formulas for the latency of three software systems |
//! | `workload` | the primitives of the rasterizers |
//! | `model` | the transaction model: the time of each node's work |
//! | `simulated` | the systems in that model |
//! | `machine` | frames on the hardware: `config`, `works`, `hardware`, `report`, `screen` |
//! | `stereo` | frames for two eyes |
//! | `costs` | the time of each step |
//! | `triangles` | random triangles, as the paper counts them |
//! | `following` | the way of a pixel through a machine |
//! | `packets`, `constants` | packets and shaders for the programs of a node |
//!
//! Source: "Reducing Latency on PixelFlow", facts A4 (PFL).

mod config;
mod constants;
mod costs;
mod following;
mod hardware;
mod history;
mod latency;
mod machine;
mod model;
mod packets;
mod report;
mod screen;
mod simulated;
mod stereo;
mod triangles;
#[cfg(test)]
mod whole;
mod workload;
mod works;

pub use config::Config;
pub use constants::constants;
pub use costs::{Costs, Ticks, milliseconds, ticks};
pub use hardware::composition_time;
pub use latency::{Nodes, Samples, Software, System, Times, crossover, overlap};
pub use machine::Machine;
pub use model::{Done, Frame, FrontEnd, Pass, Resident, Shading, Timeline, Turn};
pub use packets::Corner;
pub use report::{NodeReport, Report, Stage};
pub use screen::{Pattern, Screen};
pub use simulated::{Choices, Shades, Simulated};
pub use stereo::{Stereo, StereoReport};
pub use triangles::Triangles;
pub use workload::{Boxes, Place, Share, Workload};
