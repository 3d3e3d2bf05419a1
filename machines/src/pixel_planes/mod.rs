//! Pixel-planes 5: renderers, each an array of 128x128 pixel processors, that take the screen's regions one after another.
//!
//! Here is what of it is not hardware: which regions a primitive is binned to, which renderer takes which region, and what the paper says of
//! both in formulas.
//!
//! ```text
//! primitives -> Outline -- Binner --> bins of Regions -- allocate --> Allocation: the regions of each renderer, P_w
//! Vectors ---------------> Study: regions a vector, counted, beside those by Shape's formulas
//! ```
//!
//! Source: "Renderer performance" of the Pixel-planes 5 paper, facts A0 (PP5).

mod allocator;
mod formulas;
mod outline;
mod regions;
mod study;
mod vectors;

pub use allocator::{Allocation, Renderer, allocate};
pub use formulas::{
    PERIOD, Shape, VECTOR_CYCLES, greatest_load, greatest_load_of_whole_regions, least_load, update_time,
};
pub use outline::{Binner, Outline};
pub use regions::Regions;
pub use study::{Bins, Point, Study};
pub use vectors::Vectors;
