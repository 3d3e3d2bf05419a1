//! From functions to callable code.

use super::Compiled;
use super::units::Guard;
use super::versions::Versions;
use crate::engine::cranelift::Code;
use crate::engine::emit::versions::TableAt;
use crate::engine::emit::{Addresses, Emitter, offset};
use crate::engine::function::{Function, Sink};
use crate::engine::layout::memory_at::MemoryAt;
use crate::engine::layout::store::is_mask;
use crate::engine::layout::strip_sizes::StripSizes;
use crate::engine::layout::{Place, Surrounded};
use crate::engine::plan::Plan;
use crate::engine::plan::planned::{self, Planned};
use crate::engine::plan::sequence::Step;
use crate::engine::program::{Kind, ValueId};
use crate::engine::strips::{Builder, Loop, Region, Type, Value};
use crate::engine::{Passes, Target};

/// A function in sequence, and the places of its values.
pub(super) struct Prepared {
    function: Function,
    plan: Plan,
    /// The steps of each generated function.
    pieces: Vec<Vec<Step>>,
    pub addresses: Addresses,
    /// For each loop that may get versions: the table in which to look them up.
    versions: Vec<TableAt>,
    /// The units that run after it.
    pub guards: Vec<Guard>,
    /// Its assertions are checked even while edges do not check them.
    pub is_always_asked: bool,
}

/// Makes all units run if another function executed the last edge, because only that one knows what it has seen.
fn begin(b: &mut Builder, state: Value, (latest, number): (usize, u64), parts: &[Prepared]) {
    let latest = offset(latest);
    let number = b.constant(Type::I64, number as i64);
    let before = b.load(Type::I64, state, latest);
    let other = b.xor(before, number);
    b.open();
    b.store(number, state, latest);
    parts.iter().flat_map(|part| &part.guards).for_each(|guard| guard.emit_wake(b, state));
    let wakes = b.close();
    b.branch(other, wakes, Region::new());
}

/// The number of times that a function repeats.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Times {
    Argument,
    Once,
}

impl Prepared {
    /// The places of the values that it shows, in sequence.
    pub fn shown(&self) -> impl Iterator<Item = Place> {
        self.function.sinks.iter().filter_map(|sink| match sink {
            Sink::Show(value) => Some(self.addresses.of(*value)),
            _ => None,
        })
    }

    /// The function.
    pub fn function(&self) -> &Function {
        &self.function
    }

    /// Whether it changes a memory, or one of the program's states, of which there are `states`.
    fn changes_state(&self, states: usize) -> bool {
        !self.guards.is_empty()
            || self.function.sinks.iter().any(|sink| match sink {
                Sink::Register { state, .. } => state.index() < states,
                Sink::Write { .. } => true,
                _ => false,
            })
    }

    /// The data from which versions of its loops are made.
    fn to_versions(&self) -> Versions {
        Versions::new(&self.function, &self.plan, &self.addresses, &self.versions)
    }

    fn emitter<'a, 'b>(
        &'a self,
        memories: &'a [MemoryAt],
        strips: &'a StripSizes,
        builder: &'b mut Builder,
        state: Value,
    ) -> Emitter<'a, 'b> {
        let emitter = Emitter::new(&self.function, &self.plan, &self.addresses, memories, strips, builder, state);
        emitter.with_versions(&self.versions)
    }
}

impl Compiled {
    /// Gives places to the values of a function; `given` has the places of its state besides the program's.
    pub(super) fn prepare(&mut self, function: &Function, given: &[Place]) -> Prepared {
        let state: Vec<Place> = self.places.iter().filter_map(|place| *place).chain(given.iter().copied()).collect();
        let memories = std::mem::take(&mut self.memories);
        let program = self.program.clone();
        let prepared = self.prepare_of(function, state.into_iter(), &memories, &program.passes);
        self.memories = memories;
        prepared
    }

    /// The same for a function with this state and these memories.
    pub(super) fn prepare_of(
        &mut self,
        function: &Function,
        state: impl Iterator<Item = Place>,
        memories: &[MemoryAt],
        passes: &Passes,
    ) -> Prepared {
        let Planned { function, plan, pieces } =
            planned::plan(function, &self.layout.strips, memories, passes, &mut |_| {});
        let versions = plan.versioned.iter().map(|_| TableAt::new(&mut self.layout)).collect();
        let addresses = Addresses::new(&function, &plan, state, &mut self.layout);
        self.state.grow(self.layout.size);
        for &table in &addresses.tables {
            self.fill(&function, table, addresses.places[table.index()].expect("a table has a place"));
        }
        Prepared { function, plan, pieces, addresses, versions, guards: Vec::new(), is_always_asked: false }
    }

    /// Makes a function that executes these functions, one after another, the given number of times. It ends when an
    /// assertion fails, and returns the number of times left.
    pub(super) fn compile(&mut self, parts: &[Prepared]) -> Code {
        self.compile_times(parts, Times::Argument)
    }

    /// Like [`Compiled::compile`], for one time: it must be called with a count of one.
    pub(super) fn compile_once(&mut self, parts: &[Prepared]) -> Code {
        self.compile_times(parts, Times::Once)
    }

    /// Makes a function of each piece; it returns the condition of the assertions. The pieces of a unit note writes
    /// to memories at `wrote`, and get the unit's distance from the first.
    pub(super) fn compile_pieces(&mut self, part: &Prepared, memories: &[MemoryAt], wrote: Option<usize>) -> Vec<Code> {
        let (strips, jit) = (&self.layout.strips, &mut self.jit);
        let within = Surrounded::new(&self.layout, memories, wrote.is_some());
        let last = part.pieces.len() - 1;
        let emit = |index: usize, steps: &[Step], builder: &mut Builder, state: Value, argument: Value| {
            let unit = wrote.map(|wrote| (builder.add(state, argument), wrote));
            let mut emitter = part.emitter(memories, strips, builder, state);
            if let Some((unit, wrote)) = unit {
                emitter = emitter.of_unit(unit, wrote);
            }
            emitter.steps(steps);
            let held = if index == last { emitter.end() } else { None };
            let held = match held {
                Some(held) => builder.zero_extend(Type::I64, held),
                None => builder.constant(Type::I64, 1),
            };
            builder.give(held);
        };
        let pieces = part.pieces.iter().enumerate();
        let emit = &emit;
        jit.functions_in(&within, pieces.map(|(index, steps)| move |b: &mut Builder, s, a| emit(index, steps, b, s, a)))
    }

    fn compile_times(&mut self, parts: &[Prepared], times: Times) -> Code {
        if self.program.passes.target == Target::Functions {
            return self.evaluate(parts, times);
        }
        let memories = std::mem::take(&mut self.memories);
        let pieces = parts.iter().map(|part| match part.pieces.as_slice() {
            [_] => Vec::new(),
            _ => self.compile_pieces(part, &memories, None),
        });
        let pieces: Vec<Vec<Code>> = pieces.collect();
        let states = self.places.iter().flatten().count();
        let does_edges = parts.iter().any(|part| part.changes_state(states));
        let number = if does_edges { self.number_function() } else { None };
        let memories = memories.as_slice();
        let (strips, unchecked) = (&self.layout.strips, self.unchecked);
        let within = Surrounded::new(&self.layout, memories, false);
        let code = self.jit.function_in(&within, |builder, state, count| {
            if let Some((latest, number)) = number {
                begin(builder, state, (latest, number), parts);
            }
            let [left, result] = [(); 2].map(|()| builder.parameter(Type::I64));
            builder.open();
            // The registers that the previous part has changed.
            let mut changed = Vec::new();
            for (part, pieces) in parts.iter().zip(&pieces) {
                let before = std::mem::take(&mut changed);
                builder.then();
                let held = match pieces.as_slice() {
                    [] => {
                        let mut emitter = part.emitter(memories, strips, builder, state);
                        before.into_iter().for_each(|(state, scalar)| emitter.scalars.define(state, scalar));
                        emitter.steps(&part.pieces[0]);
                        changed = emitter.changed();
                        changed.retain(|(state, _)| state.index() < states);
                        emitter.end()
                    }
                    pieces => {
                        let results = pieces.iter().map(|code| code.emit_call(builder, state, left));
                        let last = results.last().expect("there are pieces");
                        let holds = part.function.sinks.iter().any(|sink| matches!(sink, Sink::ContinueIf(_)));
                        holds.then(|| builder.truncate(Type::I8, last))
                    }
                };
                let mut held = held;
                if !part.guards.is_empty() {
                    part.guards.iter().for_each(|guard| guard.emit(builder, state));
                    Guard::emit_count(&part.guards, builder, state);
                    changed.clear();
                }
                for at in part.guards.iter().filter_map(|guard| guard.holds) {
                    let of_unit = builder.load(Type::I8, state, offset(at));
                    held = Some(held.map_or(of_unit, |held| builder.and(held, of_unit)));
                }
                if let Some(mut held) = held {
                    if !part.is_always_asked {
                        let at = offset(unchecked.offset);
                        let unchecked = builder.load(Type::I8, state, at);
                        held = builder.or(held, unchecked);
                    }
                    builder.leave_unless(held, &[left]);
                }
            }
            let parameters = vec![left];
            let (end, again) = match times {
                Times::Argument => {
                    let left = builder.add_constant(left, -1);
                    (left, Some((left, vec![left])))
                }
                Times::Once => (builder.constant(Type::I64, 0), None),
            };
            let (start, body, end, results) = (vec![count], builder.close(), vec![end], vec![result]);
            builder.repeat(Loop { parameters, start, body, again, end, results });
            builder.give(result);
        });
        self.memories = memories.to_vec();
        self.scratch.grow(self.jit.scratch * 8);
        let versioned = parts.iter().filter(|part| !part.versions.is_empty());
        self.versions.extend(versioned.map(Prepared::to_versions));
        code
    }

    /// Writes an array of constants into the memory.
    fn fill(&mut self, function: &Function, table: ValueId, place: Place) {
        let Kind::Stack { parts, .. } = &function.cell(table).kind else { unreachable!("a table is made of parts") };
        let limbs: Vec<u64> = (0..place.lanes as usize)
            .flat_map(|lane| match &function.cell(parts[lane % parts.len()]).kind {
                Kind::Const(bits) => bits.limbs().to_vec(),
                _ => unreachable!("a table is made of constants"),
            })
            .collect();
        if place.width <= 64 && !is_mask(place.bytes(), place.width) {
            self.layout.limit(place, limbs.iter().copied().max().unwrap_or(0));
        }
        self.state.put(place, &limbs);
    }
}
