//! Pixel-planes 5: renderers, each an array of 128x128 pixel processors, that take the screen's regions one after another.
//!
//! This module has the parts that are not hardware: the binning of primitives to regions, the assignment of regions to renderers, and the
//! paper's formulas for both. It also has the whole machine, which draws scenes with the hardware.
//!
//! ```text
//! primitives -> Outline -- Binner --> bins of Regions -- allocate --> Allocation: the regions of each renderer, P_w
//! bins ----> Bin: instructions --> GeometryReport: the clocks of those who make them
//!                      |---------> Model: when each comes, and is taken --> Timing
//!                      '----------------> Machine: renderers and frame buffer in simulation --> Frame, Report
//! programs of primitives ----> Clocked, Table: N, the clocks of a primitive
//! Vectors ---------------> Study: regions a vector, counted, beside those by Shape's formulas
//! ```
//!
//! Source: "Renderer performance" of the Pixel-planes 5 paper, facts A0 (PP5).

mod allocator;
mod bin;
mod clocks;
mod config;
mod drawing;
mod following;
mod formulas;
mod geometry;
mod hardware;
mod history;
mod machine;
pub mod model;
mod outline;
mod regions;
mod report;
mod study;
mod table;
mod vectors;

pub use allocator::{Allocation, Renderer, allocate};
pub use clocks::{ProgramClocks, SPHERE_LEAST, SPHERE_STRICT, Tally, scene_clocks};
pub use config::{Built, Config};
pub use drawing::Drawing;
pub use formulas::{
    PERIOD, Shape, VECTOR_CYCLES, first_starved, greatest_load, greatest_load_of_whole_regions, least_load, update_time,
};
pub use geometry::{GeometryCosts, GeometryReport};
pub use machine::Machine;
pub use outline::{Binner, Outline};
pub use regions::Regions;
pub use report::{Busy, RegionReport, RendererReport, Report, RingReport, StarvedReport, Unit};
pub use study::{Bins, Point, Study};
pub use table::{Kind, Row, Table};
pub use tilewright_rtl::pixel_planes::programs::Edges;
pub use vectors::Vectors;
