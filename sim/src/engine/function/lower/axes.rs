//! Axes that code does not support: a table has the number of each lane's source.

use std::ops::RangeInclusive;

use tilewright_circuit::Bits;
use tilewright_circuit::ir::{Binary, Reduction, Relation};

use super::{Target, flags, reduce, table};
use crate::engine::layout::storage;
use crate::engine::layout::strip_sizes::StripSizes;
use crate::engine::program::{Axis, Kind, Lowered, ValueId};
use crate::engine::rewrite::Rewriter;

/// Bits of a lane's number.
const NUMBER: u32 = 32;

/// Each lane takes the lane of `of` given by `from`.
pub(super) fn gather(
    rewriter: &mut Rewriter,
    of: ValueId,
    lanes: u32,
    width: u32,
    from: impl Fn(u32) -> u32,
) -> ValueId {
    // A scalar is looked up nowhere: it need not be in memory.
    if rewriter.circuit()[of].lanes == 1 {
        return rewriter.add(Kind::Broadcast { of, axis: Axis::last(lanes) }, lanes, width);
    }
    let at = table(rewriter, lanes, lanes, NUMBER, |lane| u64::from(from(lane)));
    rewriter.add(Kind::Lowered(Lowered::Gather { of, at }), lanes, width)
}

/// A repeated lane, a repeated row, or a repetition between two axes.
pub(super) fn broadcast(rewriter: &mut Rewriter, of: ValueId, axis: Axis, lanes: u32, width: u32) -> ValueId {
    match axis.inner == 1 || axis.lanes() == lanes {
        true => rewriter.add(Kind::Broadcast { of, axis }, lanes, width),
        false => gather(rewriter, of, lanes, width, |lane| axis.split(lane).1),
    }
}

/// From this number of rows on, code copies them one after another instead of selecting one in each lane.
const COPIED: usize = 4;

/// Lanes stacked along an axis that is not the last.
pub(super) fn stack(
    rewriter: &mut Rewriter,
    strips: &StripSizes,
    parts: &[ValueId],
    inner: u32,
    lanes: u32,
    width: u32,
) -> ValueId {
    let element = storage(strips, lanes, width);
    let are_rows = parts.len() as u32 * inner == lanes && parts.len() >= COPIED;
    let are_vectors = (inner * element).is_multiple_of(strips.vector()) && element == storage(strips, inner, width);
    let are_known = parts.iter().all(|part| rewriter.circuit().constant(*part).is_some());
    if inner == 1 || (are_rows && are_vectors && !are_known) {
        return rewriter.add(Kind::Stack { parts: parts.to_vec(), inner }, lanes, width);
    }
    let axis = Axis { count: parts.len() as u32, inner };
    let spread = |rewriter: &mut Rewriter, part| broadcast(rewriter, part, axis, lanes, width);
    choose(rewriter, parts, lanes, width, spread, |lane| axis.split(lane).0)
}

/// The lanes of the parts, alternating.
pub(super) fn interleave(rewriter: &mut Rewriter, parts: &[ValueId], axis: Axis, lanes: u32, width: u32) -> ValueId {
    let k = parts.len() as u32;
    let to = Axis { count: axis.count * k, ..axis };
    let spread = |rewriter: &mut Rewriter, part| {
        gather(rewriter, part, lanes, width, |lane| {
            let (number, rest) = to.split(lane);
            axis.at(rest, number / k)
        })
    };
    choose(rewriter, parts, lanes, width, spread, |lane| to.split(lane).0 % k)
}

/// Each lane takes that lane of the part with its number; the parts are spread over all lanes.
fn choose(
    rewriter: &mut Rewriter,
    parts: &[ValueId],
    lanes: u32,
    width: u32,
    spread: impl Fn(&mut Rewriter, ValueId) -> ValueId,
    number: impl Fn(u32) -> u32,
) -> ValueId {
    let (first, rest) = parts.split_first().expect("something is put together");
    let mut all = spread(rewriter, *first);
    for (index, part) in (1..).zip(rest) {
        let on_true = spread(rewriter, *part);
        let select = flags(rewriter, lanes, lanes, |lane| number(lane) == index);
        all = rewriter.add(Kind::Mux { select, on_true, on_false: all }, lanes, width);
    }
    all
}

/// One lane along an axis.
pub(super) fn lane(rewriter: &mut Rewriter, of: ValueId, axis: Axis, index: u32, lanes: u32, width: u32) -> ValueId {
    match axis.inner {
        1 => rewriter.add(Kind::Lane { of, axis, index }, lanes, width),
        _ => gather(rewriter, of, lanes, width, |lane| axis.at(lane, index)),
    }
}

/// The lane along an axis with a given number, if it exists.
pub(super) fn pick(
    rewriter: &mut Rewriter,
    target: &Target,
    of: ValueId,
    axis: Axis,
    index: ValueId,
    lanes: u32,
    width: u32,
) -> ValueId {
    let bits = rewriter.circuit()[index].width;
    let [zero, nothing] = [bits, width].map(|width| rewriter.constant(Bits::zero(width), lanes));
    let inside = rewriter.below(index, axis.count);
    if axis.count == 1 {
        return rewriter.add(Kind::Mux { select: inside, on_true: of, on_false: nothing }, lanes, width);
    }
    let number = rewriter.add(Kind::Mux { select: inside, on_true: index, on_false: zero }, lanes, bits);
    let number = match bits {
        _ if bits < NUMBER => rewriter.add(Kind::Extend(number, false), lanes, NUMBER),
        NUMBER => number,
        _ => rewriter.add(Kind::Slice(number, 0), lanes, NUMBER),
    };
    let along = match axis.inner {
        1 => number,
        inner => {
            let apart = rewriter.constant(Bits::new(NUMBER, inner.into()), lanes);
            let product = rewriter.add(Kind::Binary(Binary::Mul, number, apart), lanes, 2 * NUMBER);
            rewriter.add(Kind::Slice(product, 0), lanes, NUMBER)
        }
    };
    let first = table(rewriter, lanes, lanes, NUMBER, |lane| u64::from(axis.at(lane, 0)));
    let at = rewriter.add(Kind::Binary(Binary::Add, along, first), lanes, NUMBER);
    let picked = target.gather(rewriter, of, at, lanes, width);
    rewriter.add(Kind::Mux { select: inside, on_true: picked, on_false: nothing }, lanes, width)
}

/// Lanes side by side in one value.
pub(super) fn pack(
    rewriter: &mut Rewriter,
    strips: &StripSizes,
    of: ValueId,
    axis: Axis,
    lanes: u32,
    width: u32,
) -> ValueId {
    let part = width / axis.count;
    let is_known = rewriter.circuit().constant(of).is_some();
    if lanes == 1 && are_limbs(strips, axis, part) && !is_known {
        return rewriter.add(Kind::Pack { of, axis }, lanes, width);
    }
    if part == 1 && lanes == 1 && TOGETHER.contains(&width) {
        // Each lane has one bit of its own, and no other.
        let wide = rewriter.add(Kind::Extend(of, true), width, width);
        let own = own_bits(rewriter, width, axis, width);
        let bits = rewriter.add(Kind::Binary(Binary::And, wide, own), width, width);
        return reduce::reduce(rewriter, strips, Reduction::Or, bits, axis, 1, width);
    }
    let one = |index| lane(rewriter, of, axis, index, lanes, part);
    let parts: Vec<ValueId> = (0..axis.count).rev().map(one).collect();
    rewriter.add(Kind::Concat(parts), lanes, width)
}

/// Parts of a value in lanes.
pub(super) fn unpack(
    rewriter: &mut Rewriter,
    strips: &StripSizes,
    of: ValueId,
    axis: Axis,
    lanes: u32,
    width: u32,
) -> ValueId {
    let whole = rewriter.circuit()[of].width;
    if lanes == axis.count && are_limbs(strips, axis, width) {
        return rewriter.add(Kind::Unpack { of, axis }, lanes, width);
    }
    if width == 1 && axis.inner == 1 && TOGETHER.contains(&whole) {
        // Each lane reads a bit of its own.
        let word = broadcast(rewriter, of, axis, lanes, whole);
        let own = own_bits(rewriter, lanes, axis, whole);
        let bit = rewriter.add(Kind::Binary(Binary::And, word, own), lanes, whole);
        return rewriter.add(Kind::Compare(Relation::Eq, false, bit, own), lanes, 1);
    }
    let mut part = |index: u32| rewriter.add(Kind::Slice(of, index * width), lanes / axis.count, width);
    let parts: Vec<ValueId> = (0..axis.count).map(&mut part).collect();
    stack(rewriter, strips, &parts, axis.inner, lanes, width)
}

/// Whether all lanes along an axis, with this many bits each, have the layout of the limbs of the value that they are
/// parts of.
fn are_limbs(strips: &StripSizes, axis: Axis, width: u32) -> bool {
    let Axis { count, inner } = axis;
    inner == 1 && count > 1 && storage(strips, count, width) == width && (count * width).is_multiple_of(64)
}

/// The width of a word if each lane takes, or gives, one of its bits.
const TOGETHER: RangeInclusive<u32> = 8..=64;

/// In each lane along the last axis, the bit with the lane's number.
fn own_bits(rewriter: &mut Rewriter, lanes: u32, axis: Axis, width: u32) -> ValueId {
    let row = table(rewriter, axis.count, axis.count, width, |lane| 1 << lane);
    match lanes / axis.count {
        1 => row,
        rows => rewriter.add(Kind::Broadcast { of: row, axis: Axis { count: rows, inner: axis.count } }, lanes, width),
    }
}
