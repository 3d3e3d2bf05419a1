//! The edges of a primitive: which ones are sent, in which form, and in how many bytes.
//!
//! Source: facts E0 (widths), E3 (reduced edges), E4 (an edge in 4 bytes, or in 2).

use super::assembler::{alu, enable};
use super::{Expression, Instruction};
use crate::pixel_planes::programs::{Edges, half_plane};
use crate::pixelflow::pixel::{Condition, Enabling, Function, Source};

/// The number of bytes that any edge fits in: |a| and |b| are below 2^16, so in a region of up to 128 x 128 pixels
/// values have 25 bits with their sign.
const FIXED: u64 = 4;

/// The instructions that enable the pixels of a region inside all edges; `None` if the whole region is outside one of
/// them. An edge with the whole region inside is left out. There is at least one instruction. No instruction uses ALU
/// or memory, so the previous primitive's result may still be written.
pub(super) fn tests(region: [u32; 2], form: Edges, edges: &[Expression]) -> Option<Vec<Instruction<u64>>> {
    let mut program = Vec::new();
    for edge in edges {
        let [least, greatest] = range(region, edge);
        if greatest < 0 {
            return None;
        }
        if least < 0 {
            let enabling = if program.is_empty() { Enabling::Replace } else { Enabling::Restrict };
            let (edge, bytes) = sent(region, form, edge);
            let sign = alu(Function::Operand, Source::Expression).expression(bytes - 1, &edge);
            program.push(sign.enables(enabling, Condition::Positive));
        }
    }
    if program.is_empty() {
        program.push(enable(Enabling::Set));
    }
    Some(program)
}

/// The form in which an edge that crosses the region is sent, and its number of bytes.
fn sent(region: [u32; 2], form: Edges, edge: &Expression) -> (Expression, u64) {
    let own = |edge: Expression| {
        let [least, greatest] = range(region, &edge);
        (edge, bytes(least).max(bytes(greatest)))
    };
    match form {
        Edges::Fixed => (*edge, FIXED),
        Edges::Own => own(*edge),
        // The least half-plane is that in the square that contains the region.
        Edges::Least => own(half_plane::least(region[0].max(region[1]), edge)),
    }
}

/// The number of bytes of a number in two's complement.
fn bytes(number: i64) -> u64 {
    u64::from(65 - number.max(!number).leading_zeros()).div_ceil(8)
}

/// The least and the greatest value of an expression in a region.
fn range([width, height]: [u32; 2], &Expression { a, b, c }: &Expression) -> [i64; 2] {
    let across = [a * i64::from(width - 1), b * i64::from(height - 1)];
    [c + across.iter().map(|step| step.min(&0)).sum::<i64>(), c + across.iter().map(|step| step.max(&0)).sum::<i64>()]
}
