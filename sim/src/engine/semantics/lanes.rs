//! The result of one lane of an operation across lanes.

use tilewright_circuit::limbs;

use super::Number;
use crate::engine::program::{Cell, Kind, Lowered, ValueId};

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
            (1..axis.count).for_each(|number| by.combine(width, out, at(*of, axis.at(lane, number)).limbs));
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
