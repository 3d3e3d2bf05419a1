//! Values of operators whose operands are constants.

use tilewright_circuit::Bits;
use tilewright_circuit::ir::{Binary, NodeId, Op, Reduction, Relation};

/// The operands of an operator that [`of`] can compute.
pub fn operands(op: &Op) -> Option<Vec<NodeId>> {
    match op {
        Op::Unary(_, a) | Op::Slice { of: a, .. } | Op::Extend { of: a, .. } => Some(vec![*a]),
        Op::Binary(_, a, b) | Op::Compare { operands: [a, b], .. } => Some(vec![*a, *b]),
        Op::Mux { select, on_true, on_false } => Some(vec![*select, *on_true, *on_false]),
        _ => None,
    }
}

/// The value of an operator of this width for these operands, if it is cheap to compute.
pub fn of(op: &Op, width: u32, operands: &[&Bits]) -> Option<Bits> {
    match (op, operands) {
        (Op::Unary(op, _), [a]) => Some(op.apply(a)),
        (Op::Binary(op, ..), [a, b]) => binary(*op, a, b),
        (Op::Compare { relation, signed, .. }, [a, b]) => Some(Bits::from(relation.holds(*signed, a, b))),
        (Op::Mux { .. }, &[select, on_true, on_false]) => {
            Some(if select.is_zero() { on_false } else { on_true }.clone())
        }
        (Op::Slice { low, .. }, [a]) => Some(a.slice(*low..low + width)),
        (Op::Extend { signed: true, .. }, [a]) => Some(a.sext(width)),
        (Op::Extend { signed: false, .. }, [a]) => Some(a.resize(width)),
        _ => None,
    }
}

/// The value of a binary operator, if it is cheap to compute; sums and products beyond 128 bits are left to the
/// tools.
pub fn binary(op: Binary, a: &Bits, b: &Bits) -> Option<Bits> {
    let is_cheap = match op {
        Binary::And | Binary::Or | Binary::Xor => true,
        Binary::Add | Binary::Sub => a.width() <= 128,
        Binary::Mul | Binary::MulSigned => a.width() + b.width() <= 128,
    };
    is_cheap.then(|| op.apply(a, b))
}

/// Two lanes combined, if that is cheap to compute.
pub fn combined(by: Reduction, a: &Bits, b: &Bits) -> Option<Bits> {
    match by.operator() {
        Some(operator) => binary(operator, a, b),
        None if Relation::Lt.holds(false, a, b) == (by == Reduction::Min) => Some(a.clone()),
        None => Some(b.clone()),
    }
}

/// The lowest and the highest value of a width.
pub fn range(width: u32, signed: bool) -> (Bits, Bits) {
    if !signed {
        return (Bits::zero(width), Bits::ones(width));
    }
    let lowest = match width {
        1 => Bits::ones(1),
        _ => Bits::new(1, 1).concat(&Bits::zero(width - 1)),
    };
    let highest = lowest.not();
    (lowest, highest)
}
