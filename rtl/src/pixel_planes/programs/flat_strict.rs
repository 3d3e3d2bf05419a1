//! A primitive in one colour. Depth alone is compared, and the first of equal depths stays.

use super::super::fields::{DEPTH, RGB};
use super::super::instruction::{Instruction, Operation};
use super::{EdgeUse, Edges, Expression, Operand, Program, Step, Surface};

/// The program: the edges' bits and 40 + 24 + 24 clocks.
pub const FLAT_STRICT: Program = Program {
    name: "flat_strict",
    edges: EdgeUse::Enable,
    is_flat: true,
    steps: &[
        Step::beside(Operation::Compare, Operand::Depth, DEPTH),
        Step::keep(DEPTH),
        Step::on(Operation::FillFlagged, Operand::Number, RGB),
    ],
};

/// The instructions that draw a primitive, with its edges as least half-planes.
pub fn flat_strict(side: u32, edges: &[Expression], z: &Expression, rgb: u32) -> Vec<Instruction<u64>> {
    FLAT_STRICT.draw(side, Edges::Least, edges, &Surface::of_one_colour(*z, rgb))
}
