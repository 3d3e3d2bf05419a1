//! The values that a waveform file shows, and the variables that change from one step to the next.
//!
//! An engine returns a value in all lanes at once, and is asked only for values that may have changed. A file has a
//! variable for each lane, in the sequence of its scopes. A copy of all values as last taken connects the two.

use std::collections::HashMap;
use std::ops::Range;

use crate::engine::Engine;
use crate::engine::program::{Program, Schedule, Triggers, ValueId};

/// The values as last taken, and flags for the variables that have changed since the last visit.
pub(super) struct Shown {
    limbs: Vec<u64>,
    /// Values with the same triggers are adjacent.
    values: Vec<Traced>,
    groups: Vec<Group>,
    /// Whether the values have ever been taken.
    known: bool,
    /// The numbers of a group that have changed; kept to avoid an allocation.
    renewed: Vec<u32>,
    variables: Variables,
}

/// Values that change together.
struct Group {
    triggers: Triggers,
    /// The values of one lane and up to 64 bits, which come first; their limbs are adjacent, as are their lanes.
    numbers: Vec<ValueId>,
    /// The engine's notes about them.
    note: Vec<u32>,
    /// The others, by index.
    others: Range<usize>,
    /// The first limb and the first lane of the numbers.
    first_limb: usize,
    first_lane: usize,
}

/// A value that a variable shows.
struct Traced {
    value: ValueId,
    /// Its range among the limbs taken.
    limbs: Range<usize>,
    /// The number of limbs of one lane.
    per_lane: usize,
    /// Its first lane in [`Variables::of_lane`].
    first_lane: usize,
    /// The engine's notes about it.
    seen: Vec<u64>,
}

/// The variables of the file, by number.
#[derive(Default)]
struct Variables {
    /// The position of each variable's lane among the limbs taken.
    limbs: Vec<Range<usize>>,
    /// For each lane of all values, the variables that show it: two if it has names for its numbers. If there are
    /// fewer, the entry is the index after the last variable: setting a spare flag takes less time than a branch.
    of_lane: Vec<[u32; 2]>,
    /// For each variable, and for the spare one, whether it has changed: bytes, which can be written without being
    /// read.
    changed: Vec<u8>,
}

impl Shown {
    /// Variable `i` shows the lane `variables[i]` of a value.
    pub fn new(program: &Program, variables: &[(ValueId, u32)]) -> Shown {
        let triggers = triggers(program);
        let mut values: Vec<ValueId> = variables.iter().map(|variable| variable.0).collect();
        let is_number = |value: ValueId| program.value(value).lanes == 1 && program.value(value).width <= 64;
        values.sort_unstable_by_key(|&value| (triggers[value.index()], !is_number(value), value));
        values.dedup();
        let mut shown = Shown {
            limbs: Vec::new(),
            values: Vec::with_capacity(values.len()),
            groups: Vec::new(),
            known: false,
            renewed: Vec::new(),
            variables: Variables::default(),
        };
        let (mut limbs, mut lanes) = (0, 0);
        for &id in &values {
            let value = program.value(id);
            let end = limbs + value.range().len();
            shown.values.push(Traced {
                value: id,
                limbs: limbs..end,
                per_lane: value.limbs(),
                first_lane: lanes,
                seen: Vec::new(),
            });
            (limbs, lanes) = (end, lanes + value.lanes as usize);
        }
        shown.limbs = vec![0; limbs];
        for group in values.chunk_by(|a, b| triggers[a.index()] == triggers[b.index()]) {
            let start = shown.groups.last().map_or(0, |last| last.others.end);
            let numbers: Vec<ValueId> = group.iter().copied().take_while(|&value| is_number(value)).collect();
            shown.groups.push(Group {
                triggers: triggers[group[0].index()],
                others: start + numbers.len()..start + group.len(),
                numbers,
                note: Vec::new(),
                first_limb: shown.values[start].limbs.start,
                first_lane: shown.values[start].first_lane,
            });
        }
        let places: HashMap<ValueId, usize> = values.iter().enumerate().map(|(place, &value)| (value, place)).collect();
        let place = |&(value, lane): &(ValueId, u32)| (&shown.values[places[&value]], lane as usize);
        shown.variables = Variables::new(lanes, variables.iter().map(place));
        shown
    }

    /// Takes the values that these triggers change; the first time, all values.
    pub fn take(&mut self, engine: &mut dyn Engine, changed: Triggers) {
        let Shown { limbs, values, groups, variables, renewed, known } = self;
        for group in groups.iter_mut().filter(|group| group.triggers.meet(changed) || !*known) {
            let numbers = &mut limbs[group.first_limb..][..group.numbers.len()];
            engine.renew(&group.numbers, numbers, &mut group.note, renewed);
            renewed.iter().for_each(|&index| variables.mark_lane(group.first_lane + index as usize));
            for traced in &mut values[group.others.clone()] {
                if !engine.is_as_seen(traced.value, &mut traced.seen) {
                    traced.replace(limbs, engine.read(traced.value), variables);
                }
            }
        }
        self.known = true;
    }

    /// All values as last taken.
    pub fn limbs(&self) -> &[u64] {
        &self.limbs
    }

    /// Restores the values of an earlier [`Shown::limbs`].
    pub fn go_to(&mut self, limbs: &[u64]) {
        for traced in &mut self.values {
            traced.seen.clear();
            traced.replace(&mut self.limbs, &limbs[traced.limbs.clone()], &mut self.variables);
        }
    }

    /// The number of limbs of each variable.
    pub fn limbs_of_variables(&self) -> impl Iterator<Item = usize> {
        self.variables.limbs.iter().map(Range::len)
    }

    /// The limbs of one variable after another, as last taken.
    pub fn row(&self) -> impl Iterator<Item = u64> {
        self.variables.limbs.iter().flat_map(|limbs| &self.limbs[limbs.clone()]).copied()
    }

    /// Takes the values of such a row, without flagging changes.
    pub fn take_row(&mut self, row: &[u64]) {
        let places = self.variables.limbs.iter().cloned().flatten();
        places.zip(row).for_each(|(place, limb)| self.limbs[place] = *limb);
        self.values.iter_mut().for_each(|traced| traced.seen.clear());
    }

    /// Flags all variables as changed.
    pub fn mark_all(&mut self) {
        self.variables.mark_all();
    }

    /// Visits the variables that have changed since the last visit, by number, with their limbs.
    pub fn visit_changed(&mut self, mut visit: impl FnMut(usize, &[u64])) {
        let Variables { limbs, changed, .. } = &mut self.variables;
        changed[limbs.len()] = 0;
        for (index, bytes) in changed.as_chunks_mut().0.iter_mut().enumerate() {
            let mut rest = u64::from_le_bytes(std::mem::take(bytes));
            while rest != 0 {
                let variable = 8 * index + rest.trailing_zeros() as usize / 8;
                visit(variable, &self.limbs[limbs[variable].clone()]);
                rest &= rest - 1;
            }
        }
    }
}

impl Traced {
    /// Replaces the value among the limbs, and flags the variables whose lanes differ.
    fn replace(&self, limbs: &mut [u64], new: &[u64], variables: &mut Variables) {
        let old = &mut limbs[self.limbs.clone()];
        if old == new {
            return;
        }
        let lanes = old.chunks_exact_mut(self.per_lane).zip(new.chunks_exact(self.per_lane));
        for (lane, (old, new)) in (self.first_lane..).zip(lanes) {
            if old != new {
                old.copy_from_slice(new);
                variables.mark_lane(lane);
            }
        }
    }
}

impl Variables {
    /// For each variable, the value and its lane; `lanes` is the number of lanes of all values.
    fn new<'a>(lanes: usize, variables: impl ExactSizeIterator<Item = (&'a Traced, usize)>) -> Variables {
        let nobody = variables.len() as u32;
        let mut all = Variables { of_lane: vec![[nobody; 2]; lanes], ..Variables::default() };
        for (number, (traced, lane)) in (0u32..).zip(variables) {
            let start = traced.limbs.start + lane * traced.per_lane;
            all.limbs.push(start..start + traced.per_lane);
            let of_lane = &mut all.of_lane[traced.first_lane + lane];
            let free = of_lane.iter().position(|it| *it == nobody).expect("a lane has up to two variables");
            of_lane[free] = number;
        }
        all.changed = vec![0; (all.limbs.len() + 1).next_multiple_of(8)];
        all
    }

    fn mark_all(&mut self) {
        self.changed.fill(1);
        self.changed[self.limbs.len()..].fill(0);
    }

    fn mark_lane(&mut self, lane: usize) {
        let [one, other] = self.of_lane[lane];
        self.changed[one as usize] = 1;
        self.changed[other as usize] = 1;
    }
}

/// The triggers that can change each value of a program.
fn triggers(program: &Program) -> Vec<Triggers> {
    let Schedule { slots, segments, .. } = &program.schedule;
    let of_result = |segment: u32| segments[segment as usize].triggers;
    let mut all: Vec<Triggers> = slots.iter().map(|(_, by)| by.map_or(Triggers::NONE, of_result)).collect();
    program.inputs.iter().for_each(|port| all[port.value.index()] = port.triggers);
    for register in &program.registers {
        all[register.value.index()] = Triggers::state(register.clock as usize);
    }
    for read in program.memories.iter().flat_map(|memory| &memory.reads) {
        all[read.value.index()] = Triggers::state(read.clock as usize);
    }
    all
}
