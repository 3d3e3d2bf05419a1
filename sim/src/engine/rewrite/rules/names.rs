//! Aliases, and axes of one lane, which engines cannot execute.

use super::super::{Rewrite, Rewriter};
use tilewright_circuit::ir::Affine;

use crate::engine::program::{Axis, Cell, Kind, ValueId};

/// `Alias(x)` is `x`; so is any operation along an axis of one lane.
pub(super) fn name(_: &mut Rewriter, cell: &Cell) -> Option<Rewrite> {
    let of = match &cell.kind {
        Kind::Alias(of) => *of,
        Kind::Stack { parts, .. } | Kind::Interleave { parts, .. } if parts.len() == 1 => parts[0],
        Kind::Broadcast { of, axis: Axis { count: 1, .. } }
        | Kind::Lane { of, axis: Axis { count: 1, .. }, .. }
        | Kind::Reduce { of, axis: Axis { count: 1, .. }, .. }
        | Kind::Pack { of, axis: Axis { count: 1, .. } }
        | Kind::Unpack { of, axis: Axis { count: 1, .. } } => *of,
        Kind::Map { of, axis, count, index, edge } => return map(*of, *axis, *count, *index, *edge),
        _ => return None,
    };
    Some(Rewrite::Same(of))
}

/// A map of all lanes onto themselves is its operand; one whose sources are all out of range is its edge.
fn map(of: ValueId, axis: Axis, count: u32, index: Affine, edge: Option<ValueId>) -> Option<Rewrite> {
    if index == Affine::shift(0) && count == axis.count {
        return Some(Rewrite::Same(of));
    }
    let sees_none =
        |lanes: std::ops::Range<u32>| lanes.into_iter().all(|lane| index.source(lane, axis.count).is_none());
    match edge {
        Some(edge) if sees_none(0..count) => {
            Some(Rewrite::As(Kind::Broadcast { of: edge, axis: Axis { count, ..axis } }))
        }
        _ => None,
    }
}
