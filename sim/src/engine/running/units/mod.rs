//! Skips units that have nothing to do.
//!
//! The instances of an array that are arrays themselves run one by one, as *units*
//! ([`Passes::apart_from`](crate::engine::Passes::apart_from)). The function of an edge does the work outside of
//! units and stores what crosses into each. Then it runs the units whose crossing values differ from the last edge,
//! and those that changed something then. Each other unit costs a comparison of a few limbs and a branch. Identical
//! units share code, which finds the state of each at a fixed distance from that of the first.

mod run;

use std::cell::Cell;
use std::collections::BTreeMap;

use super::Compiled;
use super::prepare::Prepared;
use crate::engine::Passes;
use crate::engine::cranelift::Code;
use crate::engine::emit::offset;
use crate::engine::function::split::{From, Part, Split, Units, split};
use crate::engine::function::{Function, Sink};
use crate::engine::layout::memory_at::MemoryAt;
use crate::engine::layout::span::{Span, span};
use crate::engine::layout::{Layout, Place};
use crate::engine::program::{Kind, Program, UnitId, ValueId};
use crate::engine::strips::{Builder, Region, Type, Value};
use run::{Changes, Crossing, Running, Task};

/// The most limbs that are compared to see whether a unit's crossing values are unchanged.
const COMPARED: usize = 64;

/// The units of a running circuit.
pub(crate) struct Apart {
    /// The units.
    units: Units,
    /// For each unit, the places of its memories' addresses and of the count of its runs.
    tables: BTreeMap<UnitId, (Place, Place)>,
    /// The place of the number of the function that executed the last edge: each function knows only what it has seen
    /// of the units itself.
    latest: Place,
    /// The place where code notes a write to a memory.
    wrote: Place,
    /// The place of two counts: edges of all units, and edges at which they were run.
    edges: Place,
    runs: Place,
    /// The number of functions.
    functions: u64,
    #[expect(clippy::vec_box, reason = "code has the address of each, which stays as more are added")]
    running: Vec<Box<Running>>,
}

/// A unit in a function: the data that code checks to decide whether it has something to do.
pub(super) struct Guard {
    /// The places of the crossing values and of their earlier copies.
    crossing: Vec<(Span, usize)>,
    busy: usize,
    /// The place of the result of its assertions.
    pub holds: Option<usize>,
    /// The place where its edges are counted, if the function is for them.
    edges: Option<usize>,
    /// The address of the data that runs it.
    running: usize,
    /// The code, for its stack size.
    code: Vec<Code>,
}

/// A function that units of one kind share.
struct Shared {
    part: Part,
    /// Where its state is.
    places: Vec<Place>,
    memories: Vec<MemoryAt>,
    code: Vec<Code>,
}

/// Gives places to the state of a program: each unit's after that of the previous one, in the same sequence.
pub(crate) fn places(program: &Program, layout: &mut Layout) -> (Vec<Option<Place>>, Option<Apart>) {
    let units = Units::of(program);
    let all = units.all();
    let mut places = vec![None; program.circuit.len()];
    let states = || program.circuit.cells().filter(|(_, cell)| cell.kind == Kind::State);
    let mut place = |layout: &mut Layout, unit: Option<UnitId>| {
        for (number, (id, cell)) in states().enumerate() {
            if units.of_state(number) == unit {
                places[id.index()] = Some(layout.place(cell.lanes, cell.width));
            }
        }
    };
    place(layout, None);
    let mut tables = BTreeMap::new();
    for &unit in &all {
        layout.align();
        let memories = units.memories(Some(unit)).count().max(1) as u32;
        tables.insert(unit, (layout.place(1, 64 * memories), layout.place(1, 64)));
        place(layout, Some(unit));
    }
    if all.is_empty() {
        return (places, None);
    }
    layout.align();
    let [latest, wrote, edges, runs] = [(); 4].map(|()| layout.place(1, 64));
    (places, Some(Apart { units, tables, latest, wrote, edges, runs, functions: 0, running: Vec::new() }))
}

impl Compiled {
    /// Writes the addresses of the memories that code looks up, and of the units'.
    pub(super) fn tell_memories(&mut self) {
        for memory in &self.memories {
            if let Some(at) = memory.table {
                self.state.put_word(at, 8, 64, &[memory.address as u64]);
            }
        }
        let Some(apart) = &self.apart else { return };
        for (&unit, &(table, _)) in &apart.tables {
            let addresses: Vec<u64> =
                apart.units.memories(Some(unit)).map(|memory| self.memories[memory].address as u64).collect();
            if !addresses.is_empty() {
                self.state.put(table, &addresses);
            }
        }
    }

    /// The number of edges at which units were skipped.
    pub(super) fn edges_left_out(&self) -> u64 {
        let edges = |apart: &Apart| self.state.number(apart.edges, 0) - self.state.number(apart.runs, 0);
        self.apart.as_ref().map_or(0, edges)
    }

    /// The state has changed otherwise than at an edge: all units have something to do.
    pub(super) fn wake(&mut self) {
        if let Some(apart) = &self.apart {
            self.state.put(apart.latest, &[0]);
            for &(_, version) in apart.tables.values() {
                self.state.put(version, &[self.state.number(version, 0) + 1]);
            }
        }
    }

    /// Like [`Compiled::prepare`], for an edge or its assertions, with its units guarded.
    pub(super) fn prepare_edge(&mut self, function: &Function, given: &[Place]) -> Prepared {
        let cut = self.apart.as_ref().and_then(|apart| split(&apart.units, function));
        let Some(Split { outside, crossing, units, .. }) = cut else { return self.prepare(function, given) };
        let now: Vec<Place> = crossing.iter().map(|&(lanes, width)| self.layout.place(lanes, width)).collect();
        let given: Vec<Place> = given.iter().chain(&now).copied().collect();
        let mut prepared = self.prepare(&outside, &given);
        let mut shared = Vec::new();
        for part in units {
            prepared.guards.push(self.guard(part, &now, &mut shared));
        }
        self.state.grow(self.layout.size);
        prepared
    }

    /// The guard of a unit; its code is shared with units that do the same.
    fn guard(&mut self, part: Part, now: &[Place], shared: &mut Vec<Shared>) -> Guard {
        let (own, memories) = (self.places_of(&part), self.memories_of(&part));
        let found = shared.iter().find_map(|shared| Some((shared, shared.distance(&part, &own, &memories)?)));
        let is_new = found.is_none();
        let (code, taken, distance) = match found {
            Some((shared, distance)) => (shared.code.clone(), shared.places.clone(), distance),
            None => {
                let places = self.places_to_take(&own, &part, now);
                let code = self.compile_unit(&part.function, &places, &memories);
                (code, places, 0)
            }
        };
        let mut running = self.running(&part, code, distance);
        for (from, &taken) in part.states.iter().zip(&taken) {
            match *from {
                From::Crossing(index) => running.crossing.push(self.crossing(now[index], taken)),
                From::Holds => running.task = Task::Check(taken.offset, self.layout.place(1, 64).offset),
                From::Own(_) => {}
            }
        }
        running.always = running.crossing.iter().map(|it| it.now.limbs).sum::<usize>() > COMPARED;
        let holds = match &mut running.task {
            Task::Edge(_) => None,
            &mut Task::Check(_, holds) => {
                // The checked values are its own state too.
                let version = Place { offset: running.version, element: 64, lanes: 1, width: 64, moves: false };
                let aside = self.layout.place(1, 64);
                running.crossing.push(self.crossing(version, aside));
                Some(holds)
            }
        };
        let edges = self.apart.as_ref().expect("there are units").edges.offset;
        let compared = running.crossing.iter().map(|it| (it.now, it.last)).collect();
        let guard = Guard {
            crossing: if running.always { Vec::new() } else { compared },
            busy: running.busy,
            holds,
            edges: holds.is_none().then_some(edges),
            running: &raw const *running as usize,
            code: running.code.clone(),
        };
        if is_new {
            shared.push(Shared { part, places: taken, memories, code: guard.code.clone() });
        }
        self.apart.as_mut().expect("there are units").running.push(running);
        guard
    }

    /// The data that runs a unit for an edge, without crossing values.
    fn running(&mut self, part: &Part, code: Vec<Code>, distance: u64) -> Box<Running> {
        let states: Vec<Place> = self.places.iter().flatten().copied().collect();
        let own = changed(&part.function).filter_map(|state| match part.states[state.index()] {
            From::Own(number) => Some(states[number]),
            _ => None,
        });
        let (single, lanes): (Vec<Place>, Vec<Place>) = own.partition(|place| place.lanes == 1);
        let [single, lanes] = [single, lanes].map(|places| joined(places.into_iter().map(span).collect()));
        let limbs: usize = single.iter().chain(&lanes).map(|span| span.limbs).sum();
        let busy = self.layout.place(1, 64).offset;
        let apart = self.apart.as_ref().expect("there are units");
        let (patience, all, kept) = (Cell::new(1), Cell::new(false), vec![Cell::new(0); limbs]);
        let (wrote, runs) = (apart.wrote.offset, apart.runs.offset);
        let changes = Changes { single, lanes, wrote, runs, patience, all, kept };
        let version = apart.tables[&part.unit].1.offset;
        let (crossing, task) = (Vec::new(), Task::Edge(changes));
        Box::new(Running { crossing, code, distance, busy, version, always: false, task })
    }

    /// A crossing value of a unit.
    fn crossing(&mut self, now: Place, taken: Place) -> Crossing {
        let now = span(now);
        let last = self.layout.place(1, 64 * now.limbs as u32).offset;
        Crossing { now, last, taken: taken.offset }
    }

    /// The places of the own state of a unit's function.
    fn places_of(&self, part: &Part) -> Vec<Option<Place>> {
        let states: Vec<Place> = self.places.iter().filter_map(|place| *place).collect();
        let place = |from: &From| match *from {
            From::Own(number) => Some(Place { moves: true, ..states[number] }),
            From::Crossing(_) | From::Holds => None,
        };
        part.states.iter().map(place).collect()
    }

    /// The same, and the places of its crossing values.
    fn places_to_take(&mut self, own: &[Option<Place>], part: &Part, now: &[Place]) -> Vec<Place> {
        let layout = &mut self.layout;
        let place = |(own, from): (&Option<Place>, &From)| match (*own, *from) {
            (Some(own), _) => own,
            (None, From::Crossing(index)) => layout.place(now[index].lanes, now[index].width),
            (None, From::Holds) => layout.place(1, 1),
            (None, From::Own(_)) => unreachable!("it has a place"),
        };
        own.iter().zip(&part.states).map(place).collect()
    }

    /// The memories of a unit's function, whose addresses are in its table.
    fn memories_of(&self, part: &Part) -> Vec<MemoryAt> {
        let apart = self.apart.as_ref().expect("there are units");
        let (table, _) = apart.tables[&part.unit];
        let at = |&memory: &u32| {
            let number = apart.units.memories(Some(part.unit)).position(|other| other == memory as usize);
            let number = number.expect("it is one of the unit's");
            MemoryAt { table: Some(table.offset + 8 * number), ..self.memories[memory as usize] }
        };
        part.memories.iter().map(at).collect()
    }

    /// Code for a unit.
    fn compile_unit(&mut self, function: &Function, places: &[Place], memories: &[MemoryAt]) -> Vec<Code> {
        // The code is shared by identical units, so it cannot look up versions in a table of its own.
        let passes = Passes { versions_after: u32::MAX, ..self.program.passes.clone() };
        let prepared = self.prepare_of(function, places.iter().copied(), memories, &passes);
        let wrote = self.apart.as_ref().expect("there are units").wrote.offset;
        self.compile_pieces(&prepared, memories, Some(wrote))
    }

    /// A number for a function that executes edges.
    pub(super) fn number_function(&mut self) -> Option<(usize, u64)> {
        let apart = self.apart.as_mut()?;
        apart.functions += 1;
        Some((apart.latest.offset, apart.functions))
    }
}

impl Shared {
    /// The distance of a unit from the first one, if the two are identical and all of it is at that distance.
    fn distance(&self, part: &Part, own: &[Option<Place>], memories: &[MemoryAt]) -> Option<u64> {
        let is_same = self.part.function.is_same(&part.function) && self.places.len() == own.len();
        if !is_same || self.memories.len() != memories.len() {
            return None;
        }
        let mut distance = None;
        let mut is_as_far = |first: usize, other: usize| {
            let by = other.wrapping_sub(first);
            *distance.get_or_insert(by) == by
        };
        for (first, own) in self.places.iter().zip(own) {
            let fits = match own {
                None => !first.moves,
                Some(own) => Place { offset: first.offset, ..*own } == *first && is_as_far(first.offset, own.offset),
            };
            if !fits {
                return None;
            }
        }
        for (first, other) in self.memories.iter().zip(memories) {
            let (of_first, of_other) = (first.table?, other.table?);
            let alike =
                MemoryAt { bank: first.bank, first: first.first, address: first.address, table: first.table, ..*other };
            if alike != *first || !is_as_far(of_first, of_other) {
                return None;
            }
        }
        Some(distance.unwrap_or(0) as u64)
    }
}

impl Guard {
    /// Runs the unit, unless it has nothing to do.
    pub fn emit(&self, b: &mut Builder, state: Value) {
        let mut other = b.load(Type::I64, state, offset(self.busy));
        for &(now, last) in &self.crossing {
            for (limb, (at, mask)) in now.limbs().enumerate() {
                let [now, last] = [at, last + 8 * limb].map(|at| b.load(Type::I64, state, offset(at)));
                let mut differs = b.xor(now, last);
                if mask != u64::MAX {
                    differs = b.and_constant(differs, mask as i64);
                }
                other = b.or(other, differs);
            }
        }
        b.open();
        let (unit, scratch) = (b.address(self.running), b.scratch());
        self.code.iter().for_each(|code| code.is_called(b));
        b.call_only(run::run as *const () as usize, &[state, unit, scratch]);
        let runs = b.close();
        b.branch(other, runs, Region::new());
    }

    /// Counts an edge of each of these units.
    pub fn emit_count(guards: &[Guard], b: &mut Builder, state: Value) {
        let Some(at) = guards.iter().find_map(|guard| guard.edges) else { return };
        let at = offset(at);
        let before = b.load(Type::I64, state, at);
        let after = b.add_constant(before, guards.len() as i64);
        b.store(after, state, at);
    }

    /// Assumes that the unit has something to do.
    pub fn emit_wake(&self, b: &mut Builder, state: Value) {
        let one = b.constant(Type::I64, 1);
        b.store(one, state, offset(self.busy));
    }
}

/// Joins adjacent spans.
fn joined(spans: Vec<Span>) -> Vec<Span> {
    let mut spans = spans;
    spans.sort_by_key(|span| span.offset);
    let mut joined: Vec<Span> = Vec::new();
    for span in spans {
        match joined.last_mut() {
            Some(last) if last.mask == u64::MAX && last.offset + 8 * last.limbs == span.offset => {
                last.limbs += span.limbs;
                last.mask = span.mask;
            }
            _ => joined.push(span),
        }
    }
    joined
}

/// The states that a function changes.
fn changed(function: &Function) -> impl Iterator<Item = ValueId> {
    function.sinks.iter().filter_map(|sink| match sink {
        Sink::Register { state, .. } => Some(*state),
        _ => None,
    })
}
