//! The hardware blocks of the rendering machines.

pub mod bus;
pub mod catalog;
pub mod clocks;
mod delays;
pub mod gfb;
pub mod lfb;
pub mod merger;
pub mod parameter;
pub mod pixel_planes;
pub mod pixelflow;
mod prelude;
pub mod quadtree;
pub mod scan;
pub mod swap;
pub mod vc1;
pub mod word;
