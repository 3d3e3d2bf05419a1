//! Rules that make expressions smaller, for whatever holds cells.

use tilewright_hdl::ir::{Binary, Relation};
use tilewright_hdl::{Bits, limbs_for};

use super::{Kind, ValueId};
use crate::engine::semantics::{Number, evaluate};

/// Values and how they come about.
pub(crate) trait Cells {
    /// How a value comes about.
    fn kind(&self, id: ValueId) -> &Kind;
    /// Its width in bits.
    fn width(&self, id: ValueId) -> u32;
}

fn constant(cells: &impl Cells, id: ValueId) -> Option<&Bits> {
    match cells.kind(id) {
        Kind::Const(bits) => Some(bits),
        _ => None,
    }
}

/// The value of an operation whose operands are all constant, the same in every lane.
pub(crate) fn fold(cells: &impl Cells, kind: &Kind, width: u32) -> Option<Bits> {
    match kind {
        Kind::Broadcast(of, _) | Kind::Tile(of, _) | Kind::Lane { of, .. } => constant(cells, *of).cloned(),
        kind if kind.is_elementwise() => {
            let mut known = true;
            kind.for_each_operand(|operand| known &= constant(cells, operand).is_some());
            known.then(|| {
                let mut limbs = vec![0; limbs_for(width)];
                evaluate(kind, width, &mut limbs, |of| {
                    let bits = constant(cells, of).expect("every operand is constant");
                    Number { limbs: bits.limbs(), width: bits.width() }
                });
                Bits::from_limbs(width, &limbs)
            })
        }
        _ => None,
    }
}

/// The value that this is another name for: names, and groups of one lane, which engines do not know.
pub(crate) fn name(kind: &Kind) -> Option<ValueId> {
    match kind {
        Kind::Alias(of) | Kind::Broadcast(of, 1) | Kind::Tile(of, 1) => Some(*of),
        Kind::PerLane(parts) if parts.len() == 1 => Some(parts[0]),
        Kind::Lane { of, group: 1, .. } | Kind::Reduce { of, group: 1, .. } | Kind::Shifted { of, by: 0, .. } => {
            Some(*of)
        }
        Kind::Shifted { edge, group: 1, .. } => Some(*edge),
        _ => None,
    }
}

/// The operand that an operation is the same as.
pub(crate) fn alias(cells: &impl Cells, kind: &Kind, width: u32) -> Option<ValueId> {
    if let Some(of) = name(kind) {
        return Some(of);
    }
    let is_zero = |of: ValueId| constant(cells, of).is_some_and(Bits::is_zero);
    let is_ones = |of: ValueId| constant(cells, of).is_some_and(|bits| *bits == Bits::ones(bits.width()));
    match kind {
        Kind::Repeat(of, 1) => Some(*of),
        Kind::Slice(of, 0) | Kind::Extend(of, _) if cells.width(*of) == width => Some(*of),
        Kind::Concat(parts) if parts.len() == 1 => Some(parts[0]),
        Kind::Mux { on_true, on_false, .. } if on_true == on_false => Some(*on_true),
        Kind::Mux { select, on_true, on_false } => {
            let select = constant(cells, *select)?;
            Some(if select.is_zero() { *on_false } else { *on_true })
        }
        Kind::Lane { of, index, group } => match cells.kind(*of) {
            Kind::Broadcast(plain, n) if n == group => Some(*plain),
            Kind::PerLane(parts) if parts.len() == *group as usize => Some(parts[*index as usize]),
            _ => None,
        },
        Kind::Case { subject, arms, default } => {
            if arms.iter().all(|(_, value)| value == default) {
                return Some(*default);
            }
            let subject = constant(cells, *subject)?;
            Some(arms.iter().find(|(key, _)| key == subject).map_or(*default, |(_, value)| *value))
        }
        Kind::Binary(Binary::And, a, b) => match () {
            () if a == b || is_zero(*a) || is_ones(*b) => Some(*a),
            () if is_zero(*b) || is_ones(*a) => Some(*b),
            () => None,
        },
        Kind::Binary(Binary::Or, a, b) => match () {
            () if a == b || is_zero(*b) || is_ones(*a) => Some(*a),
            () if is_zero(*a) || is_ones(*b) => Some(*b),
            () => None,
        },
        Kind::Binary(Binary::Xor | Binary::Add, a, b) if is_zero(*a) => Some(*b),
        Kind::Binary(Binary::Xor | Binary::Add | Binary::Sub, a, b) if is_zero(*b) => Some(*a),
        Kind::Shift(_, a, by) if is_zero(*by) || is_zero(*a) => Some(*a),
        Kind::Compare(Relation::Eq, _, a, b) if width == 1 && cells.width(*a) == 1 => match () {
            () if is_ones(*a) => Some(*b),
            () if is_ones(*b) => Some(*a),
            () => None,
        },
        _ => None,
    }
}

/// A choice without the arms that are never taken, or do not differ from the default.
pub(crate) fn shorter(cells: &impl Cells, kind: &Kind) -> Option<Kind> {
    match kind {
        Kind::Select { arms, default } => {
            let known = |condition: ValueId| constant(cells, condition).map(|bits| !bits.is_zero());
            let mut default = *default;
            let mut kept: Vec<(ValueId, ValueId)> = Vec::new();
            for &(condition, value) in arms {
                match known(condition) {
                    Some(false) => {}
                    Some(true) => {
                        default = value;
                        break;
                    }
                    None => kept.push((condition, value)),
                }
            }
            while kept.last().is_some_and(|(_, value)| *value == default) {
                kept.pop();
            }
            match kept.as_slice() {
                [] => Some(Kind::Alias(default)),
                &[(select, on_true)] => Some(Kind::Mux { select, on_true, on_false: default }),
                _ => (kept.len() < arms.len()).then_some(Kind::Select { arms: kept, default }),
            }
        }
        Kind::Case { subject, arms, default } => {
            let kept: Vec<_> = arms.iter().filter(|(_, value)| value != default).cloned().collect();
            (kept.len() < arms.len()).then_some(Kind::Case { subject: *subject, arms: kept, default: *default })
        }
        _ => None,
    }
}
