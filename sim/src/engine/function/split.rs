//! Splits the function of an edge, or of its assertions, into the part done at every edge and the part of each unit.
//!
//! A value that a unit takes from outside *crosses*: it is computed with the rest of the circuit, before any unit
//! changes, and stored for the unit. Everything else that a unit's registers, memories and assertions need, the unit
//! computes from its own state.

use std::collections::BTreeMap;

use rustc_hash::{FxHashMap, FxHashSet};
use tilewright_circuit::ir::Binary;

use super::{Became, Function, Sink};
use crate::engine::program::{Cell, Kind, Memory, Program, UnitId, ValueId};
use crate::engine::rewrite::{Rewriter, rebuild};

/// The unit of each state of a program.
#[derive(Debug, Default)]
pub(crate) struct Units {
    /// For each state, in sequence.
    of_state: Vec<Option<UnitId>>,
    /// For each memory.
    of_memory: Vec<Option<UnitId>>,
}

impl Units {
    /// The units of a program.
    pub fn of(program: &Program) -> Units {
        let reads = |memory: &Memory| {
            let unit = memory.unit;
            memory.reads.iter().map(move |read| (read.value, unit)).collect::<Vec<_>>()
        };
        let registers = program.registers.iter().map(|register| (register.value, register.unit));
        let known: FxHashMap<ValueId, Option<UnitId>> =
            registers.chain(program.memories.iter().flat_map(reads)).collect();
        let states = program.circuit.cells().filter(|(_, cell)| cell.kind == Kind::State);
        Units {
            of_state: states.map(|(id, _)| known.get(&id).copied().flatten()).collect(),
            of_memory: program.memories.iter().map(|memory| memory.unit).collect(),
        }
    }

    /// All units, in sequence.
    pub fn all(&self) -> Vec<UnitId> {
        let mut all: Vec<UnitId> = self.of_state.iter().chain(&self.of_memory).filter_map(|unit| *unit).collect();
        all.sort_unstable();
        all.dedup();
        all
    }

    /// The unit of a state, by its number among states.
    pub fn of_state(&self, number: usize) -> Option<UnitId> {
        self.of_state.get(number).copied().flatten()
    }

    /// The memories of a unit, or of none.
    pub fn memories(&self, unit: Option<UnitId>) -> impl Iterator<Item = usize> {
        (0..self.of_memory.len()).filter(move |&memory| self.of_memory[memory] == unit)
    }

    fn of_sink(&self, sink: &Sink) -> Option<UnitId> {
        match *sink {
            // State comes first: the program's, then the function's own.
            Sink::Register { state, .. } => self.of_state(state.index()),
            Sink::Write { memory, .. } => self.of_memory[memory as usize],
            _ => None,
        }
    }
}

/// A function that has been split.
pub(crate) struct Split {
    /// The work outside of units. It stores crossing values in states after those of the original function.
    pub outside: Function,
    /// The crossing values, as ids of the original function, with their lanes and width.
    pub taken: Vec<ValueId>,
    pub crossing: Vec<(u32, u32)>,
    pub units: Vec<Part>,
}

/// The work of a unit. Those of two units are equal if the units do the same.
pub(crate) struct Part {
    pub unit: UnitId,
    pub function: Function,
    /// The origin of each of its states.
    pub states: Vec<From>,
    /// Its memories, by index in the program.
    pub memories: Vec<u32>,
}

/// The origin of a state of a unit's function.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum From {
    /// A state of the program, by its number among states.
    Own(usize),
    /// A crossing value, by index.
    Crossing(usize),
    /// Whether all assertions of the unit pass.
    Holds,
}

/// Splits a function; `None` if it contains no work of a unit.
pub(crate) fn split(units: &Units, function: &Function) -> Option<Split> {
    let places = places(units, function);
    let mut parts: BTreeMap<UnitId, Vec<Sink>> = BTreeMap::new();
    let mut sinks = Vec::new();
    for sink in &function.sinks {
        for (unit, sink) in taken_apart(units, function, &places, sink) {
            match unit {
                None => sinks.push(sink),
                Some(unit) => parts.entry(unit).or_default().push(sink),
            }
        }
    }
    if parts.is_empty() {
        return None;
    }
    let mut cut = Cut { units, function, places, crossing: Vec::new(), known: FxHashMap::default() };
    let parts = parts.into_iter().map(|(unit, sinks)| cut.part(unit, sinks)).collect();
    let outside = outside(function, sinks, &cut.crossing);
    let shape = |id: &ValueId| (function.cell(*id).lanes, function.cell(*id).width);
    Some(Split { outside, crossing: cut.crossing.iter().map(shape).collect(), taken: cut.crossing, units: parts })
}

/// These sinks of a function, with states after its own for crossing values.
fn outside(function: &Function, sinks: Vec<Sink>, crossing: &[ValueId]) -> Function {
    let mut rewriter = function.rewriter.empty();
    let mut became = super::state(function.circuit(), &mut rewriter);
    let leave = |&next: &ValueId| {
        let Cell { lanes, width, .. } = *function.cell(next);
        Sink::Register { state: rewriter.state(lanes, width), next, enable: None }
    };
    let left: Vec<Sink> = crossing.iter().map(leave).collect();
    let mut outside = Function { rewriter, sinks: sinks.into_iter().chain(left).collect() };
    rebuild(function.circuit(), roots(&outside.sinks), &mut became, &mut outside.rewriter, Rewriter::number);
    outside.sinks.iter_mut().for_each(|sink| sink.rewrite(|operand| *operand = became[operand]));
    if let Some(all) = hold(&mut outside) {
        outside.sinks.push(Sink::ContinueIf(all));
    }
    outside
}

/// All operands of sinks.
fn roots(sinks: &[Sink]) -> Vec<ValueId> {
    let mut roots = Vec::new();
    sinks.iter().for_each(|sink| sink.for_each_operand(|operand| roots.push(operand)));
    roots
}

/// Removes the assertions from a function; returns their conjunction, if there are any.
fn hold(function: &mut Function) -> Option<ValueId> {
    let held = |sink: &mut Sink| matches!(sink, Sink::ContinueIf(_));
    let mut all = None;
    for sink in function.sinks.extract_if(.., held) {
        let Sink::ContinueIf(value) = sink else { continue };
        all = Some(all.map_or(value, |all| function.rewriter.add(Kind::Binary(Binary::And, all, value), 1, 1)));
    }
    all
}

/// A sink and its owner; assertions are split into their conjuncts.
fn taken_apart(
    units: &Units,
    function: &Function,
    places: &FxHashMap<ValueId, Place>,
    sink: &Sink,
) -> Vec<(Option<UnitId>, Sink)> {
    let &Sink::ContinueIf(all) = sink else { return vec![(units.of_sink(sink), sink.clone())] };
    let (mut open, mut parts) = (vec![all], Vec::new());
    while let Some(id) = open.pop() {
        match (&function.cell(id).kind, places[&id]) {
            (&Kind::Binary(Binary::And, a, b), _) => open.extend([b, a]),
            (_, Place::Unit(unit)) => parts.push((Some(unit), Sink::ContinueIf(id))),
            _ => parts.push((None, Sink::ContinueIf(id))),
        }
    }
    parts
}

/// The place where a value can be computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Place {
    /// It is constant.
    Anywhere,
    /// In the unit, from its own state and from crossing values.
    Unit(UnitId),
    Outside,
}

impl Place {
    /// The place for two operands.
    fn and(self, other: Place) -> Place {
        match (self, other) {
            (Place::Anywhere, place) | (place, Place::Anywhere) => place,
            (Place::Unit(a), Place::Unit(b)) if a != b => Place::Outside,
            (Place::Unit(unit), _) | (_, Place::Unit(unit)) => Place::Unit(unit),
            (Place::Outside, Place::Outside) => Place::Outside,
        }
    }
}

/// The places where the needed values of a function can be computed.
fn places(units: &Units, function: &Function) -> FxHashMap<ValueId, Place> {
    let mut places = FxHashMap::default();
    let in_unit = |unit: Option<UnitId>| unit.map_or(Place::Outside, Place::Unit);
    for id in function.needed() {
        let mut of_operands = Place::Anywhere;
        let kind = &function.cell(id).kind;
        kind.for_each_operand(|operand| of_operands = of_operands.and(places[&operand]));
        let place = match kind {
            Kind::State => in_unit(units.of_state(id.index())),
            // A memory may have changed when another part runs.
            Kind::Read { memory, .. } => match (in_unit(units.of_memory[*memory as usize]), of_operands) {
                (Place::Unit(unit), Place::Unit(other)) if unit != other => Place::Outside,
                (place, _) => place,
            },
            _ => of_operands,
        };
        places.insert(id, place);
    }
    places
}

struct Cut<'a> {
    units: &'a Units,
    function: &'a Function,
    places: FxHashMap<ValueId, Place>,
    /// Crossing values, and their indices.
    crossing: Vec<ValueId>,
    known: FxHashMap<ValueId, usize>,
}

impl Cut<'_> {
    /// The work of a unit.
    fn part(&mut self, unit: UnitId, sinks: Vec<Sink>) -> Part {
        let mut part =
            Making { rewriter: self.function.rewriter.empty(), became: Became::default(), states: Vec::new() };
        let holds = sinks.iter().any(|sink| matches!(sink, Sink::ContinueIf(_))).then(|| {
            part.states.push(From::Holds);
            part.rewriter.state(1, 1)
        });
        let (mut open, mut seen) = (Vec::new(), FxHashSet::default());
        for sink in &sinks {
            if let Sink::Register { state, .. } = *sink {
                part.state(state, self.function.cell(state), From::Own(state.index()));
            }
            sink.for_each_operand(|operand| open.push(operand));
            // Earlier ones are visited first.
            open.reverse();
            while let Some(id) = open.pop() {
                if !seen.insert(id) {
                    continue;
                }
                let cell = self.function.cell(id);
                match self.places[&id] {
                    Place::Unit(of) if of == unit && cell.kind == Kind::State => {
                        part.state(id, cell, From::Own(id.index()));
                    }
                    Place::Unit(of) if of != unit => self.cross(&mut part, id),
                    Place::Outside => self.cross(&mut part, id),
                    Place::Unit(_) | Place::Anywhere => cell.kind.for_each_operand(|operand| open.push(operand)),
                }
            }
        }
        self.made(unit, part, sinks, holds)
    }

    /// Makes a value cross.
    fn cross(&mut self, part: &mut Making, id: ValueId) {
        let cell = self.function.cell(id);
        let index = *self.known.entry(id).or_insert_with(|| {
            self.crossing.push(id);
            self.crossing.len() - 1
        });
        part.state(id, cell, From::Crossing(index));
    }

    /// The part, with everything that its sinks need; `holds` becomes 1 if all assertions pass.
    fn made(&self, unit: UnitId, part: Making, sinks: Vec<Sink>, holds: Option<ValueId>) -> Part {
        let Making { mut rewriter, mut became, states } = part;
        let mut memories = Vec::new();
        let mut number = |memory: &mut u32| {
            let known = memories.iter().position(|other| other == memory);
            *memory = known.unwrap_or_else(|| {
                memories.push(*memory);
                memories.len() - 1
            }) as u32;
        };
        let mut sinks = sinks;
        rebuild(self.function.circuit(), roots(&sinks), &mut became, &mut rewriter, |rewriter, mut cell| {
            if let Kind::Read { memory, .. } = &mut cell.kind {
                number(memory);
            }
            rewriter.number(cell)
        });
        for sink in &mut sinks {
            match sink {
                Sink::Register { state, .. } => *state = became[state],
                Sink::Write { memory, .. } => number(memory),
                _ => {}
            }
            sink.rewrite(|operand| *operand = became[operand]);
        }
        debug_assert!(memories.iter().all(|&memory| self.units.of_memory[memory as usize] == Some(unit)));
        let mut function = Function { rewriter, sinks };
        if let (Some(state), Some(next)) = (holds, hold(&mut function)) {
            function.sinks.push(Sink::Register { state, next, enable: None });
        }
        Part { unit, function, states, memories }
    }
}

/// A part under construction.
struct Making {
    rewriter: Rewriter,
    became: Became,
    states: Vec<From>,
}

impl Making {
    /// Adds a state for a value, unless there is one.
    fn state(&mut self, id: ValueId, cell: &Cell, from: From) {
        if !self.became.contains_key(&id) {
            self.became.insert(id, self.rewriter.state(cell.lanes, cell.width));
            self.states.push(from);
        }
    }
}
