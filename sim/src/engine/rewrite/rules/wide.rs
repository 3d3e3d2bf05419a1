//! Words wider than a machine register that are assembled and taken apart again.

use super::super::{Rewrite, Rewriter};
use crate::engine::program::{Cell, Kind, ValueId};

/// A lane of an assembled wide word is assembled from lanes, which are no wider than their use.
pub(super) fn lane(rewriter: &mut Rewriter, cell: &Cell) -> Option<Rewrite> {
    let Kind::Lane { of, axis, index } = cell.kind else { return None };
    let parts = wide_parts(rewriter, of)?;
    let lanes = parts.into_iter().map(|part| {
        let width = rewriter.circuit()[part].width;
        rewriter.add(Kind::Lane { of: part, axis, index }, cell.lanes, width)
    });
    Some(Rewrite::As(Kind::Concat(lanes.collect())))
}

/// A slice within a part of a wide word is taken from the part.
pub(super) fn slice(rewriter: &mut Rewriter, cell: &Cell) -> Option<Rewrite> {
    let Kind::Slice(of, low) = cell.kind else { return None };
    let mut begins = 0;
    for part in wide_parts(rewriter, of)?.into_iter().rev() {
        let width = rewriter.circuit()[part].width;
        if (begins..begins + width).contains(&low) {
            let is_within = low + cell.width <= begins + width;
            return is_within.then_some(Rewrite::As(Kind::Slice(part, low - begins)));
        }
        begins += width;
    }
    None
}

/// The parts of a word, the first most significant, if it is wide and assembled.
fn wide_parts(rewriter: &Rewriter, word: ValueId) -> Option<Vec<ValueId>> {
    let cell = &rewriter.circuit()[word];
    match &cell.kind {
        Kind::Concat(parts) if cell.width > 64 => Some(parts.clone()),
        _ => None,
    }
}
