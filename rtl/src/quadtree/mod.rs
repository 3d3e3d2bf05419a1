//! The sparse-raster quadtree generator: a matrix of video processors, each of which finds the pixels of polygons by dividing windows
//! (facts A2, A3, E2).
//!
//! ```text
//!              .--------------------- video processor (i, j) ----------------------.
//!              |                                                                    |
//! polygons ===>|[queue]=>[set-up]=>[raster processor]=>[pixel processor]->[buffer]--|--> controller ==> pixels
//!  to all      |                   window -> quarters                     2 banks   |      p at once
//!              '--------------------------------------------------------------------'
//! ```
//!
//! Video processor (i, j) of p x q draws the pixels (p X + i, q Y + j) of the screen: a raster as large as the screen, and sparse. Its windows
//! are squares of 2^s x 2^s of these samples. The window of all of them, level 0, is divided into quarters, and those that the polygon may cover are
//! divided again, down to single samples on level n.
//!
//! | file | what is in it |
//! |---|---|
//! | [`mod@format`] | the sizes, and the records: packets, windows, polygons |
//! | [`set_up`] | a polygon of the screen becomes one of the samples |
//! | [`coverage_test`] | the unit that tests quarters |
//! | [`divider`], [`stack`], [`pipe`], [`tree`], [`raster`] | raster processors made of such units |
//! | [`pixel`], [`video_buffer`] | fragments, and the pixels that are kept |
//! | [`processor`], [`controller`], [`generator`] | a video processor, what reads the picture, the whole |
//! | [`tally`] | what units count of themselves |
//!
//! Busy clocks of the units are those of the paper's cost model (MPG-EQ5, [`coverage_test`]); clocks in which a result waits are counted
//! apart.

pub mod controller;
pub mod coverage_test;
pub mod divider;
pub mod format;
pub mod generator;
mod lanes;
pub(crate) mod model;
pub mod pipe;
pub mod pixel;
pub mod processor;
pub mod raster;
pub mod set_up;
pub mod stack;
pub mod tally;
#[cfg(test)]
mod testing;
pub mod tree;
pub mod video_buffer;
