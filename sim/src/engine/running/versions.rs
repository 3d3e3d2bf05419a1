//! Versions of a loop, each for frequent numbers.
//!
//! If many scalars select what all lanes do, as the fields of an instruction do, a loop for each combination would be
//! too many. But a program uses few combinations. So all the numbers, side by side, form a *key*, by which code looks
//! up a version of the loop in a table. If there is none, it notes the key and runs the general loop. From time to
//! time, the engine makes versions for keys that were noted often.
//!
//! ```text
//! op, source, mask, ..  -- key -->  [ key | code ]  -->  sum <- sum + word     nothing is left to choose
//!                                    none: noted    -->  the loop with all choices
//! ```

use rustc_hash::FxHashMap;

use super::Compiled;
use crate::engine::cranelift::Code;
use crate::engine::emit::versions::{NOTED, SLOT, SPREAD, STACK, TableAt};
use crate::engine::emit::{Addresses, Emitter};
use crate::engine::function::Function;
use crate::engine::layout::Surrounded;
use crate::engine::layout::store::Store;
use crate::engine::plan::branch::{Dependents, Known};
use crate::engine::plan::versioned::Versioned;
use crate::engine::plan::{Kernel, Plan};
use crate::engine::program::ValueId;

/// Edges between two looks at the noted keys.
const BETWEEN: u64 = NOTED as u64;
/// The number of different keys of a loop that are counted; then counting restarts.
const COUNTED: usize = 1 << 12;

/// A function's loops that may get versions.
pub(super) struct Versions {
    function: Function,
    /// Without its stages.
    plan: Plan,
    addresses: Addresses,
    loops: Vec<Loop>,
}

/// One of them.
struct Loop {
    at: TableAt,
    /// The scalars that depend on the subjects, each after its operands.
    cone: Vec<ValueId>,
    /// The number of noted keys at the last look.
    seen: u64,
    /// The count of each key.
    counts: FxHashMap<u64, u32>,
}

impl Loop {
    /// The keys that have now been noted often enough.
    fn often(&mut self, state: &Store, after: u32) -> Vec<u64> {
        let count = state.number(self.at.noted, 0);
        let new = (count - self.seen).min(NOTED.into());
        self.seen = count;
        if self.counts.len() > COUNTED {
            self.counts.clear();
        }
        let key = |back: u64| state.number(self.at.noted, 1 + ((count - back) % u64::from(NOTED)) as u32);
        let mut often = Vec::new();
        for key in (1..=new).map(key) {
            let count = self.counts.entry(key).or_default();
            *count = count.saturating_add(1);
            if *count == after {
                often.push(key);
            }
        }
        often
    }
}

impl Versions {
    /// The loops of a prepared function.
    pub fn new(function: &Function, plan: &Plan, addresses: &Addresses, tables: &[TableAt]) -> Versions {
        let mut function = function.clone();
        function.rewriter.vary();
        let Plan { live_out, hazards, homes, versioned, .. } = plan;
        let (live_out, hazards, homes, versioned) =
            (live_out.clone(), hazards.clone(), homes.clone(), versioned.clone());
        let plan = Plan { stages: Vec::new(), live_out, hazards, homes, versioned };
        let dependents = Dependents::of(&function);
        let a_loop = |(versioned, &at): (&Versioned, &TableAt)| {
            let cone = dependents.cone(&versioned.subjects);
            Loop { at, cone, seen: 0, counts: FxHashMap::default() }
        };
        let loops = plan.versioned.iter().zip(tables).map(a_loop).collect();
        Versions { function, plan, addresses: addresses.clone(), loops }
    }

    /// The version of a loop for a key.
    fn version(&mut self, index: usize, key: u64) -> Kernel {
        let Versioned { kernel, subjects, .. } = &self.plan.versioned[index];
        let mut left = key;
        let number = |&subject: &ValueId| {
            let width = self.function.cell(subject).width;
            let number = left & ((1 << width) - 1);
            left >>= width;
            (subject, number)
        };
        let numbers: Vec<(ValueId, u64)> = subjects.iter().map(number).collect();
        let mut moved = Vec::new();
        let mut known = Known::new(&mut self.function, &self.loops[index].cone, &numbers);
        let version = known.kernel(&self.plan, kernel, &mut moved);
        self.addresses.places.resize(self.function.circuit().len(), None);
        for (new, of) in moved {
            self.plan.live_out.insert(new);
            self.plan.homes.insert(new, of);
            self.addresses.places[new.index()] = self.addresses.places[of.index()];
        }
        version
    }

    /// Drops everything made since there were this many cells and sinks.
    fn forget(&mut self, cells: usize, sinks: usize) {
        let is_old = |id: &ValueId| id.index() < cells;
        self.plan.live_out.retain(is_old);
        self.plan.homes.retain(|id, _| is_old(id));
        self.addresses.places.truncate(cells);
        self.function.rewriter.truncate(cells);
        self.function.sinks.truncate(sinks);
    }
}

impl Compiled {
    /// The number of edges that are done at once, so that versions are made in between.
    pub(super) fn edges_until_versions(&self) -> u64 {
        if self.versions.is_empty() { u64::MAX } else { BETWEEN }
    }

    /// Runs a function for `count` edges, and makes versions of its loops; returns the number left because an
    /// assertion failed.
    pub(super) fn call_with_versions(&mut self, code: Code, count: u64) -> u64 {
        let mut left = count;
        while left > 0 {
            self.make_versions();
            let now = left.min(self.edges_until_versions());
            let rest = self.call(code, now);
            left -= now - rest;
            if rest > 0 {
                break;
            }
        }
        left
    }

    /// Makes versions of loops for frequent keys.
    fn make_versions(&mut self) {
        let after = self.program.passes.versions_after;
        for index in 0..self.versions.len() {
            for number in 0..self.versions[index].loops.len() {
                let often = self.versions[index].loops[number].often(&self.state, after);
                often.into_iter().for_each(|key| self.make_version(index, number, key));
            }
        }
    }

    /// Makes the version of a loop for a key, unless its entry in the table is taken.
    #[cold]
    fn make_version(&mut self, index: usize, number: usize, key: u64) {
        let versions = &mut self.versions[index];
        let table = versions.loops[number].at.table;
        let slot = (key.wrapping_mul(SPREAD as u64) >> (64 - SLOT)) as u32;
        if self.state.number(table, 2 * slot) > 0 {
            return;
        }
        let (cells, sinks) = (versions.function.circuit().len(), versions.function.sinks.len());
        let kernel = versions.version(number, key);
        let Versions { function, plan, addresses, .. } = &*versions;
        let (lanes, memories, strips) = (plan.versioned[number].lanes, &self.memories, &self.layout.strips);
        let within = Surrounded::new(&self.layout, memories, false);
        let code = self.jit.function_in(&within, |builder, state, argument| {
            Emitter::new(function, plan, addresses, memories, strips, builder, state).kernel(lanes, &kernel);
            builder.give(argument);
        });
        versions.forget(cells, sinks);
        if let Some(address) = code.address_within(STACK) {
            self.versions_made += 1;
            let entry = [(2 * slot + 1, address as u64), (2 * slot, key + 1)];
            entry.into_iter().for_each(|(at, word)| self.state.put_word(table.lane(at), 8, 64, &[word]));
        }
    }
}
