//! The hardware blocks of the rendering machines.
//!
//! # Block diagrams
//!
//! The command line draws each block of the [`catalog`] from its circuit:
//!
//! ```text
//! tilewright diagram vc1 -o vc1.svg                           # boxes, memories, registers, streams as thick arrows, clocks by colour
//! tilewright diagram quadtree-generator --depth 2 -o qt.svg   # with the contents of its instances
//! tilewright diagram patch-table --around stage1 --ascii      # what feeds one register, and what it feeds
//! ```
//!
//! Those of the four machines are in `docs/diagrams`. Programs call `tilewright_gen::diagram`.

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
