//! A synchronous hardware language embedded in Rust.

mod bits;
mod block;
mod bundle;
mod check;
pub mod clock;
mod draft;
mod elaboration;
mod finish;
mod graph;
mod instance;
pub mod ir;
mod lanes;
mod loc;
mod memory;
mod module;
mod names;
mod operand;
mod problem;
mod register;
mod select;
mod signal;
mod signed;
mod summary;
mod width;
mod wire;

pub use bits::{Bits, limbs_for, top_mask};
pub use block::{Block, DEFAULT_PERIOD, Typed, elaborate, elaborate_at, elaborate_typed};
#[doc(hidden)]
pub use bundle::join;
pub use bundle::{Bundle, Fields, Leaf};
pub use clock::{Clock, Period};
pub use ir::{About, Design, ReadUnderWrite};
pub use lanes::{Array, Lanes};
pub use loc::Loc;
pub use memory::Mem;
pub use module::Module;
pub use operand::{Operand, ShiftAmount};
pub use problem::{Problem, Problems};
pub use register::{Reg, StateReg, States, Transition, goto, hold, when};
pub use select::{case, concat, lit, mux, mux_bundle, select};
pub use signal::Signal;
pub use signed::{Signed, SignedOperand};
pub use width::{Width, bit, bits, index_width};
pub use wire::Wire;
