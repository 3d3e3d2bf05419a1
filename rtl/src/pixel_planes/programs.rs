//! The instructions that draw a primitive in a region, clear one and save one (facts E0, E3).
//!
//! All are functions from coefficients to instructions, as whoever controls a renderer would make them. What is less is nearer; a pixel
//! keeps what its rule says:
//!
//! | rule | a fragment is kept if | primitives of one colour | with colour planes |
//! |---|---|---|---|
//! | none | it is drawn last | [`flat`] | |
//! | strict | its depth is less: of equal ones the first stays | [`flat_strict`] | [`smooth_strict`] |
//! | least word | its z \|\| rgb is less, in whatever order they come | [`flat_least`] | [`smooth_least`] |
//!
//! A triangle, a polygon and a vector differ only in the number of their edges; a vector is a polygon of four.
//!
//! Clocks from a primitive's first instruction to that of the next one of its kind, N of PP5-UT, as
//! `cargo test -p tilewright-rtl a_primitive_takes_the_clocks` counts them; the paper's 239 ns a vector come of 94 (PP5-UTV):
//!
//! | program | edges | one at a time | side by side |
//! |---|---|---|---|
//! | [`flat`] | 4 of 15 bits | 84 | 61 |
//! | [`flat_strict`] | 4 of 15 bits | 148 | 102 |
//! | [`flat_least`] | 4 of 15 bits | 172 | 102 |
//! | [`smooth_strict`] | 3 of 16 bits | 184 | 161 |
//! | [`smooth_least`] | 3 of 16 bits | 208 | 161 |
//!
//! ```
//! use tilewright_rtl::pixel_planes::programs::{Expression, clear, flat, save};
//!
//! // A region of 8 x 8 pixels, orange where x is 3 or more and x - y is 0 or more.
//! let edges = [Expression { a: 1, b: 0, c: -3 }, Expression { a: 1, b: -1, c: 0 }];
//! let program = [clear(0x00_00_00), flat(8, &edges, 0xff_80_00), save(17)].concat();
//! let clocks: Vec<u64> = program.iter().map(|instruction| instruction.skip + instruction.length).collect();
//! assert_eq!(clocks, [24, 24, 4, 4, 24, 48]);
//! ```

use super::fields::{BLUE, DEPTH, Field, GREEN, RED, RGB, WORD};
use super::instruction::{COEFFICIENT, Instruction, Operation};
use super::linear_tree::Coefficients;
use crate::prelude::Codes;

/// A x + B y + C over the pixels of a region, (0, 0) at its upper left. An edge is inside where it is 0 or more; a plane counts modulo 2^40,
/// a colour modulo 2^24, with 16 bits of fraction.
pub type Expression = Coefficients<i64>;

/// The fraction bits of planes.
const FRACTION: u32 = 16;

/// The planes of a primitive whose colour is not the same everywhere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Surface {
    /// Depth.
    pub z: Expression,
    /// Red, green and blue.
    pub rgb: [Expression; 3],
}

/// Empties a region: nothing is farther, and the colour is the background's.
pub fn clear(background: u32) -> Vec<Instruction<u64>> {
    vec![constant(Operation::Fill, RGB, background.into()), constant(Operation::Fill, DEPTH, -1)]
}

/// Saves the region, under its number, when the one saved before is sent.
pub fn save(region: u32) -> Vec<Instruction<u64>> {
    vec![constant(Operation::Save, WORD, region.into())]
}

/// A primitive of one colour without depth, the last one in front: the edges' bits and 24 clocks.
pub fn flat(side: u32, edges: &[Expression], rgb: u32) -> Vec<Instruction<u64>> {
    let Some(mut program) = tests(side, edges) else { return Vec::new() };
    match program.last_mut() {
        Some(last) if last.operation == Operation::Test.code() => last.operation = Operation::TestLast.code(),
        _ => program.push(alone(Operation::Flag)),
    }
    program.push(constant(Operation::FillFlagged, RGB, rgb.into()));
    program
}

/// A primitive of one colour; of equal depths the first stays: the edges' bits and 40 + 24 + 24 clocks.
pub fn flat_strict(side: u32, edges: &[Expression], z: &Expression, rgb: u32) -> Vec<Instruction<u64>> {
    let Some(mut program) = tests(side, edges) else { return Vec::new() };
    program.push(plane(Operation::Compare, z, DEPTH, DEPTH.new_value()));
    program.push(copy(Operation::CopyFlagged, DEPTH.new_value(), DEPTH));
    program.push(constant(Operation::FillFlagged, RGB, rgb.into()));
    program
}

/// A primitive of one colour; the least word stays: the edges' bits and 24 + 40 + 48 clocks.
pub fn flat_least(side: u32, edges: &[Expression], z: &Expression, rgb: u32) -> Vec<Instruction<u64>> {
    let Some(mut program) = tests(side, edges) else { return Vec::new() };
    // Before the last edge: its lower bits need no memory, so the constant is compared meanwhile.
    program.insert(program.len() - 1, constant(Operation::CompareConstant, RGB, rgb.into()));
    program.push(plane(Operation::CompareOn, z, DEPTH, DEPTH.new_value()));
    program.push(copy(Operation::CopyFlagged, DEPTH.new_value(), DEPTH));
    program.push(constant(Operation::FillFlagged, RGB, rgb.into()));
    program
}

/// A primitive with planes of colour; of equal depths the first stays: the edges' bits and 40 + 72 + 24 clocks.
pub fn smooth_strict(side: u32, edges: &[Expression], surface: &Surface) -> Vec<Instruction<u64>> {
    let Some(mut program) = tests(side, edges) else { return Vec::new() };
    program.push(plane(Operation::Compare, &surface.z, DEPTH, DEPTH.new_value()));
    for (colour, field) in surface.rgb.iter().zip([RED, GREEN, BLUE]) {
        program.push(plane(Operation::EvaluateFlagged, colour, field, field));
    }
    program.push(copy(Operation::CopyFlagged, DEPTH.new_value(), DEPTH));
    program
}

/// A primitive with planes of colour; the least word stays: the edges' bits and 72 + 40 + 48 clocks.
pub fn smooth_least(side: u32, edges: &[Expression], surface: &Surface) -> Vec<Instruction<u64>> {
    let Some(mut program) = tests(side, edges) else { return Vec::new() };
    let [red, green, blue] = &surface.rgb;
    let upward = [(blue, BLUE), (green, GREEN), (red, RED), (&surface.z, DEPTH)];
    for (number, (expression, field)) in upward.into_iter().enumerate() {
        let operation = if number == 0 { Operation::Compare } else { Operation::CompareOn };
        program.push(plane(operation, expression, field, field.new_value()));
    }
    program.push(copy(Operation::CopyFlagged, WORD.new_value(), WORD));
    program
}

/// Enables the pixels inside all edges. Those that do not cross the region are left out, as their sign would need more bits than their
/// values at its pixels do; `None` if one of them leaves nothing of it.
fn tests(side: u32, edges: &[Expression]) -> Option<Vec<Instruction<u64>>> {
    let mut program = Vec::new();
    for edge in edges {
        let [least, greatest] = range(side, edge);
        if greatest < 0 {
            return None;
        }
        if least < 0 {
            let operation = if program.is_empty() { Operation::TestFirst } else { Operation::Test };
            program.push(sign(operation, edge, bits(least).max(bits(greatest)).max(side.trailing_zeros())));
        }
    }
    if program.is_empty() {
        program.push(alone(Operation::Enable));
    }
    Some(program)
}

/// The least and the greatest value of an expression in a region.
fn range(side: u32, expression: &Expression) -> [i64; 2] {
    let &Coefficients { a, b, c } = expression;
    let across = [a, b].map(|step| step * i64::from(side - 1));
    [c + across.iter().map(|step| step.min(&0)).sum::<i64>(), c + across.iter().map(|step| step.max(&0)).sum::<i64>()]
}

/// The bits of a number in two's complement.
fn bits(number: i64) -> u32 {
    65 - number.max(!number).leading_zeros()
}

/// The sign of an expression, whose values are numbers of so many bits.
fn sign(operation: Operation, edge: &Expression, bits: u32) -> Instruction<u64> {
    Instruction { skip: (bits - 1).into(), coefficients: modular(edge), ..alone(operation) }
}

/// The whole part of a plane, for one field, beside the word in another.
fn plane(operation: Operation, plane: &Expression, read: Field, write: Field) -> Instruction<u64> {
    Instruction { skip: FRACTION.into(), coefficients: modular(plane), ..copy(operation, read, write) }
}

fn constant(operation: Operation, field: Field, value: i64) -> Instruction<u64> {
    let coefficients = modular(&Coefficients { a: 0, b: 0, c: value });
    Instruction { coefficients, ..copy(operation, field, field) }
}

fn copy(operation: Operation, read: Field, write: Field) -> Instruction<u64> {
    Instruction {
        length: write.bits.into(),
        read: read.address.into(),
        write: write.address.into(),
        ..alone(operation)
    }
}

/// What needs neither word nor expression.
fn alone(operation: Operation) -> Instruction<u64> {
    let coefficients = Coefficients { a: 0, b: 0, c: 0 };
    Instruction { operation: operation.code(), skip: 0, length: 1, read: 0, write: 0, coefficients }
}

fn modular(expression: &Expression) -> Coefficients<u64> {
    let modular = |number: i64| number as u64 & ((1 << COEFFICIENT) - 1);
    let &Coefficients { a, b, c } = expression;
    Coefficients { a: modular(a), b: modular(b), c: modular(c) }
}

#[cfg(test)]
mod tests;
