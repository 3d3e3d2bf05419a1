//! A primitive in one colour; each pixel keeps the least word z || rgb.

use super::super::fields::{DEPTH, RGB};
use super::super::instruction::{Instruction, Operation};
use super::{EdgeUse, Edges, Expression, Operand, Program, Step, Surface};

/// The program: the edges' bits and 24 + 40 + 48 clocks.
pub const FLAT_LEAST: Program = Program {
    name: "flat_least",
    edges: EdgeUse::Enable,
    is_flat: true,
    steps: &[
        // The lower part of the word. The last edge, which is still in the tree, needs no memory.
        Step::on(Operation::CompareConstant, Operand::Number, RGB),
        Step::beside(Operation::CompareOn, Operand::Depth, DEPTH),
        Step::keep(DEPTH),
        Step::on(Operation::FillFlagged, Operand::Number, RGB),
    ],
};

/// The instructions that draw a primitive, with its edges as least half-planes.
pub fn flat_least(side: u32, edges: &[Expression], z: &Expression, rgb: u32) -> Vec<Instruction<u64>> {
    FLAT_LEAST.draw(side, Edges::Least, edges, &Surface::of_one_colour(*z, rgb))
}
