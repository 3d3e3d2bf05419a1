//! A primitive in one colour without depth: the last one drawn is in front.

use super::super::fields::RGB;
use super::super::instruction::{Instruction, Operation};
use super::{EdgeUse, Edges, Expression, Operand, Program, Step, Surface};

/// The program: the edges' bits and 24 clocks.
pub const FLAT: Program = Program {
    name: "flat",
    edges: EdgeUse::EnableAndFlag,
    is_flat: true,
    steps: &[Step::on(Operation::FillFlagged, Operand::Number, RGB)],
};

/// The instructions that draw a primitive, with its edges as least half-planes.
pub fn flat(side: u32, edges: &[Expression], rgb: u32) -> Vec<Instruction<u64>> {
    let nowhere = Expression { a: 0, b: 0, c: 0 };
    FLAT.draw(side, Edges::Least, edges, &Surface::of_one_colour(nowhere, rgb))
}
