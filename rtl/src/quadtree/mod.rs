//! The sparse-raster quadtree generator: a matrix of video processors, each of which finds a polygon's pixels by
//! dividing windows (facts A2, A3, E2).
//!
//! ```text
//!              .--------------------- video processor (i, j) ----------------------.
//!              |                                                                    |
//! polygons ===>|[queue]=>[set-up]=>[raster processor]=>[pixel processor]->[buffer]--|--> controller ==> pixels
//!  to all      |                   window -> quarters                     2 banks   |      p at once
//!              '--------------------------------------------------------------------'
//! ```
//!
//! Video processor (i, j) of p x q draws the pixels (p X + i, q Y + j). This raster is as large as the screen, but
//! sparse. The processor's windows are squares of 2^s x 2^s of these samples. The window of all samples, level 0, is
//! divided into quarters. Quarters that the polygon may cover are divided again, down to single samples on level n.
//!
//! | file | contents |
//! |---|---|
//! | [`mod@format`], [`precision`] | the sizes, and the records: packets, windows, polygons |
//! | [`set_up`] | converts a polygon of the screen to a video processor's samples |
//! | [`coverage_test`] | the unit that tests quarters |
//! | [`divider`], [`stack`], [`pipe`], [`tree`], [`raster`] | raster processors made of such units |
//! | [`pixel`], [`video_buffer`], [`banks`], [`spram`] | fragments, and stored pixels |
//! | [`processor`], [`controller`], [`generator`] | a video processor, the read-out, the whole machine |
//! | [`tally`] | the units' counters |
//!
//! The units' busy clocks are those of the paper's cost model (MPG-EQ5, [`coverage_test`]). Clocks in which a result
//! waits are counted separately.

pub mod banks;
pub mod controller;
pub mod coverage_test;
pub mod divider;
pub mod format;
pub mod generator;
mod lanes;
pub(crate) mod model;
pub mod pipe;
pub mod pixel;
pub mod precision;
pub mod processor;
pub mod raster;
pub mod set_up;
pub mod spram;
pub mod stack;
pub mod tally;
#[cfg(test)]
mod testing;
pub mod tree;
pub mod video_buffer;
