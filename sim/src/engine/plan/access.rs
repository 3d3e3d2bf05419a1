//! How a strip takes lanes that it does not compute: by one load, by a few, or by one for each lane.

use super::clamp::Clamp;
use super::nest::Division;
use crate::engine::function::Function;
use crate::engine::layout::memory_at::MemoryAt;
use crate::engine::layout::strip_sizes::StripSizes;
use crate::engine::program::{Kind, Lowered, ValueId};

/// The lanes of another value that a strip takes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Access {
    /// A scalar, in all lanes.
    Uniform,
    /// Constant lanes, all of them the same.
    Constant(ValueId),
    /// One load: the strip's part of a row that all rows take.
    OfRow(ValueId),
    /// One load: the lanes so many before those of the strip.
    Near(ValueId, i32),
    /// A load for each group of so many lanes, which take the same one.
    Groups(ValueId, u32),
    /// These lanes for the first strip, and those `step` further on for each following one.
    Regular { of: ValueId, lanes: Vec<u32>, step: u32 },
    /// A load for each lane, of the lane with a number.
    Each(ValueId, Number, Clamp),
    /// One load: the words of a memory at the address that all lanes have.
    Words(Word),
    /// A load for each lane, of a word of its own at an address of its own.
    EachWord(Word),
    /// A load for each lane, at the address that all have: the word of the lane with the number in this value.
    WordOf(Word, ValueId, Clamp),
}

/// A memory and an address.
pub(crate) type Word = (u32, ValueId);

/// The number of the lane that a lane takes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Number {
    /// That of its group of so many lanes.
    Group(u32),
    /// Its own within a group of so many lanes.
    Within(u32),
    /// This one of the group with its number, of groups of so many lanes.
    Member { group: u32, index: u32 },
    /// So many before its own.
    Before(i32),
    /// The one in this value's lane.
    Given(ValueId),
}

impl Access {
    /// How these lanes are taken; `None` if the cell is computed from lanes of its own.
    pub fn of(
        function: &Function,
        (memories, strips): (&[MemoryAt], &StripSizes),
        division: Division,
        id: ValueId,
    ) -> Option<Access> {
        let cell = function.cell(id);
        let is_narrow = cell.width <= 64;
        let is_constant = |id: ValueId| matches!(function.cell(id).kind, Kind::Const(_));
        Some(match cell.kind {
            Kind::Broadcast { of, axis } if axis.inner > 1 => {
                let source = function.cell(of);
                match !is_constant(of) && source.lanes == division.row && is_narrow {
                    true => Access::OfRow(of),
                    false => Access::Each(of, Number::Within(source.lanes), Clamp::None),
                }
            }
            Kind::Broadcast { of, .. } if function.cell(of).lanes == 1 => Access::Uniform,
            Kind::Broadcast { of, axis } if division.strip.is_multiple_of(axis.count) => Access::Groups(of, axis.count),
            Kind::Broadcast { of, axis } => Access::Each(of, Number::Group(axis.count), Clamp::None),
            Kind::Lane { of, axis, index } => {
                Access::Each(of, Number::Member { group: axis.count, index }, Clamp::None)
            }
            Kind::Lowered(Lowered::Slide { of, by }) => match is_narrow {
                true if is_constant(of) => Access::Constant(of),
                true if by.unsigned_abs() <= strips.reach(division.lanes) => Access::Near(of, by),
                _ => Access::Each(of, Number::Before(by), Clamp::of_neighbour(by, division.lanes)),
            },
            Kind::Lowered(Lowered::Gather { of, at }) => {
                match regular(function, division, at).filter(|_| !is_constant(of)) {
                    Some((lanes, step)) => Access::Regular { of, lanes, step },
                    None => {
                        let clamp = Clamp::of_numbers(function, at, function.cell(of).lanes);
                        Access::Each(of, Number::Given(at), clamp)
                    }
                }
            }
            Kind::Lowered(Lowered::Word { memory, address }) => {
                let at = &memories[memory as usize];
                let is_one_load = at.words.together() && at.width <= 64;
                if is_one_load { Access::Words((memory, address)) } else { Access::EachWord((memory, address)) }
            }
            Kind::Lowered(Lowered::WordOf { memory, address, at }) => {
                let clamp = Clamp::of_numbers(function, at, memories[memory as usize].lanes);
                Access::WordOf((memory, address), at, clamp)
            }
            _ => return None,
        })
    }
}

/// The numbers of a table for the first strip, and the step from each strip to the next, if it is constant.
fn regular(function: &Function, division: Division, at: ValueId) -> Option<(Vec<u32>, u32)> {
    let Kind::Stack { parts, inner: 1 } = &function.cell(at).kind else { return None };
    let number = |part: &ValueId| Some(function.circuit().constant(*part)?.limbs()[0] as u32);
    let all = parts.iter().map(number).collect::<Option<Vec<u32>>>()?;
    let (first, rest) = all.split_at_checked(division.strip as usize)?;
    let step = rest.first().map_or(Some(0), |next| next.checked_sub(first[0]))?;
    let is_regular = all.iter().zip(rest).all(|(before, after)| before + step == *after);
    let is_whole = parts.len() == division.lanes as usize && !division.is_padded();
    (is_regular && is_whole).then(|| (first.to_vec(), step))
}
