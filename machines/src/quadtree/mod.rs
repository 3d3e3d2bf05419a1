//! The sparse-raster quadtree generator: p x q video processors, each of which looks for the pixels of a polygon on a raster of its
//! own, of every p-th column and every q-th row, by recursive division into windows.
//!
//! Here is what the paper says of it in formulas, and the plain model that counts what the paper estimates:
//!
//! ```text
//! Matrix, Shape -- formulas ------> windows of a level, clocks of a stage --.
//!                                                                             >-- Stages -> performance, load, efficiency
//! Rectangles -> packets -> Search -> windows counted, clocks counted -------'
//! ```
//!
//! [`model`] has the clocks of a running matrix, packet by packet, as the hardware has them but without it, and what coupling by queues costs.
//!
//! Source: the Russian paper on matrix-pipeline image generators, facts A2 and A3 (MPG).

mod formulas;
mod matrix;
pub mod model;
mod random;
mod rectangles;
mod stages;
mod study;
mod windows;

pub use formulas::{MAX_PERFORMANCE, Shape, full_tree};
pub use matrix::Matrix;
pub use rectangles::Rectangles;
pub use stages::{Figures, Stages};
pub use study::{Mean, Point, Sample, Study};
pub use windows::{Costs, Search, TestUnit, Window, Windows};
