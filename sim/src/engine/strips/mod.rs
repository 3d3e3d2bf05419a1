//! The strip program: what a function does, instruction by instruction, before it is machine code.
//!
//! It is straight-line code in regions: loops, choices and what runs only if a flag is 1. Loads and stores name an address and an offset. Its
//! target says how many bits a vector has.

mod bounds;
mod builder;
#[cfg(test)]
mod checks;
mod commits;
mod evaluate;
mod examined;
mod methods;
mod names;
mod operation;
mod parse;
mod probe;
mod program;
mod settled;
mod text;
mod unused;
mod value;
mod verify;

pub(super) use bounds::{Base, Extent, Only, Surroundings};
pub(super) use builder::{Builder, Kept};
pub(super) use commits::Touched;
#[cfg(test)]
pub(super) use evaluate::Memory;
pub(super) use evaluate::{Calls, Places, Wild};
pub use examined::Examined;
#[cfg(test)]
pub(super) use names::{BINARIES, COMPARISONS, LOADS, UNARIES};
pub(super) use operation::{Binary, Comparison, Load, Operation, Unary};
pub(super) use program::{Loop, Program, Region, Statement};
pub(super) use text::Notes;
#[cfg(test)]
pub(super) use value::Bytes;
pub(super) use value::{Type, Value};
