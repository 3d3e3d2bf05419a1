//! Replaces operations across lanes by those that a loop over strips can do, and others by machine operations.
//!
//! The remaining operations across lanes are [`Kind::Broadcast`] of each lane or of a whole row, [`Kind::Stack`],
//! [`Kind::Lane`] and [`Kind::Reduce`] along the last axis, and those of [`Lowered`].

mod axes;
mod choices;
mod many;
mod map;
#[cfg(test)]
mod mutants;
mod reduce;

use std::collections::BTreeSet;

use tilewright_circuit::Bits;
use tilewright_circuit::ir::Binary;

use super::{Became, Function, Sink};
use crate::engine::Passes;
use crate::engine::layout::memory_at::MemoryAt;
use crate::engine::layout::strip_sizes::StripSizes;
use crate::engine::program::{Cell, Kind, Lowered, ValueId};
use crate::engine::rewrite::Rewriter;

/// The parameters of lowering.
struct Target<'a> {
    strips: &'a StripSizes,
    memories: &'a [MemoryAt],
    passes: &'a Passes,
    /// Memories that the function writes to.
    written: BTreeSet<u32>,
}

/// Lowers a function. In addition:
///
/// - words of memories are converted from and to their stored form;
/// - the padding lanes of the last strip take no part in reductions and write nothing.
pub(crate) fn lower(
    function: &Function,
    strips: &StripSizes,
    memories: &[MemoryAt],
    passes: &Passes,
) -> (Function, Became) {
    let written = function.sinks.iter().filter_map(|sink| match sink {
        Sink::Write { memory, .. } => Some(*memory),
        _ => None,
    });
    let target = Target { strips, memories, passes, written: written.collect() };
    let (lowered, became) = function.rebuild(Rewriter::new(passes), |rewriter, cell| target.lower(rewriter, cell));
    // Some conditions turn out to be constant only here.
    let Function { mut rewriter, mut sinks } = lowered.happening();
    sinks.iter_mut().for_each(|sink| target.sink(&mut rewriter, sink));
    (Function { rewriter, sinks }, became)
}

impl Target<'_> {
    fn lower(&self, rewriter: &mut Rewriter, cell: Cell) -> ValueId {
        let Cell { lanes, width, .. } = cell;
        let made = match &cell.kind {
            Kind::Read { memory, address } => {
                let word = Kind::Lowered(Lowered::Word { memory: *memory, address: *address });
                let word = rewriter.add(word, lanes, width);
                Some(standing(rewriter, &self.memories[*memory as usize], word))
            }
            Kind::Case { subject, arms, default } if self.passes.lookups => {
                choices::lookup(rewriter, &cell, *subject, arms, *default)
            }
            Kind::Concat(parts) if self.passes.lookups && lanes == 1 => {
                choices::rotation(rewriter.circuit(), parts).map(|rotation| rewriter.add(rotation, lanes, width))
            }
            Kind::Broadcast { of, axis } => Some(axes::broadcast(rewriter, *of, *axis, lanes, width)),
            Kind::Stack { parts, inner } => Some(axes::stack(rewriter, self.strips, parts, *inner, lanes, width)),
            Kind::Interleave { parts, axis } => Some(axes::interleave(rewriter, parts, *axis, lanes, width)),
            Kind::Lane { of, axis, index } => Some(axes::lane(rewriter, *of, *axis, *index, lanes, width)),
            Kind::Pick { of, axis, index } => Some(axes::pick(rewriter, self, *of, *axis, *index, lanes, width)),
            Kind::Pack { of, axis } => Some(axes::pack(rewriter, self.strips, *of, *axis, lanes, width)),
            Kind::Unpack { of, axis } => Some(axes::unpack(rewriter, self.strips, *of, *axis, lanes, width)),
            Kind::Map { of, axis, count, index, edge } => {
                let map = map::Map { of: *of, axis: *axis, count: *count, index: *index, edge: *edge };
                Some(map::map(rewriter, &map, lanes, width))
            }
            Kind::Reduce { by, of, axis } => Some(reduce::reduce(rewriter, self.strips, *by, *of, *axis, lanes, width)),
            _ => None,
        };
        made.unwrap_or_else(|| match many::fewer(rewriter, &cell) {
            Some(kind) => rewriter.add(kind, lanes, width),
            None => rewriter.number(cell),
        })
    }

    /// Selects the lane of a value by the number in each lane of `at`. Of adjacent words at one address, only the
    /// selected ones are read.
    fn gather(&self, rewriter: &mut Rewriter, of: ValueId, at: ValueId, lanes: u32, width: u32) -> ValueId {
        let gather = match rewriter.circuit()[of].kind {
            Kind::Lowered(Lowered::Word { memory, address }) if lanes > 1 && self.is_still(memory) => {
                match rewriter.circuit()[address].kind {
                    Kind::Broadcast { of: address, .. } if rewriter.circuit()[address].lanes == 1 => {
                        Lowered::WordOf { memory, address, at }
                    }
                    _ => Lowered::Gather { of, at },
                }
            }
            _ => Lowered::Gather { of, at },
        };
        rewriter.add(Kind::Lowered(gather), lanes, width)
    }

    /// Whether the words of a memory at an address are adjacent, and do not change while the function runs.
    fn is_still(&self, memory: u32) -> bool {
        let at = &self.memories[memory as usize];
        at.words.together() && at.width <= 64 && !self.written.contains(&memory)
    }

    /// Writes the stored form of a word, in existing lanes only, and computes what is shown.
    fn sink(&self, rewriter: &mut Rewriter, sink: &mut Sink) {
        match sink {
            Sink::Write { memory, enable, data, .. } => {
                let lanes = rewriter.circuit()[*enable].lanes;
                *data = standing(rewriter, &self.memories[*memory as usize], *data);
                if lanes > 1 && !lanes.is_multiple_of(self.strips.strip(lanes)) {
                    let existing = flags(rewriter, lanes, lanes, |_| true);
                    *enable = rewriter.add(Kind::Binary(Binary::And, *enable, existing), lanes, 1);
                }
            }
            Sink::Show(value) if rewriter.circuit().constant(*value).is_some() => *value = rewriter.copy(*value),
            _ => {}
        }
    }
}

/// The stored form of a word, or the word of a stored form: see [`MemoryAt::standing`].
fn standing(rewriter: &mut Rewriter, at: &MemoryAt, word: ValueId) -> ValueId {
    if at.blank == 0 {
        return word;
    }
    let lanes = rewriter.circuit()[word].lanes;
    let blank = rewriter.constant(Bits::new(at.width, at.blank), lanes);
    rewriter.add(Kind::Binary(Binary::Xor, word, blank), lanes, at.width)
}

/// An array of constants: `row` of them, repeated.
fn table(rewriter: &mut Rewriter, lanes: u32, row: u32, width: u32, of: impl Fn(u32) -> u64) -> ValueId {
    let parts = (0..row).map(|lane| rewriter.constant(Bits::new(width, of(lane)), lanes / row)).collect();
    rewriter.add(Kind::Stack { parts, inner: 1 }, lanes, width)
}

/// A flag for each lane.
fn flags(rewriter: &mut Rewriter, lanes: u32, row: u32, of: impl Fn(u32) -> bool) -> ValueId {
    table(rewriter, lanes, row, 1, |lane| u64::from(of(lane)))
}
