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

use std::collections::BTreeSet;

use rustc_hash::FxHashMap;

use super::Compiled;
use super::branch::{self, Known};
use super::emitter::{Addresses, Emitter, offset};
use super::function::Function;
use super::layout::{Layout, Place, Surrounded};
use super::plan::{Kernel, Plan};
use super::store::Store;
use crate::engine::Passes;
use crate::engine::cranelift::Code;
use crate::engine::program::{Kind, ValueId};
use crate::engine::strips::{Comparison, Type};

/// The most bits of a key: one less than a number has, because 0 means no key.
const KEY: u32 = 63;
/// Bits of a version's index in the table.
const SLOT: u32 = 10;
/// Spreads keys over the table: odd, with ones and zeros everywhere.
const SPREAD: i64 = 0x9e37_79b9_7f4a_7c15_u64 as i64;
/// Keys that code notes before it overwrites the first.
const NOTED: u32 = 64;
/// Edges between two looks at the noted keys.
const BETWEEN: u64 = NOTED as u64;
/// The most bytes of stack that a version takes.
const STACK: usize = 16 << 10;
/// The number of different keys of a loop that are counted; then counting restarts.
const COUNTED: usize = 1 << 12;

/// A loop that may get versions.
#[derive(Debug, Clone)]
pub(super) struct Versioned {
    lanes: u32,
    /// Without branches.
    kernel: Kernel,
    /// The scalars whose numbers form the key.
    pub subjects: Vec<ValueId>,
}

/// The table of a loop's versions, by offset.
#[derive(Debug, Clone, Copy)]
pub(super) struct TableAt {
    /// Pairs of a key plus 1 and the address of code.
    table: Place,
    /// The number of noted keys, and the last of them.
    noted: Place,
}

impl TableAt {
    /// Allocates an empty table.
    pub fn new(layout: &mut Layout) -> TableAt {
        TableAt { table: layout.place(2 << SLOT, 64), noted: layout.place(1 + NOTED, 64) }
    }
}

impl Versioned {
    /// A loop that repeats `times` times; `None` if it is too small, or if one value selects alone, because a branch
    /// serves that.
    pub fn new(function: &Function, kernel: &Kernel, lanes: u32, times: usize, passes: &Passes) -> Option<Versioned> {
        let work = (kernel.cells.len() + kernel.sinks.len()) * times;
        if passes.versions_after == u32::MAX || work < passes.versions_from || !is_plain(function, kernel) {
            return None;
        }
        let subjects = subjects(function, kernel);
        (subjects.len() > 1).then(|| Versioned { lanes, kernel: kernel.clone(), subjects })
    }

    /// Stores all scalars that versions use.
    pub fn store_what_it_takes(&self, function: &Function, plan: &mut Plan) {
        let is_computed = |id: &ValueId| {
            let cell = function.cell(*id);
            cell.lanes == 1 && !matches!(cell.kind, Kind::Const(_) | Kind::State)
        };
        let singles = singles(function, &self.kernel);
        plan.live_out.extend(self.subjects.iter().chain(&singles).copied().filter(is_computed));
    }
}

/// Whether a loop leaves nothing in machine registers and uses nothing in scratch memory.
fn is_plain(function: &Function, kernel: &Kernel) -> bool {
    let is_narrow = |id: ValueId| function.cell(id).width <= 64;
    let is_plain = |id: ValueId| {
        let kind = &function.cell(id).kind;
        let mut is_plain = is_narrow(id) && !matches!(kind, Kind::Reduce { .. });
        kind.for_each_operand(|operand| is_plain &= is_narrow(operand));
        is_plain
    };
    let mut taken = true;
    kernel.sinks.iter().for_each(|&sink| function.sinks[sink].for_each_operand(|id| taken &= is_narrow(id)));
    taken && kernel.cells.iter().all(|&id| is_plain(id))
}

/// The scalars that a loop's choices depend on, those of the most choices first, as many as fit in a key.
fn subjects(function: &Function, kernel: &Kernel) -> Vec<ValueId> {
    let mut scores: Vec<(ValueId, usize)> = branch::choosing(function, kernel).into_iter().collect();
    scores.sort_by_key(|&(id, score)| (std::cmp::Reverse(score), id));
    let mut left = KEY;
    let fits = |&(id, _): &(ValueId, usize)| {
        let width = function.cell(id).width;
        let fits = width <= left;
        left -= if fits { width } else { 0 };
        fits
    };
    scores.into_iter().filter(fits).map(|(id, _)| id).collect()
}

/// The scalars that a loop uses.
fn singles(function: &Function, kernel: &Kernel) -> BTreeSet<ValueId> {
    let mut singles = BTreeSet::new();
    let mut take = |id: ValueId| {
        let of = match function.cell(id).kind {
            Kind::Broadcast { of, .. } => of,
            _ => id,
        };
        singles.insert(of);
    };
    for &id in &kernel.cells {
        take(id);
        function.cell(id).kind.for_each_operand(&mut take);
    }
    kernel.sinks.iter().for_each(|&sink| function.sinks[sink].for_each_operand(&mut take));
    singles.retain(|id| function.cell(*id).lanes == 1);
    singles
}

impl Emitter<'_, '_> {
    /// Runs the version of a loop for the present subjects, if there is one; otherwise what `other` emits.
    pub(super) fn version_or(&mut self, index: usize, other: impl FnOnce(&mut Self)) {
        let plan = self.plan;
        let TableAt { table, noted } = self.versions[index];
        let mut key = self.builder.constant(Type::I64, 0);
        let mut bits = 0;
        for &subject in &plan.versioned[index].subjects {
            self.want(subject);
            let number = self.scalars.clean(self.builder, subject)[0];
            let number = self.builder.shl_constant(number, i64::from(bits));
            key = self.builder.or(key, number);
            bits += self.function.cell(subject).width;
        }
        let spread = self.builder.constant(Type::I64, SPREAD);
        let spread = self.builder.mul(key, spread);
        let slot = self.builder.shr_constant(spread, i64::from(64 - SLOT));
        let by = self.builder.shl_constant(slot, 4);
        let entry = self.builder.add(self.state, by);
        let there = self.builder.load(Type::I64, entry, offset(table.offset));
        let sought = self.builder.add_constant(key, 1);
        let is_there = self.builder.compare(Comparison::Equal, there, sought);

        self.builder.open();
        let code = self.builder.load(Type::I64, entry, offset(table.lane(1)));
        let (state, scratch) = (self.state, self.builder.scratch());
        self.builder.call_code(code, &[state, key, scratch], STACK);
        let found = self.builder.close();

        self.builder.open();
        let count = self.builder.load(Type::I64, state, offset(noted.offset));
        let next = self.builder.add_constant(count, 1);
        self.builder.store(next, state, offset(noted.offset));
        let at = self.builder.and_constant(count, i64::from(NOTED - 1));
        let at = self.builder.shl_constant(at, 3);
        let at = self.builder.add(state, at);
        self.builder.store(key, at, offset(noted.lane(1)));
        let before = self.scalars.clone();
        other(self);
        self.scalars = before;
        let missed = self.builder.close();
        self.builder.branch(is_there, found, missed);
    }
}

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
        let order = function.needed();
        let a_loop = |(versioned, &at): (&Versioned, &TableAt)| {
            let cone = branch::cone(function.circuit(), &order, &versioned.subjects);
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
