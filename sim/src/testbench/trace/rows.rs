//! Many steps of a waveform at once: an engine stores the values before each edge in rows, and the differences
//! between successive rows are the changes in the file.

use std::cell::Cell;

use super::View;
use super::dump::change;
use super::shown::Shown;
use super::sink::{BLOCK, Sink};
use super::vcd_header::{Header, Variable, VariableKind};
use crate::engine::program::Program;
use crate::engine::{Done, LINE};

/// The layout of rows, which have the limbs of one variable after another.
pub(super) struct Rows<S: Sink> {
    /// The engine's index for them.
    index: usize,
    /// The number of limbs of a row.
    length: usize,
    blocks: Vec<Block<S::Short>>,
    /// For each variable its first limb, and the end of the last one.
    starts: Vec<usize>,
    /// The last row.
    last: Vec<[u64; BLOCK]>,
    /// For each block, a bit for each limb that differs from the previous row.
    changed: Vec<u64>,
    /// Whether the last step came from a row.
    are_ahead: bool,
}

/// The format of some limbs of a row.
struct Block<Short> {
    /// For limbs that are variables of their own.
    shorts: [Short; BLOCK],
    /// The exceptions, one bit each: their variables have more than 32 bits or are strings.
    others: u64,
    variables: [usize; BLOCK],
}

impl<S: Sink> Rows<S> {
    /// The rows with this engine index.
    pub fn new(index: usize, program: &Program, shown: &Shown, variables: &[Variable]) -> Rows<S> {
        let (mut blocks, mut starts, mut end) = (Vec::new(), vec![0], 0);
        for ((number, variable), limbs) in variables.iter().enumerate().zip(shown.limbs_of_variables()) {
            let short = S::short(variable);
            let is_other = program.value(variable.value).width > 32 || matches!(variable.kind, VariableKind::Code(_));
            for limb in end..end + limbs {
                if limb % BLOCK == 0 {
                    blocks.push(Block { shorts: [short; BLOCK], others: 0, variables: [0; BLOCK] });
                }
                let Block { shorts, others, variables } = &mut blocks[limb / BLOCK];
                (shorts[limb % BLOCK], variables[limb % BLOCK]) = (short, number);
                *others |= u64::from(is_other) << (limb % BLOCK);
            }
            end += limbs;
            starts.push(end);
        }
        let (last, changed) = (vec![[0; BLOCK]; blocks.len()], vec![0; blocks.len()]);
        Rows { index, length: end.next_multiple_of(LINE), blocks, starts, last, changed, are_ahead: false }
    }

    /// Hands the last row over to step-by-step sampling.
    pub fn leave(&mut self, shown: &mut Shown) {
        if std::mem::take(&mut self.are_ahead) {
            shown.take_row(self.last.as_flattened());
        }
    }

    /// Takes up to `count` steps of the only clock and writes them; each begins with an edge.
    pub fn take(&mut self, view: &mut View, count: u64, shown: &Shown, header: &Header, to: &mut S) -> Done {
        let none = Done { edges: 0, changed: view.changed };
        if count == 0 {
            return none;
        }
        let Some((done, rows)) = view.engine.edges_in_rows(self.index, view.rising, count) else { return none };
        if !std::mem::replace(&mut self.are_ahead, true) {
            self.last.as_flattened_mut().iter_mut().zip(shown.row()).for_each(|(last, limb)| *last = limb);
        }
        let clock = &header.clocks[0];
        let back = clock.back(view.until).map(|back| back - view.until);
        let mut time = view.since;
        for row in rows.chunks_exact(self.length) {
            self.row(row, time, header, to);
            if let Some(back) = back {
                if let Some(id) = clock.id {
                    to.at(time);
                    to.bit(id, clock.level(true));
                }
                to.at(time + back);
                clock.id.into_iter().for_each(|id| to.bit(id, clock.level(false)));
            }
            time += view.until - view.since;
        }
        done
    }

    /// Writes the values that differ from the previous row.
    fn row(&mut self, row: &[Cell<u64>], time: u64, header: &Header, to: &mut S) {
        let Rows { blocks, starts, last, changed, .. } = self;
        for ((row, last), changed) in row.chunks(BLOCK).zip(&mut *last).zip(&mut *changed) {
            *changed = replace(row, last);
        }
        let mut written = None;
        for ((block, limbs), &changed) in blocks.iter().zip(&*last).zip(&*changed) {
            if changed == 0 {
                continue;
            }
            to.at(time);
            let mut rest = changed;
            while rest & block.others != 0 {
                let place = (rest & block.others).trailing_zeros();
                to.shorts(rest & ((1 << place) - 1), &block.shorts, limbs);
                rest &= (u64::MAX - 1) << place;
                let variable = block.variables[place as usize];
                // A variable of several limbs is written with the first of them that differs.
                if written.replace(variable) != Some(variable) {
                    let limbs = &last.as_flattened()[starts[variable]..starts[variable + 1]];
                    let Variable { id, kind, .. } = &header.variables[variable];
                    change(to, *id, kind, limbs);
                }
            }
            to.shorts(rest, &block.shorts, limbs);
        }
    }
}

/// Replaces numbers, a multiple of [`LINE`]; returns a bit for each that differed.
#[inline]
fn replace(new: &[Cell<u64>], old: &mut [u64; BLOCK]) -> u64 {
    let mut all = 0;
    for ((new, old), line) in new.as_chunks::<LINE>().0.iter().zip(old.as_chunks_mut::<LINE>().0).zip(0..) {
        // Whether a number differs is hard to predict, so there is no branch.
        let changed = (0..LINE).fold(0, |changed, place| changed | u64::from(new[place].get() != old[place]) << place);
        *old = std::array::from_fn(|place| new[place].get());
        all |= changed << (LINE * line);
    }
    all
}
