//! Values of operators whose operands are constants.

use std::cmp::Ordering;
use tilewright_circuit::Bits;
use tilewright_circuit::ir::{Binary, NodeId, Op, Relation, Unary};

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
        (Op::Unary(op, _), [a]) => Some(unary(*op, a)),
        (Op::Binary(op, ..), [a, b]) => binary(*op, a, b),
        (Op::Compare { relation, signed, .. }, [a, b]) => Some(Bits::from(compare(*relation, *signed, a, b))),
        (Op::Mux { .. }, &[select, on_true, on_false]) => {
            Some(if select.is_zero() { on_false } else { on_true }.clone())
        }
        (Op::Slice { low, .. }, [a]) => Some(a.slice(*low..low + width)),
        (Op::Extend { signed: true, .. }, [a]) => Some(a.sext(width)),
        (Op::Extend { signed: false, .. }, [a]) => Some(a.resize(width)),
        _ => None,
    }
}

/// The value of a unary operator.
pub fn unary(op: Unary, a: &Bits) -> Bits {
    match op {
        Unary::Not => a.not(),
        Unary::AllOnes => Bits::from(a.not().is_zero()),
        Unary::AnyOne => Bits::from(!a.is_zero()),
        Unary::Parity => Bits::from(a.limbs().iter().map(|limb| limb.count_ones()).sum::<u32>() % 2 == 1),
    }
}

/// The value of a binary operator, if it is cheap to compute; sums and products beyond 128 bits are left to the
/// tools.
pub fn binary(op: Binary, a: &Bits, b: &Bits) -> Option<Bits> {
    let width = a.width();
    let by_limb = |f: fn(u64, u64) -> u64| {
        let limbs: Vec<u64> = a.limbs().iter().zip(b.limbs()).map(|(&a, &b)| f(a, b)).collect();
        Some(Bits::from_limbs(width, &limbs))
    };
    match op {
        Binary::And => by_limb(|a, b| a & b),
        Binary::Or => by_limb(|a, b| a | b),
        Binary::Xor => by_limb(|a, b| a ^ b),
        Binary::Add if width <= 128 => Some(Bits::from_u128(width, a.to_u128()?.wrapping_add(b.to_u128()?))),
        Binary::Sub if width <= 128 => Some(Bits::from_u128(width, a.to_u128()?.wrapping_sub(b.to_u128()?))),
        Binary::Mul if width + b.width() <= 128 => {
            Some(Bits::from_u128(width + b.width(), a.to_u128()?.wrapping_mul(b.to_u128()?)))
        }
        Binary::MulSigned if width + b.width() <= 128 => {
            Some(Bits::from_i128(width + b.width(), a.to_i128()?.wrapping_mul(b.to_i128()?)))
        }
        _ => None,
    }
}

/// Whether the relation is true.
pub fn compare(relation: Relation, signed: bool, a: &Bits, b: &Bits) -> bool {
    let negative = |x: &Bits| signed && x.bit(x.width() - 1);
    let order = match (negative(a), negative(b)) {
        (true, false) => Ordering::Less,
        (false, true) => Ordering::Greater,
        _ => a.limbs().iter().rev().cmp(b.limbs().iter().rev()),
    };
    match relation {
        Relation::Eq => order.is_eq(),
        Relation::Ne => order.is_ne(),
        Relation::Lt => order.is_lt(),
        Relation::Le => order.is_le(),
        Relation::Gt => order.is_gt(),
        Relation::Ge => order.is_ge(),
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wide_values_compare_from_the_top() {
        let (low, high) = range(130, true);
        assert!(compare(Relation::Lt, true, &low, &high));
        assert!(compare(Relation::Gt, false, &low, &high));
        assert!(compare(Relation::Ge, true, &Bits::zero(130), &Bits::ones(130)));
        assert!(!compare(Relation::Gt, true, &low, &high));
        assert!(!compare(Relation::Le, false, &low, &high));
        assert!(!compare(Relation::Eq, true, &Bits::zero(130), &Bits::ones(130)));
        // The highest limb decides, whatever the lower ones are.
        let (less, more) = (Bits::from_limbs(130, &[u64::MAX, 5, 0]), Bits::from_limbs(130, &[0, 5, 1]));
        assert!(compare(Relation::Lt, false, &less, &more) && !compare(Relation::Ge, false, &less, &more));
        assert!(compare(Relation::Ne, true, &less, &more) && compare(Relation::Le, true, &more, &more));
    }
}
