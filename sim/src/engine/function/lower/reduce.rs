//! Reductions, along the last axis, of existing lanes.

use tilewright_circuit::Bits;
use tilewright_circuit::ir::{Reduction, Relation};

use super::{axes, flags};
use crate::engine::layout::strip_sizes::StripSizes;
use crate::engine::program::{Axis, Kind, ValueId};
use crate::engine::rewrite::Rewriter;

/// Lowers a reduction to one along the last axis, to which the padding lanes of the last strip add nothing.
pub(super) fn reduce(
    rewriter: &mut Rewriter,
    strips: &StripSizes,
    by: Reduction,
    of: ValueId,
    axis: Axis,
    lanes: u32,
    width: u32,
) -> ValueId {
    if matches!(by, Reduction::Min | Reduction::Max) {
        return least(rewriter, by, of, axis, lanes, width);
    }
    let all = rewriter.circuit()[of].lanes;
    let mut of = match axis.inner {
        1 => of,
        // The axis becomes the last one.
        _ => axes::gather(rewriter, of, all, width, |lane| axis.at(lane / axis.count, lane % axis.count)),
    };
    if axis.count == all && !all.is_multiple_of(strips.strip(all)) {
        let neutral = match by {
            Reduction::And => Bits::ones(width),
            _ => Bits::zero(width),
        };
        let select = flags(rewriter, all, all, |_| true);
        let neutral = rewriter.constant(neutral, all);
        of = rewriter.add(Kind::Mux { select, on_true: of, on_false: neutral }, all, width);
    }
    rewriter.add(Kind::Reduce { by, of, axis: Axis::last(axis.count) }, lanes, width)
}

/// The smallest or largest lane along an axis, two at a time.
fn least(rewriter: &mut Rewriter, by: Reduction, of: ValueId, axis: Axis, lanes: u32, width: u32) -> ValueId {
    let relation = if by == Reduction::Min { Relation::Lt } else { Relation::Gt };
    let (mut of, mut count) = (of, axis.count);
    while count > 1 {
        let (half, before) = (count.div_ceil(2), Axis { count, ..axis });
        let after = Axis { count: half, ..axis };
        let mut side = |second: u32| {
            axes::gather(rewriter, of, lanes * half, width, |lane| {
                let (number, rest) = after.split(lane);
                before.at(rest, (2 * number + second).min(count - 1))
            })
        };
        let [on_true, on_false] = [side(0), side(1)];
        let select = rewriter.add(Kind::Compare(relation, false, on_true, on_false), lanes * half, 1);
        of = rewriter.add(Kind::Mux { select, on_true, on_false }, lanes * half, width);
        count = half;
    }
    of
}
