//! Reductions.

use super::super::{Rewrite, Rewriter};
use crate::engine::program::{Axis, Cell, Kind};

/// Reductions along two adjacent axes become one.
pub(super) fn of_reduced(rewriter: &mut Rewriter, cell: &Cell) -> Option<Rewrite> {
    let Kind::Reduce { by, of, axis } = cell.kind else { return None };
    let Kind::Reduce { by: other, of, axis: first } = rewriter.circuit()[of].kind else { return None };
    let inner = match () {
        () if axis.inner == first.inner => first.inner,
        () if axis.lanes() == first.inner => axis.inner,
        () => return None,
    };
    let axis = Axis { count: axis.count * first.count, inner };
    (by == other).then_some(Rewrite::As(Kind::Reduce { by, of, axis }))
}
