//! Operations on a value and itself.

use tilewright_circuit::Bits;
use tilewright_circuit::ir::{Binary, Relation};

use super::super::{Rewrite, Rewriter};
use crate::engine::program::{Cell, Kind};

/// `a ^ a` and `a - a` are 0; `a == a` is 1, `a < a` is 0.
pub(super) fn operands(_: &mut Rewriter, cell: &Cell) -> Option<Rewrite> {
    let is_true = match cell.kind {
        Kind::Binary(Binary::Xor | Binary::Sub, a, b) if a == b => false,
        Kind::Compare(Relation::Ne | Relation::Lt | Relation::Gt, _, a, b) if a == b => false,
        Kind::Compare(Relation::Eq | Relation::Le | Relation::Ge, _, a, b) if a == b => true,
        _ => return None,
    };
    let bits = if is_true { Bits::ones(1) } else { Bits::zero(cell.width) };
    Some(Rewrite::As(Kind::Const(bits)))
}
