//! From functions to code that can be called.

use cranelift_codegen::ir::{InstBuilder, MemFlagsData, Value, types};

use super::Compiled;
use super::builder::FunctionBuilder;
use super::emitter::{self, Addresses, Emitter, MemoryAt};
use super::function::{Function, Sink};
use super::jit::Code;
use super::layout::Place;
use super::passes::{self, Planned};
use super::plan::Plan;
use super::sequence::Step;
use super::strips::Strips;
use super::units::Guard;
use super::versions::{TableAt, Versions};
use crate::engine::Passes;
use crate::engine::program::{Kind, ValueId};

/// A function in order, and where its values are.
pub(super) struct Prepared {
    function: Function,
    plan: Plan,
    /// The steps of each function that it takes.
    pieces: Vec<Vec<Step>>,
    pub addresses: Addresses,
    /// Per loop that may get versions: where they are looked up.
    versions: Vec<TableAt>,
    /// The units whose part is done after it.
    pub guards: Vec<Guard>,
    /// What must hold is asked for also while edges are not to check assertions.
    pub is_always_asked: bool,
}

/// Has all units run where another function did the last edge, as only that knows what it has seen.
fn begin(b: &mut FunctionBuilder, state: Value, (latest, number): (usize, u64), parts: &[Prepared]) {
    let (flags, latest) = (MemFlagsData::trusted(), emitter::offset(latest));
    let number = b.ins().iconst(types::I64, number as i64);
    let before = b.ins().load(types::I64, flags, state, latest);
    let other = b.ins().bxor(before, number);
    let (wakes, done) = (b.create_block(), b.create_block());
    b.ins().brif(other, wakes, &[], done, &[]);
    b.switch_to_block(wakes);
    b.ins().store(flags, number, state, latest);
    parts.iter().flat_map(|part| &part.guards).for_each(|guard| guard.emit_wake(b, state));
    b.ins().jump(done, &[]);
    b.switch_to_block(done);
}

/// How often a function does what it does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Times {
    Argument,
    Once,
}

impl Prepared {
    /// Where it leaves what it shows, in order.
    pub fn shown(&self) -> impl Iterator<Item = Place> {
        self.function.sinks.iter().filter_map(|sink| match sink {
            Sink::Show(value) => Some(self.addresses.of(*value)),
            _ => None,
        })
    }

    /// What it does.
    pub fn function(&self) -> &Function {
        &self.function
    }

    /// Whether it changes a memory, or state of the program, which has so many.
    fn changes_state(&self, states: usize) -> bool {
        !self.guards.is_empty()
            || self.function.sinks.iter().any(|sink| match sink {
                Sink::Register { state, .. } => state.index() < states,
                Sink::Write { .. } => true,
                _ => false,
            })
    }

    /// What versions of its loops are made of.
    fn to_versions(&self) -> Versions {
        Versions::new(&self.function, &self.plan, &self.addresses, &self.versions)
    }

    fn emitter<'a, 'b, 'c>(
        &'a self,
        memories: &'a [MemoryAt],
        strips: &'a Strips,
        builder: &'c mut FunctionBuilder<'b>,
        state: Value,
    ) -> Emitter<'a, 'b, 'c> {
        let emitter = Emitter::new(&self.function, &self.plan, &self.addresses, memories, strips, builder, state);
        emitter.with_versions(&self.versions)
    }
}

impl Compiled {
    /// Gives places to what a function computes; `given` has those of the state that it has besides the program's.
    pub(super) fn prepare(&mut self, function: &Function, given: &[Place]) -> Prepared {
        let state: Vec<Place> = self.places.iter().filter_map(|place| *place).chain(given.iter().copied()).collect();
        let memories = std::mem::take(&mut self.memories);
        let program = self.program.clone();
        let prepared = self.prepare_of(function, state.into_iter(), &memories, &program.passes);
        self.memories = memories;
        prepared
    }

    /// The same for a function that has this state and these memories.
    pub(super) fn prepare_of(
        &mut self,
        function: &Function,
        state: impl Iterator<Item = Place>,
        memories: &[MemoryAt],
        passes: &Passes,
    ) -> Prepared {
        let Planned { function, plan, pieces } =
            passes::plan(function, &self.layout.strips, memories, passes, &mut |_| {});
        let versions = plan.versioned.iter().map(|_| TableAt::new(&mut self.layout)).collect();
        let addresses = Addresses::new(&function, &plan, state, &mut self.layout);
        self.state.grow(self.layout.size);
        for &table in &addresses.tables {
            self.fill(&function, table, addresses.places[table.index()].expect("a table has a place"));
        }
        Prepared { function, plan, pieces, addresses, versions, guards: Vec::new(), is_always_asked: false }
    }

    /// Makes a function that does what these functions say, one after the other, so many times; it ends where something
    /// does not hold, and says how many times are left.
    pub(super) fn compile(&mut self, parts: &[Prepared]) -> Code {
        self.compile_times(parts, Times::Argument)
    }

    /// As [`Compiled::compile`], once: it must be called for one time.
    pub(super) fn compile_once(&mut self, parts: &[Prepared]) -> Code {
        self.compile_times(parts, Times::Once)
    }

    /// Makes a function of each piece; it gives what must hold. If they are a unit's, they note at `wrote` when they write to a memory, and
    /// are told how far the unit is from the first.
    pub(super) fn compile_pieces(&mut self, part: &Prepared, memories: &[MemoryAt], wrote: Option<usize>) -> Vec<Code> {
        let (strips, jit) = (&self.layout.strips, &mut self.jit);
        let last = part.pieces.len() - 1;
        let piece = |(index, steps): (usize, &Vec<Step>)| {
            jit.function(|builder, state, argument| {
                let unit = wrote.map(|wrote| (builder.ins().iadd(state, argument), wrote));
                let mut emitter = part.emitter(memories, strips, builder, state);
                if let Some((unit, wrote)) = unit {
                    emitter = emitter.of_unit(unit, wrote);
                }
                emitter.steps(steps);
                let held = if index == last { emitter.end() } else { None };
                let held = match held {
                    Some(held) => builder.ins().uextend(types::I64, held),
                    None => builder.ins().iconst(types::I64, 1),
                };
                builder.ins().return_(&[held]);
            })
        };
        part.pieces.iter().enumerate().map(piece).collect()
    }

    fn compile_times(&mut self, parts: &[Prepared], times: Times) -> Code {
        if self.program.passes.evaluated {
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
        let code = self.jit.function(|builder, state, count| {
            let body = builder.create_block();
            let done = builder.create_block();
            builder.append_block_param(body, types::I64);
            builder.append_block_param(done, types::I64);
            if let Some((latest, number)) = number {
                begin(builder, state, (latest, number), parts);
            }
            builder.ins().jump(body, &[count.into()]);
            builder.switch_to_block(body);
            let left = builder.block_params(body)[0];
            // The registers of the circuit that the part before has changed.
            let mut changed = Vec::new();
            for (part, pieces) in parts.iter().zip(&pieces) {
                let before = std::mem::take(&mut changed);
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
                        let holds = part.function.sinks.iter().any(|sink| matches!(sink, Sink::Hold(_)));
                        holds.then(|| builder.ins().ireduce(types::I8, last))
                    }
                };
                let mut held = held;
                if !part.guards.is_empty() {
                    part.guards.iter().for_each(|guard| guard.emit(builder, state));
                    Guard::emit_count(&part.guards, builder, state);
                    changed.clear();
                }
                for at in part.guards.iter().filter_map(|guard| guard.holds) {
                    let of_unit = builder.ins().load(types::I8, MemFlagsData::trusted(), state, emitter::offset(at));
                    held = Some(held.map_or(of_unit, |held| builder.ins().band(held, of_unit)));
                }
                if let Some(mut held) = held {
                    if !part.is_always_asked {
                        let at = emitter::offset(unchecked.offset);
                        let unchecked = builder.ins().load(types::I8, MemFlagsData::trusted(), state, at);
                        held = builder.ins().bor(held, unchecked);
                    }
                    let next = builder.create_block();
                    builder.ins().brif(held, next, &[], done, &[left.into()]);
                    builder.switch_to_block(next);
                }
            }
            match times {
                Times::Argument => {
                    let left = builder.ins().iadd_imm_s(left, -1);
                    builder.ins().brif(left, body, &[left.into()], done, &[left.into()]);
                }
                Times::Once => {
                    let left = builder.ins().iconst(types::I64, 0);
                    builder.ins().jump(done, &[left.into()]);
                }
            }
            builder.switch_to_block(done);
            let left = builder.block_params(done)[0];
            builder.ins().return_(&[left]);
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
        self.state.put(place, &limbs);
    }
}
