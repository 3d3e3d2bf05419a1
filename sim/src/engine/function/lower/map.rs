//! Neighbours are loaded from any address, and replaced at the edges of their groups; other maps look up the lane.

use tilewright_circuit::ir::Affine;

use super::{axes, flags};
use crate::engine::program::{Axis, Kind, Lowered, ValueId};
use crate::engine::rewrite::Rewriter;

/// A [`Kind::Map`].
pub(super) struct Map {
    pub of: ValueId,
    pub axis: Axis,
    pub count: u32,
    pub index: Affine,
    pub edge: Option<ValueId>,
}

/// Lowers a map.
pub(super) fn map(rewriter: &mut Rewriter, map: &Map, lanes: u32, width: u32) -> ValueId {
    let Map { of, axis, count, index, edge } = *map;
    let to = Axis { count, ..axis };
    let inside = |lane: u32| index.source(to.split(lane).0, axis.count);
    let anywhere = match (index, count == axis.count) {
        (Affine { mul: 1, add, div: 1 }, true) => {
            let slide = Lowered::Slide { of, by: -add * axis.inner as i32 };
            rewriter.add(Kind::Lowered(slide), lanes, width)
        }
        _ => axes::gather(rewriter, of, lanes, width, |lane| {
            let (number, rest) = to.split(lane);
            axis.at(rest, index.source(number, axis.count).unwrap_or(0))
        }),
    };
    let Some(edge) = edge else { return anywhere };
    let select = flags(rewriter, lanes, to.lanes(), |lane| inside(lane).is_some());
    let on_false = axes::broadcast(rewriter, edge, to, lanes, width);
    rewriter.add(Kind::Mux { select, on_true: anywhere, on_false }, lanes, width)
}
