//! Makes a graph smaller where some of its values have become known.

use std::collections::HashMap;

use super::graph::{Graph, Sink};
use crate::engine::program::rules::{alias, fold, shorter};
use crate::engine::program::{Kind, ValueId};

/// Computes constants, takes names for one value as one, computes what is equal once, and drops what does nothing.
pub(super) fn simplify(graph: &mut Graph) {
    let mut same: Vec<ValueId> = (0..graph.cells.len() as u32).map(ValueId).collect();
    let mut known: HashMap<(Kind, u32, u32), ValueId> = HashMap::new();
    for id in graph.needed() {
        let mut cell = graph.cell(id).clone();
        cell.kind.rewrite(|operand| *operand = same[operand.index()]);
        cell.kind = shorter(graph, &cell.kind).unwrap_or(cell.kind);
        cell.kind = fold(graph, &cell.kind, cell.width).map_or(cell.kind, Kind::Const);
        same[id.index()] = match alias(graph, &cell.kind, cell.width) {
            Some(of) => of,
            None if cell.kind == Kind::State => id,
            None => *known.entry((cell.kind.clone(), cell.lanes, cell.width)).or_insert(id),
        };
        graph.cells[id.index()] = cell;
    }
    graph.sinks.iter_mut().for_each(|sink| sink.rewrite(|operand| *operand = same[operand.index()]));
    graph.sinks = std::mem::take(&mut graph.sinks).into_iter().filter_map(|sink| happening(graph, sink)).collect();
}

/// A sink, unless nothing ever happens there.
pub(super) fn happening(graph: &Graph, sink: Sink) -> Option<Sink> {
    let known = |id: ValueId| match &graph.cell(id).kind {
        Kind::Const(bits) => Some(!bits.is_zero()),
        _ => None,
    };
    match sink {
        Sink::Write { enable, .. } if known(enable) == Some(false) => None,
        Sink::Register { state, next, .. } if next == state => None,
        Sink::Register { state, next, enable: Some(enable) } => match known(enable) {
            Some(true) => Some(Sink::Register { state, next, enable: None }),
            Some(false) => None,
            None => Some(sink),
        },
        _ => Some(sink),
    }
}
