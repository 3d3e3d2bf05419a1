//! The hardware blocks of the rendering machines.
//!
//! # Block diagrams
//!
//! Each block of the [`catalog`] draws its own diagram, from the circuit:
//!
//! ```text
//! tilewright diagram vc1 -o vc1.svg                           # boxes, memories, registers, streams as thick arrows, clocks by colour
//! tilewright diagram quadtree-generator --depth 2 -o qt.svg   # with its instances opened
//! tilewright diagram patch-table --around stage1 --ascii      # what leads to one register, and what it leads to
//! ```
//!
//! Those of the whole machines are in `docs/diagrams`. A program draws them by `tilewright_gen::diagram`.

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
