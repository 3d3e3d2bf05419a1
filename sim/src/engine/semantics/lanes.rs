//! The result of one lane of an operation across lanes.

use tilewright_circuit::ir::Reduction;
use tilewright_circuit::top_mask;

use super::Number;
use crate::engine::program::{Cell, Kind, Lowered, ValueId};
use crate::limbs;

/// Computes one lane of a cell that is not elementwise into `out`.
pub(super) fn evaluate<'a>(cell: &Cell, lane: u32, out: &mut [u64], at: impl Fn(ValueId, u32) -> Number<'a>) {
    let width = cell.width;
    if let Some((of, from)) = cell.kind.source(lane) {
        return out.copy_from_slice(at(of, from).limbs);
    }
    match &cell.kind {
        Kind::Const(bits) => out.copy_from_slice(bits.limbs()),
        Kind::Pick { of, axis, index } => match at(*index, lane).at_most(axis.count) {
            number if number < axis.count => out.copy_from_slice(at(*of, axis.at(lane, number)).limbs),
            _ => out.fill(0),
        },
        Kind::Reduce { by, of, axis } => {
            out.copy_from_slice(at(*of, axis.at(lane, 0)).limbs);
            (1..axis.count).for_each(|number| combine(*by, width, out, at(*of, axis.at(lane, number)).limbs));
        }
        Kind::Pack { of, axis } => {
            out.fill(0);
            for number in 0..axis.count {
                let part = at(*of, axis.at(lane, number));
                limbs::copy(out, number * part.width, part.limbs, 0, part.width);
            }
        }
        Kind::Unpack { of, axis } => {
            let (number, rest) = axis.split(lane);
            out.fill(0);
            limbs::copy(out, 0, at(*of, rest).limbs, number * width, width);
        }
        Kind::Lowered(Lowered::Gather { of, at: from }) => {
            out.copy_from_slice(at(*of, at(*from, lane).limbs[0] as u32).limbs);
        }
        Kind::Lowered(Lowered::Slide { of, by }) => {
            let from = lane.checked_add_signed(-by).filter(|&from| from < cell.lanes).unwrap_or(lane);
            out.copy_from_slice(at(*of, from).limbs);
        }
        _ => unreachable!("not computed from values: {cell:?}"),
    }
}

/// Combines `out` with another lane.
fn combine(by: Reduction, width: u32, out: &mut [u64], lane: &[u64]) {
    let bitwise = |combine: fn(u64, u64) -> u64, out: &mut [u64]| {
        out.iter_mut().zip(lane).for_each(|(out, lane)| *out = combine(*out, *lane));
    };
    match by {
        Reduction::And => bitwise(|a, b| a & b, out),
        Reduction::Or => bitwise(|a, b| a | b, out),
        Reduction::Xor => bitwise(|a, b| a ^ b, out),
        Reduction::Min if limbs::compare(lane, out).is_lt() => out.copy_from_slice(lane),
        Reduction::Max if limbs::compare(lane, out).is_gt() => out.copy_from_slice(lane),
        Reduction::Min | Reduction::Max => {}
        Reduction::Add => {
            let sum = out.to_vec();
            limbs::add(out, &sum, lane, false);
            *out.last_mut().expect("a value has a limb") &= top_mask(width);
        }
    }
}
