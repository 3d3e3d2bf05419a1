//! Empties a region: sets the farthest depth and the background's colour.

use super::super::fields::{DEPTH, RGB};
use super::super::instruction::{Instruction, Operation};
use super::{EdgeUse, Operand, Program, Step};

/// The program: 24 + 24 clocks.
pub const CLEAR: Program = Program {
    name: "clear",
    edges: EdgeUse::None,
    is_flat: true,
    steps: &[Step::on(Operation::Fill, Operand::Number, RGB), Step::on(Operation::Fill, Operand::Farthest, DEPTH)],
};

/// The instructions that clear a region to that background colour.
pub fn clear(background: u32) -> Vec<Instruction<u64>> {
    CLEAR.of_region(background)
}
