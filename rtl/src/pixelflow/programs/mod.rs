//! The programs of a node.

use super::instruction::Instruction;
pub use crate::pixel_planes::programs::{Edges, Expression, Surface};

mod assembler;
mod clear;
mod edges;
mod least_word;

pub use clear::{clear, clear_to};
pub use least_word::{Appearance, Region, Words, appearance, covered, gouraud};

/// The fraction bits of planes.
const FRACTION: u64 = 16;

#[cfg(test)]
mod tests;
