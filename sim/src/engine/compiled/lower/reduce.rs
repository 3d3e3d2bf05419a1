//! Reductions, along the last axis, of lanes that exist.

use tilewright_hdl::Bits;
use tilewright_hdl::ir::Reduction;

use super::super::layout::Strips;
use super::{constant, flags, lanes};
use crate::engine::program::{Axis, Kind, ValueId};
use crate::engine::rewrite::Rewriter;

/// Lowers a reduction to one of a last axis, to which the lanes that pad the last strip add nothing.
pub(super) fn reduce(
    rewriter: &mut Rewriter,
    strips: &Strips,
    by: Reduction,
    of: ValueId,
    axis: Axis,
    lanes: u32,
    width: u32,
) -> ValueId {
    let all = rewriter.circuit()[of].lanes;
    let mut of = match axis.inner {
        1 => of,
        // The axis becomes the last one.
        _ => lanes::gather(rewriter, of, all, width, |lane| axis.at(lane / axis.count, lane % axis.count)),
    };
    if axis.count == all && !all.is_multiple_of(strips.strip(all)) {
        let neutral = match by {
            Reduction::And => Bits::ones(width),
            Reduction::Or | Reduction::Xor | Reduction::Add => Bits::zero(width),
        };
        let select = flags(rewriter, all, all, |_| true);
        let neutral = constant(rewriter, neutral, all);
        of = rewriter.add(Kind::Mux { select, on_true: of, on_false: neutral }, all, width);
    }
    rewriter.add(Kind::Reduce { by, of, axis: Axis::last(axis.count) }, lanes, width)
}
