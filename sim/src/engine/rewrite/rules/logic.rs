//! Operations that equal one of their operands.

use tilewright_circuit::Bits;
use tilewright_circuit::ir::{Binary, Relation};

use super::super::{Rewrite, Rewriter};
use crate::engine::program::{Cell, Kind, ValueId};

/// `a & a`, `a | 0`, `a + 0`, a slice of all bits, `flag == 1` and the like are `a`.
pub(super) fn identity(rewriter: &mut Rewriter, cell: &Cell) -> Option<Rewrite> {
    let circuit = rewriter.circuit();
    let is_zero = |of: ValueId| circuit.constant(of).is_some_and(Bits::is_zero);
    let is_ones = |of: ValueId| circuit.constant(of).is_some_and(|bits| *bits == Bits::ones(bits.width()));
    let same = match &cell.kind {
        Kind::Repeat(of, 1) => *of,
        Kind::Slice(of, 0) | Kind::Extend(of, _) if circuit[*of].width == cell.width => *of,
        Kind::Concat(parts) if parts.len() == 1 => parts[0],
        Kind::Binary(Binary::And, a, b) if a == b || is_zero(*a) || is_ones(*b) => *a,
        Kind::Binary(Binary::And, a, b) if is_zero(*b) || is_ones(*a) => *b,
        Kind::Binary(Binary::Or, a, b) if a == b || is_zero(*b) || is_ones(*a) => *a,
        Kind::Binary(Binary::Or, a, b) if is_zero(*a) || is_ones(*b) => *b,
        Kind::Binary(Binary::Xor | Binary::Add, a, b) if is_zero(*a) => *b,
        Kind::Binary(Binary::Xor | Binary::Add | Binary::Sub, a, b) if is_zero(*b) => *a,
        Kind::Shift(_, a, by) if is_zero(*by) || is_zero(*a) => *a,
        Kind::Compare(Relation::Eq, _, a, b) if circuit[*a].width == 1 && is_ones(*a) => *b,
        Kind::Compare(Relation::Eq, _, a, b) if circuit[*a].width == 1 && is_ones(*b) => *a,
        _ => return None,
    };
    Some(Rewrite::Same(same))
}
