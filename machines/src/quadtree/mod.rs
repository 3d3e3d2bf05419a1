//! The sparse-raster quadtree generator: p x q video processors. Each one has a raster of every p-th column and every q-th row. It finds
//! the pixels of a polygon on its raster by recursive division into windows.
//!
//! [`Machine`] is the hardware of `tilewright-rtl` with its host. It renders packets to a frame and a [`Report`] of windows and clocks. This
//! module also has the paper's formulas, and the plain model that counts what the paper estimates:
//!
//! ```text
//! Rasters, Shape -- formulas -----> windows of a level, clocks of a stage --.
//!                                                                             >-- Stages -> performance, load, efficiency
//! Rectangles -> packets -> Search -> windows counted, clocks counted -------+
//! scenes, packets -> Machine --> frame, windows and clocks of the hardware -'
//! ```
//!
//! [`model`] has the clocks of a running matrix, packet by packet, equal to the hardware's. It also has the cost of coupling by queues, and the
//! same figures from the counters of the model and of the hardware.
//!
//! Source: the Russian paper on matrix-pipeline image generators, facts A2 and A3 (MPG).

mod config;
mod counters;
mod formulas;
mod hardware;
mod history;
mod host;
mod machine;
pub mod model;
mod rasters;
mod rectangles;
mod report;
mod stages;
mod study;
mod visits;
mod way;
mod windows;

pub use crate::mean::Mean;
pub use config::{Built, Config};
pub use formulas::{MAX_PERFORMANCE, Shape, full_tree};
pub use machine::Machine;
pub use rasters::Rasters;
pub use rectangles::Rectangles;
pub use report::{Phase, ProcessorReport, Report, Spread, Stage, UnitReport};
pub use stages::{Figures, Stages};
pub use study::{Point, Sample, Study};
pub use tilewright_rtl::quadtree::coverage_test::Test;
pub use tilewright_rtl::quadtree::processor::Queues;
pub use windows::{Costs, Search, Window, Windows};
