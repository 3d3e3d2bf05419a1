//! The pipelined image merger: a chain of merging units, one for each processing element (VC1-PIM).

mod image_merger;
mod unit;

pub use image_merger::{ImageMerger, ImageMergerIn, ImageMergerOut};
pub use unit::{MergingUnit, MergingUnitIn, MergingUnitOut, STAGES};
