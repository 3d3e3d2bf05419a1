//! A circuit as data: modules of nodes, registers, memories and instances, the rules that they keep, and the values that
//! they compute.
//!
//! `tilewright-hdl` elaborates a description into a [`Design`]. `tilewright-sim` runs it, and `tilewright-gen` prints it. A
//! tool may make a design or edit one: [`Design::new`](ir::Design::new) checks it against the rules of [`ir`].
//!
//! The language gives out everything here, so a description needs no other import than `tilewright_hdl`.

mod bits;
mod clock;
mod edge;
mod foreign;
#[doc(hidden)]
pub mod graph;
pub mod ir;
mod lane_loops;
#[doc(hidden)]
pub mod limbs;
#[doc(hidden)]
pub mod limits;
mod loc;
#[doc(hidden)]
pub mod loops;
mod mistake;
#[doc(hidden)]
pub mod names;
#[doc(hidden)]
pub mod netlist;
mod problem;
mod radix;
pub mod recording;
mod reset;
#[doc(hidden)]
pub mod summary;

#[doc(hidden)]
pub use bits::width_below;
pub use bits::{Bits, index_width, limbs_for, top_mask};
pub use clock::{Clock, DefaultClock, Period};
pub use edge::Edge;
pub use ir::{About, Design, Foreign, ReadUnderWrite, Shape};
pub use loc::Loc;
pub use mistake::Mistake;
pub use problem::{Problem, Problems};
pub use radix::Radix;
pub use recording::Recording;
pub use reset::Reset;
