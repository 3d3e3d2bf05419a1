//! The independent parts of a loop.

use std::collections::{BTreeMap, BTreeSet};

use rustc_hash::{FxHashMap, FxHashSet};
use tilewright_circuit::graph::Union;

use super::stays::Holds;
use crate::engine::function::{Function, Sink};
use crate::engine::plan::{Kernel, Plan, Switch};
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
    fn join(&mut self, other: Part) {
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

    /// Whether it must run before another part, because that one changes what it reads, or writes later to the same
    /// memory.
    fn is_before(&self, other: &Part) -> bool {
        let is_later = |(memory, sinks): (&u32, &BTreeSet<usize>)| {
            self.words.contains(memory) || self.written.get(memory).is_some_and(|own| own.first() < sinks.last())
        };
        !self.reads.is_disjoint(&other.writes) || other.written.iter().any(is_later)
    }
}

/// The independent parts of a loop: a value that several would need is computed once, unless it costs nothing.
pub(super) fn parts(function: &Function, plan: &Plan, kernel: &Kernel) -> Vec<Part> {
    let members = Members::of(function, plan, kernel);
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

/// The cells of a loop, and after them its sinks.
struct Members<'a> {
    function: &'a Function,
    plan: &'a Plan,
    kernel: &'a Kernel,
    /// For each cell, which one it is.
    places: FxHashMap<ValueId, usize>,
}

impl Members<'_> {
    fn of<'a>(function: &'a Function, plan: &'a Plan, kernel: &'a Kernel) -> Members<'a> {
        let places = kernel.cells.iter().enumerate().map(|(place, id)| (*id, place)).collect();
        Members { function, plan, kernel, places }
    }

    fn count(&self) -> usize {
        self.kernel.cells.len() + self.kernel.sinks.len()
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
    pub(super) fn kernel(&self, function: &Function, of: &Kernel) -> Kernel {
        let mut cells = self.cells.clone();
        // A value that costs nothing is computed wherever it is used.
        for &id in of.cells.iter().rev() {
            if cells.contains(&id) {
                function.cell(id).kind.for_each_operand(|operand| cells.extend([operand]));
            }
        }
        self.sinks.iter().for_each(|&sink| function.sinks[sink].for_each_operand(|operand| cells.extend([operand])));
        let kernel = Kernel {
            cells: of.cells.iter().copied().filter(|id| cells.contains(id)).collect(),
            sinks: of.sinks.iter().copied().filter(|sink| self.sinks.contains(sink)).collect(),
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

/// Brings parts into sequence; those that must each precede the other are merged.
fn ordered(mut open: Vec<Part>) -> Vec<Part> {
    let mut order = Vec::new();
    while !open.is_empty() {
        let is_first = |index: &usize| {
            let others = open.iter().enumerate().filter(|(other, _)| other != index);
            !others.into_iter().any(|(_, other)| other.is_before(&open[*index]))
        };
        match (0..open.len()).find(is_first) {
            Some(index) => order.push(open.remove(index)),
            None => {
                // Every waiting part leads to a cycle: follow it from any of them.
                let mut at = 0;
                let mut path = Vec::new();
                while !path.contains(&at) {
                    path.push(at);
                    let before = |other: &usize| *other != at && open[*other].is_before(&open[at]);
                    at = (0..open.len()).find(before).expect("something is before it");
                }
                let start = path.iter().position(|&other| other == at).expect("it was there");
                let circle: BTreeSet<usize> = path[start..].iter().copied().collect();
                let all: Vec<Part> = circle.into_iter().rev().map(|index| open.remove(index)).collect();
                open.extend(all.into_iter().reduce(|mut joined, part| {
                    joined.join(part);
                    joined
                }));
            }
        }
    }
    order
}

/// Parts in sequence, those that rest under the same condition together where that is possible.
pub(super) fn together(parts: Vec<Part>) -> Vec<Part> {
    let mut joined: Vec<Part> = Vec::new();
    for part in parts.iter().cloned() {
        let same = joined.iter_mut().find(|other| part.stays == other.stays && matches!(part.stays, Holds::If(_)));
        match same {
            Some(other) => other.join(part),
            None => joined.push(part),
        }
    }
    let count = joined.len();
    let joined = ordered(joined);
    // Parts between them may have to stand after one and before another.
    if joined.len() == count { joined } else { ordered(parts) }
}
