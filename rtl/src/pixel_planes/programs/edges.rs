//! How edges are sent: which ones, in which form, and in how many bits.
//!
//! Source: facts E0 (widths), E3 (reduced edges).

use super::super::instruction::{Instruction, Operation};
use super::{Expression, alone, half_plane, modular};

/// The form in which edges that cross a region are sent; all forms draw the same pixels. An edge with the whole region
/// inside is left out. A primitive is left out if one of its edges has the whole region outside.
///
/// ```
/// use tilewright_rtl::pixel_planes::programs::{Edges, Expression};
///
/// let edge = Expression { a: 2_000, b: 3_000, c: -190_000 };
/// assert_eq!([Edges::Fixed, Edges::Own, Edges::Least].map(|form| form.bits(128, &edge)), [25, 20, 10]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Edges {
    /// Unchanged, with the bits that any edge may need: 18 + log2 S, or 25 for S = 128.
    Fixed,
    /// Unchanged, with the bits that its values in the region need.
    Own,
    /// As the [least half-plane](half_plane) with the same pixels inside, with the bits that its values need.
    Least,
}

impl Edges {
    /// All forms.
    pub const ALL: [Edges; 3] = [Edges::Fixed, Edges::Own, Edges::Least];

    /// The form's name on the command line and in reports.
    pub fn name(self) -> &'static str {
        match self {
            Edges::Fixed => "fixed",
            Edges::Own => "own",
            Edges::Least => "least",
        }
    }

    /// The bits, and so the clocks, of an edge that crosses a region of `side` x `side` pixels; 0 for any other edge.
    /// There are at least as many bits as the trees have levels.
    pub fn bits(self, side: u32, edge: &Expression) -> u32 {
        let [least, greatest] = range(side, edge);
        if least < 0 && greatest >= 0 { self.sent(side, edge).1 } else { 0 }
    }

    /// The form in which the edge is sent, and its number of bits, if the edge crosses the region.
    fn sent(self, side: u32, edge: &Expression) -> (Expression, u32) {
        let levels = side.trailing_zeros();
        let own = |edge: Expression| {
            let [least, greatest] = range(side, &edge);
            (edge, bits(least).max(bits(greatest)).max(levels))
        };
        match self {
            // |a| and |b| are below 2^16, so a value is below 2^(17 + log2 S); the sign takes one more bit.
            Edges::Fixed => (*edge, 18 + levels),
            Edges::Own => own(*edge),
            Edges::Least => own(half_plane::least(side, edge)),
        }
    }

    /// The instructions that enable the pixels inside all edges; `None` if one edge has the whole region outside.
    /// There is at least one instruction, and the first needs no memory.
    pub(super) fn tests(self, side: u32, edges: &[Expression]) -> Option<Vec<Instruction<u64>>> {
        let mut program = Vec::new();
        for edge in edges {
            let [least, greatest] = range(side, edge);
            if greatest < 0 {
                return None;
            }
            if least < 0 {
                let operation = if program.is_empty() { Operation::TestFirst } else { Operation::Test };
                let (edge, bits) = self.sent(side, edge);
                program.push(sign(operation, &edge, bits));
            }
        }
        if program.is_empty() {
            program.push(alone(Operation::Enable));
        }
        Some(program)
    }
}

/// The least and the greatest value of an expression in a region.
pub(super) fn range(side: u32, expression: &Expression) -> [i64; 2] {
    let &Expression { a, b, c } = expression;
    let across = [a, b].map(|step| step * i64::from(side - 1));
    [c + across.iter().map(|step| step.min(&0)).sum::<i64>(), c + across.iter().map(|step| step.max(&0)).sum::<i64>()]
}

/// The bits of a number in two's complement.
pub(super) fn bits(number: i64) -> u32 {
    65 - number.max(!number).leading_zeros()
}

/// The instruction that processes the sign of an expression whose values have this number of bits.
pub(super) fn sign(operation: Operation, edge: &Expression, bits: u32) -> Instruction<u64> {
    Instruction { skip: (bits - 1).into(), coefficients: modular(edge), ..alone(operation) }
}
