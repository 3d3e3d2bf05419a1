//! The hardware blocks of the rendering machines.

pub mod catalog;
pub mod clocks;
pub mod gfb;
pub mod lfb;
pub mod merger;
pub mod parameter;
pub mod pixel_planes;
pub mod pixelflow;
mod prelude;
pub mod quadtree;
pub mod scan;
pub mod vc1;
pub mod word;
