//! How the number of a lane, which a run finds, is kept among the lanes that exist.
//!
//! Code that takes lanes by number tests nothing else. With the padding of the layout, these clamps keep it within its
//! memory; the bounds of the strip program show that they do.

use super::nest::Division;
use crate::engine::function::Function;
use crate::engine::program::ValueId;
use tilewright_circuit::top_mask;

/// What takes the place of a number that no lane has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Clamp {
    /// There is no such number.
    None,
    /// The number of this lane, which is the last.
    Last(u32),
    /// The number of the lane that asks. A number before the first counts as one beyond the last.
    Own,
}

impl Clamp {
    /// For the numbers in a value, of so many lanes. Those in a table are known to exist. Of others only the width can
    /// show it.
    pub fn of_numbers(function: &Function, at: ValueId, lanes: u32) -> Clamp {
        let all_exist = function.is_table(at) || top_mask(function.cell(at).width) < u64::from(lanes);
        if all_exist { Clamp::None } else { Clamp::Last(lanes - 1) }
    }

    /// For the number of a lane so many before another one. The lane in its place has not changed yet.
    pub fn of_neighbour(by: i32, lanes: u32) -> Clamp {
        if by > 0 { Clamp::Own } else { Clamp::Last(lanes - 1) }
    }

    /// For the lanes of a strip: behind the last one there may be padding.
    pub fn of_strip(division: Division) -> Clamp {
        if division.is_padded() { Clamp::Last(division.lanes - 1) } else { Clamp::None }
    }

    /// For the groups of a strip's lanes: those of padding are placed behind the last one.
    pub fn of_group(division: Division, groups: u32) -> Clamp {
        if division.is_padded() { Clamp::Last(groups) } else { Clamp::None }
    }
}
