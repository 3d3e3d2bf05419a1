//! The loops of a kernel, over rows and strips of its lanes: what stands before each loop, what it carries, and the
//! sequence within a strip.
//!
//! The lanes of a kernel may form *rows*, the groups of an array of arrays. Then one loop goes over the rows, and one
//! within it over the strips of a row, so that values common to a row are loaded once.

use std::collections::{BTreeMap, BTreeSet};

use super::access::{Access, Word};
use super::{Kernel, Plan};
use crate::engine::function::{Function, Sink};
use crate::engine::layout::memory_at::MemoryAt;
use crate::engine::layout::strip_sizes::StripSizes;
use crate::engine::program::{Axis, Kind, Lowered, ValueId};

/// How loops divide lanes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Division {
    /// All lanes.
    pub lanes: u32,
    /// Lanes of a row.
    pub row: u32,
    /// Lanes at a time.
    pub strip: u32,
}

impl Division {
    /// The number of rows.
    pub fn rows(self) -> u32 {
        self.lanes / self.row
    }

    /// Whether the last strip has padding lanes.
    pub fn is_padded(self) -> bool {
        !self.row.is_multiple_of(self.strip)
    }
}

/// The loops of a kernel without branches.
#[derive(Debug)]
pub(crate) struct Nest {
    pub division: Division,
    /// From the last lanes to the first.
    pub descends: bool,
    /// Scalars taken in all lanes: made available before all loops.
    pub uniforms: Vec<ValueId>,
    /// Rows shorter than a strip, of which it has several: loaded before all loops.
    pub tiles: Vec<ValueId>,
    /// Memories with one address in all lanes: the words there are found before all loops.
    pub words: Vec<Word>,
    /// Values that are the same in a row: loaded before the loop over its strips.
    pub of_row: Vec<ValueId>,
    /// Reductions carried around the loop over the strips of a row.
    pub sums: Vec<ValueId>,
    /// Reductions carried around both loops, if there is more than one row.
    pub totals: Vec<ValueId>,
    /// The cells whose lanes a strip takes from other lanes, and how; not those that stand before the loops.
    pub taken: BTreeMap<ValueId, Access>,
    /// The sequence within a strip.
    pub work: Vec<Work>,
}

/// A step within a strip.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Work {
    /// Computes a cell.
    Cell(ValueId),
    /// Makes the operand of a carried reduction available, before registers change. It is combined at the end.
    Combine(ValueId),
    /// A register takes its next value. If it `keeps` the old one, that is loaded before, because a later sink reads it.
    Register { sink: usize, keeps: bool },
    /// Writes a memory.
    Write(usize),
}

impl Nest {
    /// The loops over so many lanes.
    pub fn of(of: (&Function, &Plan), memories: &[MemoryAt], strips: &StripSizes, lanes: u32, kernel: &Kernel) -> Nest {
        let (function, plan) = of;
        let strip = strips.strip(lanes);
        let inputs = Inputs { function, plan, kernel, lanes, all: inputs(function, kernel) };
        let row = inputs.row_length(strip);
        let sums = |count| inputs.reductions(count).collect::<Vec<_>>();
        let (of_row, totals) = if row < lanes { (inputs.of_row(row), sums(lanes)) } else { Default::default() };
        let sums = sums(row);
        let carried: BTreeSet<ValueId> = sums.iter().chain(&totals).copied().collect();
        let division = Division { lanes, row, strip };
        let tiles = inputs.tiles(strip);
        let later = inputs.all.iter().filter(|id| !tiles.contains(id) && !of_row.contains(id));
        let access = |&id: &ValueId| Some((id, Access::of(function, (memories, strips), division, id)?));
        Nest {
            division,
            taken: later.filter_map(access).collect(),
            descends: kernel.descends,
            uniforms: inputs.uniforms(),
            tiles,
            words: words(function, kernel, memories),
            of_row,
            work: work(function, kernel, &carried),
            sums,
            totals,
        }
    }
}

/// What a kernel computes and takes.
struct Inputs<'a> {
    function: &'a Function,
    plan: &'a Plan,
    kernel: &'a Kernel,
    lanes: u32,
    all: BTreeSet<ValueId>,
}

/// The cells of a kernel, and what they and its sinks take.
fn inputs(function: &Function, kernel: &Kernel) -> BTreeSet<ValueId> {
    let mut all = BTreeSet::new();
    let mut visit = |id: ValueId| {
        all.insert(id);
    };
    for &id in &kernel.cells {
        visit(id);
        function.cell(id).kind.for_each_operand(&mut visit);
    }
    kernel.sinks.iter().for_each(|&sink| function.sinks[sink].for_each_operand(&mut visit));
    all
}

impl Inputs<'_> {
    /// The group size that most of a kernel works with, if it consists of whole strips; all lanes otherwise.
    fn row_length(&self, strip: u32) -> u32 {
        let mut uses: BTreeMap<u32, usize> = BTreeMap::new();
        for &id in &self.all {
            let cell = self.function.cell(id);
            // Operands may have other lanes than the kernel: those of lane selections, and of other kernels'
            // reductions.
            let (of_lanes, group) = match cell.kind {
                Kind::Broadcast { axis, .. } if axis.inner > 1 => (cell.lanes, axis.inner),
                Kind::Broadcast { of, axis } if self.function.cell(of).lanes > 1 => (cell.lanes, axis.count),
                Kind::Reduce { of, axis, .. } if cell.lanes > 1 => (self.function.cell(of).lanes, axis.count),
                _ => continue,
            };
            if of_lanes == self.lanes && group % strip == 0 && group < self.lanes {
                *uses.entry(group).or_default() += 1;
            }
        }
        uses.into_iter().max_by_key(|&(group, count)| (count, group)).map_or(self.lanes, |(group, _)| group)
    }

    fn uniforms(&self) -> Vec<ValueId> {
        let is_uniform = |id: &ValueId| match self.function.cell(*id).kind {
            Kind::Broadcast { of, .. } => self.function.cell(of).lanes == 1,
            _ => false,
        };
        self.all.iter().copied().filter(is_uniform).collect()
    }

    fn tiles(&self, strip: u32) -> Vec<ValueId> {
        let is_tile = |id: &ValueId| {
            let cell = self.function.cell(*id);
            let Kind::Broadcast { of, axis } = cell.kind else { return false };
            let is_short = axis.inner > 1 && axis.inner < strip && strip.is_multiple_of(axis.inner);
            let is_whole = (cell.lanes, self.function.cell(of).lanes) == (self.lanes, axis.inner);
            is_short && is_whole && cell.width <= 64 && self.is_current(*id)
        };
        self.all.iter().copied().filter(is_tile).collect()
    }

    fn of_row(&self, row: u32) -> Vec<ValueId> {
        let is_of_row = |id: &ValueId| {
            let cell = self.function.cell(*id);
            let Kind::Broadcast { of, axis } = cell.kind else { return false };
            axis == Axis { count: row, inner: 1 }
                && cell.lanes == self.lanes
                && self.function.cell(of).lanes > 1
                && cell.width <= 64
                && self.is_current(*id)
        };
        self.all.iter().copied().filter(is_of_row).collect()
    }

    /// Whether a derived value is up to date: if it is stored, another loop may have stored it before its source changed.
    fn is_current(&self, id: ValueId) -> bool {
        let is_stored = self.plan.live_out.contains(&id) || self.plan.homes.contains_key(&id);
        !is_stored || self.kernel.cells.contains(&id)
    }

    /// Reductions of this number of lanes each, which fit a vector.
    fn reductions(&self, count: u32) -> impl Iterator<Item = ValueId> {
        let is_one = move |id: &ValueId| {
            let cell = self.function.cell(*id);
            matches!(cell.kind, Kind::Reduce { axis, .. } if axis.count == count && cell.width <= 64)
        };
        self.kernel.cells.iter().copied().filter(is_one)
    }
}

/// The memories that are read and written at one address in all lanes, with that address.
fn words(function: &Function, kernel: &Kernel, memories: &[MemoryAt]) -> Vec<Word> {
    let reads = kernel.cells.iter().filter_map(|&id| match function.cell(id).kind {
        Kind::Lowered(Lowered::Word { memory, address } | Lowered::WordOf { memory, address, .. }) => {
            Some((memory, address))
        }
        _ => None,
    });
    let writes = kernel.sinks.iter().filter_map(|&sink| match function.sinks[sink] {
        Sink::Write { memory, address, .. } => Some((memory, address)),
        _ => None,
    });
    let mut words = Vec::new();
    for word in reads.chain(writes).filter(|&(memory, _)| memories[memory as usize].words.together()) {
        if !words.contains(&word) {
            words.push(word);
        }
    }
    words
}

/// Registers change as early as possible, so that few values are live at a time: after their inputs are computed,
/// when no cell reads their old values. Memories are written at the end.
fn work(function: &Function, kernel: &Kernel, carried: &BTreeSet<ValueId>) -> Vec<Work> {
    let mut last = BTreeMap::new();
    for (index, &id) in kernel.cells.iter().enumerate() {
        last.insert(id, index);
        function.cell(id).kind.for_each_operand(|operand| {
            last.insert(operand, index);
        });
    }
    // Before all cells, or after one.
    let mut registers: BTreeMap<Option<usize>, Vec<usize>> = BTreeMap::new();
    for &index in &kernel.sinks {
        let sink = &function.sinks[index];
        let &Sink::Register { state, .. } = sink else { continue };
        let mut position = last.get(&state).copied();
        sink.for_each_operand(|operand| position = position.max(last.get(&operand).copied()));
        registers.entry(position).or_default().push(index);
    }
    let mut open: BTreeSet<usize> = kernel.sinks.iter().copied().collect();
    let mut change = |sink: usize| {
        open.remove(&sink);
        let &Sink::Register { state, .. } = &function.sinks[sink] else { unreachable!("a register") };
        let mut keeps = false;
        for &other in &open {
            function.sinks[other].for_each_operand(|operand| keeps |= operand == state);
        }
        Work::Register { sink, keeps }
    };
    let mut changes = |position: Option<usize>| -> Vec<Work> {
        registers.get(&position).into_iter().flatten().map(|&sink| change(sink)).collect()
    };
    let mut work = changes(None);
    for (index, &id) in kernel.cells.iter().enumerate() {
        work.push(if carried.contains(&id) { Work::Combine(id) } else { Work::Cell(id) });
        work.extend(changes(Some(index)));
    }
    let is_write = |sink: &&usize| matches!(function.sinks[**sink], Sink::Write { .. });
    work.extend(kernel.sinks.iter().filter(is_write).map(|&sink| Work::Write(sink)));
    work
}
