//! PixelFlow: identical nodes that rasterize, shade or hold the frame, with a network between them that composes images.
//!
//! | file | what is in it |
//! |---|---|
//! | `latency` | what the paper says of the latency of three software systems, in formulas |
//! | `workload` | what rasterizers have to draw |
//! | `model` | when each node has done what: the transaction model |
//! | `simulated` | the systems in that model |
//! | `machine` | frames on the hardware: `config`, `works`, `hardware`, `report`, `screen` |
//! | `stereo` | frames of two eyes |
//! | `costs` | what each step takes |
//! | `triangles` | random triangles, as the paper counts them |
//! | `packets`, `constants` | packets and shaders as the programs of a node take them |
//!
//! Source: "Reducing Latency on PixelFlow", facts A4 (PFL).

mod config;
mod constants;
mod costs;
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
