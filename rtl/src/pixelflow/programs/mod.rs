//! The programs of a node.

use super::instruction::Instruction;
pub use crate::pixel_planes::programs::{Edges, Expression, Surface};

mod arithmetic;
mod assembler;
mod clear;
mod edges;
mod filter;
mod least_word;
mod light;
mod normalize;
mod perspective;
mod ports;
mod shade;

pub use clear::{clear, clear_to};
pub use least_word::{Appearance, Region, Words, appearance, covered, gouraud};
pub use ports::{await_bank, give_bank, move_word};
pub use shade::{Light, Material, NO_TEXTURE, Shader, Shading, Texture};

/// The fraction bits of planes.
const FRACTION: u64 = 16;

#[cfg(test)]
mod tests;
