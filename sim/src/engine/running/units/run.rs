//! Running a unit, and noting when it has nothing to do.
//!
//! A unit with the same crossing values that changed nothing at the last edge changes nothing at the next one either.
//! So its code is skipped until a crossing value changes. A comparison with an earlier copy of the unit's state finds
//! whether an edge has changed anything. A busy unit is compared only from time to time, scalars first: one of them
//! nearly always counts.

use std::cell::Cell;

use crate::engine::layout::span::Span;

use crate::engine::cranelift::Code;

/// Edges between two comparisons, first and at most.
const FIRST: u64 = 2;
const MOST: u64 = 64;

/// A crossing value: its place in the rest of the circuit, the place of its copy when the unit last ran, and the
/// place where the unit's code reads it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Crossing {
    pub now: Span,
    pub last: usize,
    pub taken: usize,
}

/// The work of a unit in a function, run by code.
pub(in crate::engine::running) struct Running {
    pub(super) crossing: Vec<Crossing>,
    pub(super) code: Vec<Code>,
    /// Bytes from the first unit of its kind to it.
    pub(super) distance: u64,
    /// The place of a limb that is 0 if it has nothing to do until a crossing value changes.
    pub(super) busy: usize,
    /// Counts the unit's runs for edges.
    pub(super) version: usize,
    /// Comparing all its crossing values would take too long: it is run at every edge.
    pub(super) always: bool,
    pub(super) task: Task,
}

/// What to do when it has run.
pub(super) enum Task {
    Edge(Changes),
    /// Notes whether all assertions pass: the place where code stores the result, and the unit's own place.
    Check(usize, usize),
}

/// The state of a unit that an edge may change.
pub(super) struct Changes {
    /// Values of one lane, and the others.
    pub(super) single: Vec<Span>,
    pub(super) lanes: Vec<Span>,
    /// The place where code notes a write to a memory.
    pub(super) wrote: usize,
    /// The place where the runs of all units are counted.
    pub(super) runs: usize,
    /// Edges between two comparisons.
    pub(super) patience: Cell<u64>,
    /// The next comparison covers all of it.
    pub(super) all: Cell<bool>,
    /// All of it, as it was.
    pub(super) kept: Vec<Cell<u64>>,
}

/// Called for an edge at which a unit may have something to do.
///
/// # Safety
///
/// `state` and `scratch` are those of the engine that made the unit, and nobody else uses them.
#[allow(unsafe_code, reason = "generated code calls it")]
pub(super) unsafe extern "C" fn run(state: *mut u8, unit: *const Running, scratch: *mut u64) {
    // SAFETY: the engine that owns the calling code owns the unit too.
    let unit = unsafe { &*unit };
    unit.edge(&State { state, scratch });
}

/// The memory that code works on.
struct State {
    state: *mut u8,
    scratch: *mut u64,
}

impl State {
    fn get(&self, offset: usize) -> u64 {
        // SAFETY: a unit's references are places in the state, which has grown since if it had to.
        #[allow(unsafe_code, reason = "the state is shared with code")]
        unsafe {
            self.state.add(offset).cast::<u64>().read()
        }
    }

    fn set(&self, offset: usize, limb: u64) {
        // SAFETY: as for `get`.
        #[allow(unsafe_code, reason = "the state is shared with code")]
        unsafe {
            self.state.add(offset).cast::<u64>().write(limb);
        }
    }
}

impl Running {
    fn edge(&self, state: &State) {
        self.take(state);
        let left = match &self.task {
            Task::Edge(changes) => {
                for count in [self.version, changes.runs] {
                    state.set(count, state.get(count) + 1);
                }
                self.change(state, changes)
            }
            &Task::Check(from, to) => {
                self.call(state);
                state.set(to, state.get(from));
                u64::from(self.always)
            }
        };
        state.set(self.busy, left);
    }

    /// Copies crossing values to where code reads them.
    fn take(&self, state: &State) {
        for &Crossing { now, last, taken } in &self.crossing {
            for (limb, (at, _)) in now.limbs().enumerate() {
                let number = state.get(at);
                state.set(last + 8 * limb, number);
                state.set(taken + 8 * limb, number);
            }
        }
    }

    /// Executes an edge; returns the number of edges until the next comparison, or 0 if there is nothing to do.
    fn change(&self, state: &State, changes: &Changes) -> u64 {
        let left = match state.get(self.busy) {
            0 => {
                changes.patience.set(FIRST);
                FIRST
            }
            left => left,
        };
        if left > 1 || self.always {
            self.call(state);
            return (left - 1).max(1);
        }
        let all = changes.all.replace(false) || changes.lanes.is_empty();
        changes.keep(state, all);
        state.set(changes.wrote, 0);
        self.call(state);
        match state.get(changes.wrote) == 0 && changes.are_none(state, all) {
            true if all => 0,
            true => {
                changes.all.set(true);
                1
            }
            false => {
                changes.patience.set((2 * changes.patience.get()).min(MOST));
                changes.patience.get()
            }
        }
    }

    fn call(&self, state: &State) {
        for code in &self.code {
            // SAFETY: the engine made this code for this memory, and the calling code has reserved the stack.
            #[allow(unsafe_code, reason = "calls generated code")]
            unsafe {
                code.call_within(state.state, self.distance, state.scratch);
            }
        }
    }
}

impl Changes {
    fn spans(&self, all: bool) -> impl Iterator<Item = (usize, u64)> {
        let lanes = if all { self.lanes.as_slice() } else { &[] };
        self.single.iter().chain(lanes).flat_map(|span| span.limbs())
    }

    fn keep(&self, state: &State, all: bool) {
        self.kept.iter().zip(self.spans(all)).for_each(|(kept, (at, _))| kept.set(state.get(at)));
    }

    fn are_none(&self, state: &State, all: bool) -> bool {
        self.kept.iter().zip(self.spans(all)).all(|(kept, (at, mask))| (kept.get() ^ state.get(at)) & mask == 0)
    }
}
