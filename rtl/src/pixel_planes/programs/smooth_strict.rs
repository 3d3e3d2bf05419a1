//! A primitive with planes of colour. Depth alone is compared, and the first of equal depths stays.

use super::super::fields::{BLUE, DEPTH, GREEN, RED};
use super::super::instruction::{Instruction, Operation};
use super::{EdgeUse, Edges, Expression, Operand, Program, Step, Surface};

/// The program: the edges' bits and 40 + 72 + 24 clocks.
pub const SMOOTH_STRICT: Program = Program {
    name: "smooth_strict",
    edges: EdgeUse::Enable,
    is_flat: false,
    steps: &[
        Step::beside(Operation::Compare, Operand::Depth, DEPTH),
        Step::on(Operation::EvaluateFlagged, Operand::Red, RED),
        Step::on(Operation::EvaluateFlagged, Operand::Green, GREEN),
        Step::on(Operation::EvaluateFlagged, Operand::Blue, BLUE),
        Step::keep(DEPTH),
    ],
};

/// The instructions that draw a primitive, with its edges as least half-planes.
pub fn smooth_strict(side: u32, edges: &[Expression], surface: &Surface) -> Vec<Instruction<u64>> {
    SMOOTH_STRICT.draw(side, Edges::Least, edges, surface)
}
