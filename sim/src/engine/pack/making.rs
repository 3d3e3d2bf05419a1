//! The way in which the words of a value are made, if its lanes are packed.

use tilewright_circuit::ir::{Affine, Binary};

use crate::engine::program::{Axis, Circuit, Kind, ValueId};

/// The ways to make words.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Making {
    /// The bits of a word are all equal.
    Constant,
    /// Each bit is known.
    Known,
    /// They are state, or the words of a memory.
    Kept,
    /// By logic, from the words of the operands.
    Logic,
    /// By the same operation on words of the operands, along an axis that counts words where it counted lanes.
    Moved,
    /// By selecting among words, for all lanes of a word alike.
    Picked,
    /// Each lane of this value fills this number of words.
    Repeated { of: ValueId, words: u32 },
    /// They are the parts of a wider value.
    Parts,
    /// From shorter words, side by side.
    Joined,
    /// Bits of two words alternate, or each bit of one is doubled.
    Alternating,
    /// The bits of a word are shifted, and those of the next one are shifted in.
    Shifted,
}

/// The most known words: each is an operation.
const MOST_KNOWN: u32 = 1024;

/// The way to make the words of a value, with this number of lanes each; `None` if its lanes are computed one by one
/// and then packed.
pub(super) fn making(circuit: &Circuit, id: ValueId, lanes: u32) -> Option<Making> {
    let cell = &circuit[id];
    if !cell.lanes.is_multiple_of(lanes) {
        return None;
    }
    let is_whole = |axis: Axis| axis.inner.is_multiple_of(lanes);
    match &cell.kind {
        Kind::Const(_) => Some(Making::Constant),
        _ if is_known(circuit, id) && cell.lanes / lanes <= MOST_KNOWN => Some(Making::Known),
        Kind::State => Some(Making::Kept),
        Kind::Read { address, .. } => {
            let is_same = repeated(circuit, *address, lanes).is_some() || circuit.constant(*address).is_some();
            is_same.then_some(Making::Kept)
        }
        Kind::Case { subject, .. } => repeated(circuit, *subject, lanes).map(|_| Making::Logic),
        kind if is_logic(circuit, kind) => Some(Making::Logic),
        Kind::Broadcast { axis, .. } if is_whole(*axis) => Some(Making::Moved),
        Kind::Broadcast { axis, .. } if axis.inner > 1 => (axis.lanes() == lanes).then_some(Making::Joined),
        Kind::Broadcast { .. } => repeated(circuit, id, lanes).map(|(of, words)| Making::Repeated { of, words }),
        Kind::Stack { inner, .. } if inner.is_multiple_of(lanes) => Some(Making::Moved),
        Kind::Stack { parts, inner } => (parts.len() as u32 * inner == lanes).then_some(Making::Joined),
        kind if alternating(kind).is_some_and(|(_, count)| 2 * count == lanes || count.is_multiple_of(lanes)) => {
            Some(Making::Alternating)
        }
        kind if shifted(kind).is_some_and(|it| it.count.is_multiple_of(lanes) && it.by.unsigned_abs() < lanes) => {
            Some(Making::Shifted)
        }
        Kind::Map { axis, .. }
        | Kind::Interleave { axis, .. }
        | Kind::Lane { axis, .. }
        | Kind::Reduce { axis, .. } => is_whole(*axis).then_some(Making::Moved),
        Kind::Pick { axis, index, .. } if is_whole(*axis) => {
            let is_same = repeated(circuit, *index, lanes).is_some() || circuit.constant(*index).is_some();
            is_same.then_some(Making::Picked)
        }
        Kind::Unpack { axis: Axis { count, inner: 1 }, .. } => count.is_multiple_of(lanes).then_some(Making::Parts),
        _ => None,
    }
}

/// Whether each bit of the result depends on the same bit of 1-bit operands.
fn is_logic(circuit: &Circuit, kind: &Kind) -> bool {
    match kind {
        Kind::Alias(_) | Kind::Mux { .. } | Kind::Select { .. } => true,
        Kind::Unary(_, of) => circuit[*of].width == 1,
        Kind::Binary(op, ..) => !matches!(op, Binary::Mul | Binary::MulSigned),
        Kind::Compare(_, _, a, _) => circuit[*a].width == 1,
        _ => false,
    }
}

/// Whether lanes of one bit are stacked constants.
fn is_known(circuit: &Circuit, id: ValueId) -> bool {
    match &circuit[id].kind {
        Kind::Const(_) => true,
        Kind::Unpack { of, axis: Axis { inner: 1, .. } } => circuit.constant(*of).is_some(),
        Kind::Stack { parts, inner: 1 } => parts.iter().all(|part| circuit.constant(*part).is_some()),
        Kind::Broadcast { of, .. } => is_known(circuit, *of),
        _ => false,
    }
}

/// The bit of a lane for which [`is_known`] is true.
pub(super) fn known(circuit: &Circuit, id: ValueId, lane: u32) -> bool {
    match &circuit[id].kind {
        Kind::Const(bits) => bits.bit(0),
        Kind::Unpack { of, axis } => circuit.constant(*of).expect("it is known").bit(lane % axis.count),
        Kind::Stack { parts, .. } => known(circuit, parts[lane as usize % parts.len()], 0),
        Kind::Broadcast { of, axis } => known(circuit, *of, axis.split(lane).1),
        _ => unreachable!("it is known"),
    }
}

/// For lanes that alternate between two values along the last axis, which may be equal: the values, and their lanes
/// along it.
pub(super) fn alternating(kind: &Kind) -> Option<([ValueId; 2], u32)> {
    match kind {
        Kind::Interleave { parts, axis: Axis { count, inner: 1 } } => match parts[..] {
            [even, odd] => Some(([even, odd], *count)),
            _ => None,
        },
        &Kind::Map {
            of,
            axis: Axis { count, inner: 1 },
            count: lanes,
            index: Affine { mul: 1, add: 0, div: 2 },
            ..
        } => (lanes == 2 * count).then_some(([of, of], count)),
        _ => None,
    }
}

/// Lanes that are shifted along the last axis.
#[derive(Debug, Clone, Copy)]
pub(super) struct Shifted {
    pub of: ValueId,
    /// The lanes of the axis.
    pub count: u32,
    /// Lane `i` is lane `i + by`.
    pub by: i32,
    /// The value where there is no such lane, without the axis.
    pub edge: ValueId,
}

/// The shift of an operation along the last axis, if it moves all lanes by one distance.
pub(super) fn shifted(kind: &Kind) -> Option<Shifted> {
    match *kind {
        Kind::Map {
            of,
            axis: Axis { count, inner: 1 },
            count: lanes,
            index: Affine { mul: 1, add: by, div: 1 },
            edge: Some(edge),
        } => (lanes == count && by != 0).then_some(Shifted { of, count, by, edge }),
        _ => None,
    }
}

/// The value that all lanes of a word equal, and the number of words for each of its lanes.
pub(super) fn repeated(circuit: &Circuit, id: ValueId, lanes: u32) -> Option<(ValueId, u32)> {
    match circuit[id].kind {
        Kind::Broadcast { of, axis: Axis { count, inner: 1 } } if count.is_multiple_of(lanes) => {
            Some((of, count / lanes))
        }
        _ => None,
    }
}
