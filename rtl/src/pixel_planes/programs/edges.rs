//! How edges are sent: which of them, as what, and in how many bits.
//!
//! Source: facts E0 (widths), E3 (reduced edges).

use super::super::instruction::{Instruction, Operation};
use super::{Expression, alone, half_plane, modular};

/// The form in which edges that cross a region are sent; all draw the same pixels. An edge that has all pixels of the region inside is left out,
/// and with one that has none so is the primitive.
///
/// ```
/// use tilewright_rtl::pixel_planes::programs::{Edges, Expression};
///
/// let edge = Expression { a: 2_000, b: 3_000, c: -190_000 };
/// assert_eq!([Edges::Fixed, Edges::Own, Edges::Least].map(|form| form.bits(128, &edge)), [25, 20, 10]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Edges {
    /// As they are, in as many bits as any edge may need: 18 + log2 S, 25 where S is 128.
    Fixed,
    /// As they are, in as many bits as their values in the region need.
    Own,
    /// As the [least half-plane](half_plane) with the same pixels inside, in as many bits as its values need.
    Least,
}

impl Edges {
    /// All forms.
    pub const ALL: [Edges; 3] = [Edges::Fixed, Edges::Own, Edges::Least];

    /// As the command line and reports name it.
    pub fn name(self) -> &'static str {
        match self {
            Edges::Fixed => "fixed",
            Edges::Own => "own",
            Edges::Least => "least",
        }
    }

    /// The bits of an edge that crosses a region of `side` x `side` pixels, which are the clocks that it takes; 0 of any other. At least as many as
    /// the trees have levels.
    pub fn bits(self, side: u32, edge: &Expression) -> u32 {
        let [least, greatest] = range(side, edge);
        if least < 0 && greatest >= 0 { self.sent(side, edge).1 } else { 0 }
    }

    /// As what it is sent, and in how many bits, if it crosses the region.
    fn sent(self, side: u32, edge: &Expression) -> (Expression, u32) {
        let levels = side.trailing_zeros();
        let own = |edge: Expression| {
            let [least, greatest] = range(side, &edge);
            (edge, bits(least).max(bits(greatest)).max(levels))
        };
        match self {
            // |a| and |b| are below 2^16, so a value is below 2^(17 + log2 S); and there is the sign.
            Edges::Fixed => (*edge, 18 + levels),
            Edges::Own => own(*edge),
            Edges::Least => own(half_plane::least(side, edge)),
        }
    }

    /// Instructions that enable the pixels inside all edges; `None` if one of them leaves nothing of the region. There is always one, and what
    /// is first needs no memory.
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

/// The sign of an expression, whose values are numbers of so many bits.
pub(super) fn sign(operation: Operation, edge: &Expression, bits: u32) -> Instruction<u64> {
    Instruction { skip: (bits - 1).into(), coefficients: modular(edge), ..alone(operation) }
}
