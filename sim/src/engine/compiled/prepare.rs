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
use crate::engine::program::{Kind, ValueId};

/// A function in order, and where its values are.
pub(super) struct Prepared {
    function: Function,
    plan: Plan,
    /// The steps of each function that it takes.
    pieces: Vec<Vec<Step>>,
    pub addresses: Addresses,
    /// What must hold is asked for also while edges are not to check assertions.
    pub is_always_asked: bool,
}

/// How often a function does what it does.
#[derive(Debug, Clone, Copy)]
enum Times {
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

    fn emitter<'a, 'b, 'c>(
        &'a self,
        memories: &'a [MemoryAt],
        strips: &'a Strips,
        builder: &'c mut FunctionBuilder<'b>,
        state: Value,
    ) -> Emitter<'a, 'b, 'c> {
        Emitter::new(&self.function, &self.plan, &self.addresses, memories, strips, builder, state)
    }
}

impl Compiled {
    /// Gives places to what a function computes; `given` has those of the state that it has besides the program's.
    pub(super) fn prepare(&mut self, function: &Function, given: &[Place]) -> Prepared {
        let Planned { function, plan, pieces } =
            passes::plan(function, &self.layout.strips, &self.memories, &self.program.passes, &mut |_| {});
        let state = self.places.iter().filter_map(|place| *place).chain(given.iter().copied());
        let addresses = Addresses::new(&function, &plan, state, &mut self.layout);
        self.state.grow(self.layout.size);
        for &table in &addresses.tables {
            self.fill(&function, table, addresses.places[table.index()].expect("a table has a place"));
        }
        Prepared { function, plan, pieces, addresses, is_always_asked: false }
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

    fn compile_times(&mut self, parts: &[Prepared], times: Times) -> Code {
        let memories = self.memories.as_slice();
        let (strips, unchecked, places) = (&self.layout.strips, self.unchecked, &self.places);
        let jit = &mut self.jit;
        let pieces = parts.iter().map(|part| match part.pieces.as_slice() {
            [_] => Vec::new(),
            pieces => {
                let last = pieces.len() - 1;
                let piece = |(index, steps): (usize, &Vec<Step>)| {
                    jit.function(|builder, state, _| {
                        let mut emitter = part.emitter(memories, strips, builder, state);
                        emitter.steps(steps);
                        let held = if index == last { emitter.end() } else { None };
                        let held = match held {
                            Some(held) => builder.ins().uextend(types::I64, held),
                            None => builder.ins().iconst(types::I64, 1),
                        };
                        builder.ins().return_(&[held]);
                    })
                };
                pieces.iter().enumerate().map(piece).collect()
            }
        });
        let pieces: Vec<Vec<Code>> = pieces.collect();
        let code = self.jit.function(|builder, state, count| {
            let body = builder.create_block();
            let done = builder.create_block();
            builder.append_block_param(body, types::I64);
            builder.append_block_param(done, types::I64);
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
                        changed.retain(|(state, _)| places[state.index()].is_some());
                        emitter.end()
                    }
                    pieces => {
                        let results = pieces.iter().map(|code| code.emit_call(builder, state, left));
                        let last = results.last().expect("there are pieces");
                        let holds = part.function.sinks.iter().any(|sink| matches!(sink, Sink::Hold(_)));
                        holds.then(|| builder.ins().ireduce(types::I8, last))
                    }
                };
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
        self.scratch.grow(self.jit.scratch * 8);
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
