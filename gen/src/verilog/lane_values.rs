//! Constants that differ from lane to lane: a formula of the lane's number if they follow one, otherwise a table.

use super::constant;
use super::fold::lower::WIDEST_VECTOR;
use super::pattern::Pattern;
use std::collections::BTreeMap;
use tilewright_circuit::Bits;
use tilewright_circuit::ir::{Module, NodeId, Op, Shape, Shift};

/// The longest chain of operators through which a lane is computed: a tree of choices between thousands of lanes has no
/// longer one.
const DEEPEST: u32 = 32;

/// The lanes of nodes that have been computed, with their values, if they are known.
type Found = BTreeMap<(NodeId, u32), Option<Bits>>;

/// The form of the constants of the lanes.
pub enum LaneConstants {
    /// By a formula of the index along that axis.
    Along(u32, Pattern),
    /// By a formula of the lane's number, in row-major order.
    Lane(Pattern),
    /// As a table, in row-major order.
    Table(Vec<Bits>),
}

/// The constants of a list, and of lists in it; `None` if it contains anything else, or too much for a table.
pub fn lane_constants(module: &Module, id: NodeId) -> Option<LaneConstants> {
    let shape = module.shape(id);
    let values = values(module, id)?;
    if let Some(pattern) = along(shape, &values) {
        return Some(pattern);
    }
    let bits = values.len() as u64 * u64::from(module.width(id));
    match Pattern::of(&values) {
        Some(pattern) => Some(LaneConstants::Lane(pattern)),
        None => (bits <= WIDEST_VECTOR).then_some(LaneConstants::Table(values)),
    }
}

/// A formula of the row or of the column only.
fn along(shape: Shape, values: &[Bits]) -> Option<LaneConstants> {
    let Shape::Grid(rows, columns) = shape else {
        return Pattern::of(values).map(|pattern| LaneConstants::Along(0, pattern));
    };
    let (rows, columns) = (rows as usize, columns as usize);
    let by_row: Vec<Bits> = values.iter().step_by(columns).cloned().collect();
    if (0..values.len()).all(|lane| values[lane] == by_row[lane / columns]) {
        return Pattern::of(&by_row).map(|pattern| LaneConstants::Along(0, pattern));
    }
    let by_column = &values[..columns];
    let is_by_column = rows > 0 && (0..values.len()).all(|lane| values[lane] == by_column[lane % columns]);
    is_by_column.then(|| Pattern::of(by_column).map(|pattern| LaneConstants::Along(1, pattern)))?
}

/// The value of every lane, also through names and through lanes taken from other lanes.
pub fn values(module: &Module, id: NodeId) -> Option<Vec<Bits>> {
    let constant = |(id, _): (NodeId, u32)| match &module.node(id).op {
        Op::Const(value) => Some(value.clone()),
        _ => None,
    };
    (0..module.shape(id).lanes()).map(|lane| source(module, id, lane).and_then(constant)).collect()
}

/// The value of one lane, also if operators compute it from constants.
pub fn known(module: &Module, id: NodeId, lane: u32) -> Option<Bits> {
    computed(module, id, lane, DEEPEST, &mut Found::new())
}

/// The value of one lane, computed from constants through at most `depth` nested operators.
fn computed(module: &Module, id: NodeId, lane: u32, depth: u32, found: &mut Found) -> Option<Bits> {
    let (id, lane) = source(module, id, lane)?;
    if let Op::Const(value) = &module.node(id).op {
        return Some(value.clone());
    }
    if let Some(value) = found.get(&(id, lane)) {
        return value.clone();
    }
    let value = operation(module, id, lane, depth.checked_sub(1)?, found);
    found.insert((id, lane), value.clone());
    value
}

/// The value of one lane of an operator.
fn operation(module: &Module, id: NodeId, lane: u32, depth: u32, found: &mut Found) -> Option<Bits> {
    let node = module.node(id);
    let mut of = |id: NodeId| computed(module, id, lane, depth, found);
    if let Op::Mux { select, on_true, on_false } = node.op {
        return if of(select)?.is_zero() { of(on_false) } else { of(on_true) };
    }
    if let Op::Shift(Shift::Left | Shift::Right, shifted, amount) = node.op {
        // Beyond the width whatever is shifted.
        let amount = of(amount)?;
        let is_beyond = amount.to_u64().is_none_or(|places| places >= u64::from(module.width(shifted)));
        return is_beyond.then(|| Bits::zero(node.width));
    }
    let operands = constant::operands(&node.op)?;
    let operands: Vec<Bits> = operands.into_iter().map(of).collect::<Option<_>>()?;
    constant::of(&node.op, node.width, &operands.iter().collect::<Vec<_>>())
}

/// The node and lane from which a lane has its value, through all operators that only pass it on. It visits one lane
/// of one node at a time, so it ends even with chains of lanes.
fn source(module: &Module, mut id: NodeId, mut lane: u32) -> Option<(NodeId, u32)> {
    loop {
        let shape = module.shape(id);
        let place = |axis: u32| (shape.along(axis, lane), shape.across(axis, lane));
        (id, lane) = match &module.node(id).op {
            Op::Wire(of) | Op::QuasiStatic(of, _) => (*of, lane),
            Op::Broadcast { of, axis } => (*of, shape.across(*axis, lane)),
            Op::Lane { of, axis, index } => (*of, module.shape(*of).lane(*axis, *index, lane)),
            Op::Stack { parts, axis } => {
                let (along, across) = place(*axis);
                (parts[along as usize], across)
            }
            Op::Interleave { parts, axis } => {
                let (along, across) = place(*axis);
                let (count, part) = (parts.len() as u32, parts[along as usize % parts.len()]);
                (part, module.shape(part).lane(*axis, along / count, across))
            }
            Op::Map { of, axis, index, edge } => {
                let ((along, across), from) = (place(*axis), module.shape(*of));
                match index.source(along, from.extent(*axis)) {
                    Some(along) => (*of, from.lane(*axis, along, across)),
                    None => ((*edge)?, across),
                }
            }
            _ => return Some((id, lane)),
        };
    }
}
