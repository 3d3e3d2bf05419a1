//! The independent parts of a loop.

use std::collections::{BTreeMap, BTreeSet};

use rustc_hash::FxHashSet;

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

/// The independent parts of a loop.
pub(super) fn parts(function: &Function, plan: &Plan, kernel: &Kernel) -> Vec<Part> {
    let inside: FxHashSet<ValueId> = kernel.cells.iter().copied().collect();
    let mut open: Vec<Part> = Vec::new();
    let mut add = |mut part: Part| {
        // A value that several loops need is computed once, unless it costs nothing.
        let (common, others) = open.drain(..).partition(|other: &Part| !other.cells.is_disjoint(&part.cells));
        open = others;
        let common: Vec<Part> = common;
        common.into_iter().for_each(|other| part.join(other));
        open.push(part);
    };
    for &index in &kernel.sinks {
        let sink = &function.sinks[index];
        let mut part = Part { sinks: BTreeSet::from([index]), ..Part::default() };
        match *sink {
            Sink::Register { state, .. } => part.writes.extend([state]),
            Sink::Write { memory, .. } => part.written.extend([(memory, BTreeSet::from([index]))]),
            _ => {}
        }
        sink.for_each_operand(|operand| part.take(function, plan, &inside, operand));
        add(part);
    }
    for &id in kernel.cells.iter().filter(|id| plan.live_out.contains(id)) {
        let mut part = Part::default();
        part.take(function, plan, &inside, id);
        add(part);
    }
    open
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

    /// Adds a value, with everything that the loop computes for it.
    fn take(&mut self, function: &Function, plan: &Plan, inside: &FxHashSet<ValueId>, id: ValueId) {
        let mut open = vec![id];
        let mut seen = FxHashSet::default();
        while let Some(id) = open.pop() {
            let kind = &function.cell(id).kind;
            if *kind == Kind::State {
                self.reads.insert(id);
            }
            if !inside.contains(&id) || !seen.insert(id) {
                continue;
            }
            if plan.live_out.contains(&id) || !matches!(kind, Kind::Broadcast { .. }) {
                self.cells.insert(id);
            }
            if let Kind::Lowered(Lowered::Word { memory, .. }) = kind {
                self.words.insert(*memory);
            }
            kind.for_each_operand(|operand| open.push(operand));
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
