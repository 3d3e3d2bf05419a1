//! A primitive with planes of colour; each pixel keeps the least word z || rgb.

use super::super::fields::{BLUE, DEPTH, GREEN, RED, WORD};
use super::super::instruction::{Instruction, Operation};
use super::{EdgeUse, Edges, Expression, Operand, Program, Step, Surface};

/// The program: the edges' bits and 72 + 40 + 48 clocks.
pub const SMOOTH_LEAST: Program = Program {
    name: "smooth_least",
    edges: EdgeUse::Enable,
    is_flat: false,
    steps: &[
        // The lowest part of the word comes first.
        Step::beside(Operation::Compare, Operand::Blue, BLUE),
        Step::beside(Operation::CompareOn, Operand::Green, GREEN),
        Step::beside(Operation::CompareOn, Operand::Red, RED),
        Step::beside(Operation::CompareOn, Operand::Depth, DEPTH),
        Step::keep(WORD),
    ],
};

/// The instructions that draw a primitive, with its edges as least half-planes.
pub fn smooth_least(side: u32, edges: &[Expression], surface: &Surface) -> Vec<Instruction<u64>> {
    SMOOTH_LEAST.draw(side, Edges::Least, edges, surface)
}
