//! Lanes, or all bits, of values assembled from others.

use super::super::{Rewrite, Rewriter};
use crate::engine::program::{Cell, Kind};

/// A lane of a stack is its part, a lane of a broadcast is its operand, a lane of a map is a lane of its operand, and
/// an unpacked lane is a slice.
pub(super) fn lane(rewriter: &mut Rewriter, cell: &Cell) -> Option<Rewrite> {
    let Kind::Lane { of, axis, index } = cell.kind else { return None };
    match &rewriter.circuit()[of].kind {
        Kind::Broadcast { of, axis: put } if *put == axis => Some(Rewrite::Same(*of)),
        Kind::Unpack { of, axis: put } if *put == axis => Some(Rewrite::As(Kind::Slice(*of, index * cell.width))),
        Kind::Stack { parts, inner } if *inner == axis.inner && parts.len() == axis.count as usize => {
            Some(Rewrite::Same(parts[index as usize]))
        }
        Kind::Map { of, axis: from, count, index: map, edge } if from.inner == axis.inner && *count == axis.count => {
            match (map.source(index, from.count), edge) {
                (Some(index), _) => Some(Rewrite::As(Kind::Lane { of: *of, axis: *from, index })),
                (None, edge) => edge.map(Rewrite::Same),
            }
        }
        Kind::Interleave { parts, axis: each }
            if each.inner == axis.inner && each.count * parts.len() as u32 == axis.count =>
        {
            let (of, k) = (parts[index as usize % parts.len()], parts.len() as u32);
            Some(Rewrite::As(Kind::Lane { of, axis: *each, index: index / k }))
        }
        _ => None,
    }
}

/// Packing undoes unpacking, and the converse; packed lanes of a stack are a concatenation of its parts.
pub(super) fn packed(rewriter: &mut Rewriter, cell: &Cell) -> Option<Rewrite> {
    let circuit = rewriter.circuit();
    match cell.kind {
        Kind::Pack { of, axis } => match &circuit[of].kind {
            Kind::Unpack { of, axis: put } if *put == axis => Some(Rewrite::Same(*of)),
            Kind::Stack { parts, inner } if *inner == axis.inner && parts.len() == axis.count as usize => {
                Some(Rewrite::As(Kind::Concat(parts.iter().rev().copied().collect())))
            }
            _ => None,
        },
        Kind::Unpack { of, axis } => match circuit[of].kind {
            Kind::Pack { of, axis: put } if put == axis => Some(Rewrite::Same(of)),
            _ => None,
        },
        _ => None,
    }
}
