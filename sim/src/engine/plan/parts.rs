//! The independent parts of a loop.

use std::collections::{BTreeMap, BTreeSet};

use rustc_hash::{FxHashMap, FxHashSet};
use tilewright_circuit::graph::{Graph, Union};

use super::quiet::Holds;
use super::{Kernel, Plan, Switch};
use crate::engine::function::{Function, Sink};
use crate::engine::program::{Kind, Lowered, ValueId};

/// The contents of a part of a loop.
#[derive(Clone, Default)]
pub(super) struct Part {
    /// The condition under which it has nothing to do.
    pub stays: Holds,
    pub cells: FxHashSet<ValueId>,
    pub sinks: BTreeSet<usize>,
    /// Registers that it reads, and changes.
    reads: FxHashSet<ValueId>,
    writes: FxHashSet<ValueId>,
    /// The same for memories.
    words: FxHashSet<u32>,
    /// For each memory, the sinks that write to it.
    written: BTreeMap<u32, BTreeSet<usize>>,
}

impl Part {
    /// The number of its operations.
    pub(super) fn operations(&self) -> usize {
        self.cells.len() + self.sinks.len()
    }

    pub(super) fn join(&mut self, other: Part) {
        if self.stays != other.stays {
            self.stays = Holds::Never;
        }
        self.cells.extend(other.cells);
        self.sinks.extend(other.sinks);
        self.reads.extend(other.reads);
        self.writes.extend(other.writes);
        self.words.extend(other.words);
        other.written.into_iter().for_each(|(memory, sinks)| self.written.entry(memory).or_default().extend(sinks));
    }
}

/// The independent parts of a loop: a value that several would need is computed once, unless it costs nothing.
pub(super) fn parts(function: &Function, plan: &Plan, kernel: &Kernel, places: &Places) -> Vec<Part> {
    let members = Members { function, plan, kernel, places };
    let roots: Vec<usize> = members.roots().collect();
    let (mut union, mut is_needed) = (Union::new(members.count()), vec![false; members.count()]);
    roots.iter().for_each(|&root| is_needed[root] = true);
    // Each member comes after what it uses.
    for member in (0..members.count()).rev() {
        if is_needed[member] {
            members.for_each_used(member, |used| {
                is_needed[used] = true;
                union.join(member, used);
            });
        }
    }
    let mut last = vec![0; members.count()];
    roots.iter().enumerate().for_each(|(rank, &root)| last[union.first(root)] = rank);
    let mut parts: BTreeMap<usize, Part> = BTreeMap::new();
    for member in (0..members.count()).filter(|&member| is_needed[member]) {
        members.put(member, parts.entry(last[union.first(member)]).or_default());
    }
    parts.into_values().collect()
}

/// For each cell of a loop, which one it is.
pub(super) type Places = FxHashMap<ValueId, usize>;

pub(super) fn places(kernel: &Kernel) -> Places {
    kernel.cells.iter().enumerate().map(|(place, id)| (*id, place)).collect()
}

/// The cells of a loop, and after them its sinks.
struct Members<'a> {
    function: &'a Function,
    plan: &'a Plan,
    kernel: &'a Kernel,
    places: &'a Places,
}

impl Members<'_> {
    fn count(&self) -> usize {
        self.kernel.operations()
    }

    /// Those for which the others are computed: sinks, and values for other loops.
    fn roots(&self) -> impl Iterator<Item = usize> {
        let cells = &self.kernel.cells;
        let values = (0..cells.len()).filter(|&place| self.plan.live_out.contains(&cells[place]));
        (cells.len()..self.count()).chain(values)
    }

    /// Calls `visit` with each operand, or with what it repeats in other lanes if that costs nothing.
    fn for_each_operand(&self, member: usize, mut visit: impl FnMut(ValueId)) {
        let mut visit = |mut id: ValueId| {
            while let Kind::Broadcast { of, .. } = self.function.cell(id).kind
                && self.places.contains_key(&id)
                && !self.plan.live_out.contains(&id)
            {
                id = of;
            }
            visit(id);
        };
        match self.kernel.cells.get(member) {
            Some(&id) => self.function.cell(id).kind.for_each_operand(&mut visit),
            None => self.function.sinks[self.sink(member)].for_each_operand(&mut visit),
        }
    }

    /// Calls `visit` with each member that is an operand of this one.
    fn for_each_used(&self, member: usize, mut visit: impl FnMut(usize)) {
        self.for_each_operand(member, |id| self.places.get(&id).into_iter().for_each(|&place| visit(place)));
    }

    /// The index of a sink in the function.
    fn sink(&self, member: usize) -> usize {
        self.kernel.sinks[member - self.kernel.cells.len()]
    }

    /// Puts a member into a part.
    fn put(&self, member: usize, part: &mut Part) {
        match self.kernel.cells.get(member) {
            Some(&id) => {
                part.cells.insert(id);
                if let Kind::Lowered(Lowered::Word { memory, .. }) = self.function.cell(id).kind {
                    part.words.insert(memory);
                }
            }
            None => {
                let index = self.sink(member);
                part.sinks.insert(index);
                match self.function.sinks[index] {
                    Sink::Register { state, .. } => drop(part.writes.insert(state)),
                    Sink::Write { memory, .. } => drop(part.written.entry(memory).or_default().insert(index)),
                    _ => {}
                }
            }
        }
        self.for_each_operand(member, |id| {
            if matches!(self.function.cell(id).kind, Kind::State) {
                part.reads.insert(id);
            }
        });
    }
}

impl Part {
    /// The loop of it, or nothing where it rests.
    pub(super) fn kernel(&self, function: &Function, of: &Kernel, places: &Places) -> Kernel {
        let mut open: Vec<ValueId> = self.cells.iter().copied().collect();
        self.sinks.iter().for_each(|&sink| function.sinks[sink].for_each_operand(|operand| open.push(operand)));
        let mut cells = BTreeSet::new();
        // A value that costs nothing is computed wherever it is used.
        while let Some(id) = open.pop() {
            if places.get(&id).is_some_and(|&place| cells.insert(place)) {
                function.cell(id).kind.for_each_operand(|operand| open.push(operand));
            }
        }
        let kernel = Kernel {
            cells: cells.into_iter().map(|place| of.cells[place]).collect(),
            sinks: self.sinks.iter().copied().collect(),
            descends: of.descends,
            ..Kernel::default()
        };
        match self.stays {
            Holds::If(subject) => {
                let kernels = vec![kernel.clone(), Kernel::default()];
                Kernel { switch: Some(Box::new(Switch { subject, kernels, table: vec![0, 1] })), ..kernel }
            }
            Holds::Never | Holds::Always => kernel,
        }
    }
}

/// Parts in sequence, those that rest under the same condition together where that is possible.
pub(super) fn together(parts: Vec<Part>) -> Vec<Part> {
    let (mut joined, mut resting): (Vec<Part>, FxHashMap<ValueId, usize>) = Default::default();
    for part in &parts {
        let place = match part.stays {
            Holds::If(subject) => *resting.entry(subject).or_insert(joined.len()),
            Holds::Never | Holds::Always => joined.len(),
        };
        match joined.get_mut(place) {
            Some(other) => other.join(part.clone()),
            None => joined.push(part.clone()),
        }
    }
    let count = joined.len();
    let joined = ordered(joined);
    // Parts between them may have to stand after one and before another.
    if joined.len() == count { joined } else { ordered(parts) }
}

/// Brings parts into sequence; those that must each precede the other are merged.
pub(super) fn ordered(parts: Vec<Part>) -> Vec<Part> {
    let readers = Readers::of(&parts);
    let before = Graph::new(parts.len(), |part, visit| readers.before(&parts, part).into_iter().for_each(visit));
    let mut parts: Vec<Option<Part>> = parts.into_iter().map(Some).collect();
    let merged = |component: &[u32]| {
        let parts = component.iter().map(|&part| parts[part as usize].take().expect("it is in one component"));
        parts.reduce(|mut joined, part| {
            joined.join(part);
            joined
        })
    };
    before.components().filter_map(merged).collect()
}

/// The parts that read what others change.
struct Readers {
    registers: FxHashMap<ValueId, Vec<u32>>,
    memories: FxHashMap<u32, Vec<u32>>,
    /// For each memory, the parts that write to it, each with its first sink.
    writers: FxHashMap<u32, Vec<(usize, u32)>>,
}

impl Readers {
    fn of(parts: &[Part]) -> Readers {
        let (mut registers, mut memories, mut writers) =
            <(FxHashMap<_, Vec<_>>, FxHashMap<_, Vec<_>>, FxHashMap<_, Vec<_>>)>::default();
        for (number, part) in (0..).zip(parts) {
            part.reads.iter().for_each(|state| registers.entry(*state).or_default().push(number));
            part.words.iter().for_each(|memory| memories.entry(*memory).or_default().push(number));
            for (memory, sinks) in &part.written {
                writers.entry(*memory).or_default().extend(sinks.first().map(|&first| (first, number)));
            }
        }
        Readers { registers, memories, writers }
    }

    /// The parts that must run before one, because it changes what they read, or writes later to the same memory.
    fn before(&self, parts: &[Part], number: u32) -> BTreeSet<u32> {
        let part = &parts[number as usize];
        let registers = part.writes.iter().filter_map(|state| self.registers.get(state)).flatten().copied();
        let words = part.written.keys().filter_map(|memory| self.memories.get(memory)).flatten().copied();
        let earlier = part.written.iter().flat_map(|(memory, sinks)| {
            self.writers[memory].iter().filter(|(first, _)| Some(first) < sinks.last()).map(|&(_, other)| other)
        });
        registers.chain(words).chain(earlier).filter(|&other| other != number).collect()
    }
}
