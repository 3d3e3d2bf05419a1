//! An instant at which clocks rise: everything samples, then everything changes.

use tilewright_circuit::ir::ReadUnderWrite;

use super::Engine;
use super::memory::address;
use crate::engine::Failed;
use crate::engine::program::{Program, Readers, Register, Triggers, ValueId};
use crate::engine::start;

/// Data about edges that is computed once, and their temporary memory.
#[derive(Debug, Clone)]
pub(super) struct Plan {
    /// For each register: the place where its new value waits until all have sampled; `None` if no other register can
    /// see it change.
    staged: Vec<Option<usize>>,
    /// For each clock and read port: the place where its data waits.
    reads: Vec<Vec<usize>>,
    /// For each clock: whether its edge depends on which other clocks rise.
    entangled: Vec<bool>,
    /// For each clock: its reset is high.
    resets: Vec<bool>,
    /// The waiting values.
    waiting: Vec<u64>,
}

impl Plan {
    pub fn new(program: &Program) -> Plan {
        let mut size = 0;
        let mut room = |id: ValueId| {
            let start = size;
            size += program.value(id).range().len();
            start
        };
        let is_state = |id: ValueId| program.is_state(id);
        let samples_state = |next, enable: Option<ValueId>| is_state(next) || enable.is_some_and(is_state);
        let staged = program.registers.iter();
        let staged = staged.map(|it| samples_state(it.next, it.enable).then(|| room(it.value))).collect();
        let data = |&(memory, port): &(u32, u32)| program.memories[memory as usize].reads[port as usize].value;
        let reads =
            program.clocks.iter().map(|clock| clock.reads.iter().map(|read| room(data(read))).collect()).collect();
        let entangled = (0..program.clocks.len()).map(|clock| is_entangled(program, clock as u32)).collect();
        let resets = vec![false; program.clocks.len()];
        Plan { staged, reads, entangled, resets, waiting: vec![0; size] }
    }
}

/// Whether the clock reads a memory that another clock writes, with a read that shows a write at the same instant.
fn is_entangled(program: &Program, clock: u32) -> bool {
    program.memories.iter().any(|memory| {
        memory.policy == ReadUnderWrite::Any
            && memory.reads.iter().any(|read| read.clock == clock)
            && memory.writes.iter().any(|write| write.clock != clock)
    })
}

impl Engine {
    /// Sets whether a clock's reset is active.
    pub fn set_reset(&mut self, clock: usize, high: bool) {
        self.plan.resets[clock] = high;
        self.idle[clock] = false;
        let program = self.program.clone();
        for register in program.reset_at_once(clock, high) {
            start::reset(&program, register, self);
            self.pending = self.pending.with(Triggers::state(clock));
        }
    }

    /// The assertions that fail at an edge of these clocks.
    pub fn check(&mut self, rising: &[usize]) -> Vec<Failed> {
        self.mark();
        let program = self.program.clone();
        let mut failed = Vec::new();
        for &clock in rising {
            if self.idle[clock] || self.plan.resets[clock] || program.clocks[clock].asserts.is_empty() {
                continue;
            }
            self.settle_for(Readers::edge(clock));
            for &assert in &program.clocks[clock].asserts {
                let condition = &self.limbs[program.value(program.asserts[assert as usize].condition).range()];
                let lanes = (0u32..).zip(condition).filter(|(_, holds)| **holds == 0);
                failed.extend(lanes.map(|(lane, _)| Failed { assert, lane }));
            }
        }
        failed
    }

    /// Executes the edge of these clocks: all of them sample, then their registers, read data and memories change.
    /// Returns what did.
    pub fn edge(&mut self, rising: &[usize]) -> Triggers {
        self.mark();
        if rising.iter().all(|&clock| self.idle[clock]) {
            return Triggers::NONE;
        }
        let program = self.program.clone();
        for &clock in rising {
            if !self.idle[clock] {
                self.settle_for(Readers::edge(clock));
            }
        }
        let active = rising.iter().copied().filter(|&clock| !self.idle[clock]).collect::<Vec<_>>();
        for &clock in &active {
            self.stage_reads(&program, clock, rising);
            self.stage_registers(&program, clock);
        }
        let mut changed = vec![false; active.len()];
        for (&clock, changed) in active.iter().zip(&mut changed) {
            for &(memory, port) in &program.clocks[clock].writes {
                *changed |= self.write_memory(memory, port);
            }
        }
        for (&clock, changed) in active.iter().zip(&mut changed) {
            *changed |= self.commit(&program, clock);
            self.idle[clock] = !*changed && !self.plan.entangled[clock];
            if *changed {
                self.pending = self.pending.with(Triggers::state(clock));
            }
        }
        self.pending
    }

    /// Reads every enabled synchronous port of a clock into its waiting room.
    fn stage_reads(&mut self, program: &Program, clock: usize, rising: &[usize]) {
        for (&(index, port), &room) in program.clocks[clock].reads.iter().zip(&self.plan.reads[clock]) {
            let memory = &program.memories[index as usize];
            let read = &memory.reads[port as usize];
            let (data, at) = (program.value(read.value), program.value(read.address));
            let out = &mut self.plan.waiting[room..room + data.range().len()];
            out.copy_from_slice(&self.limbs[data.range()]);
            for (lane, out) in (0u32..).zip(out.chunks_exact_mut(data.limbs())) {
                let enabled = |id: ValueId| self.limbs[program.value(id).offset + lane as usize] != 0;
                if !read.enable.is_none_or(enabled) {
                    continue;
                }
                let Some(found) = address(memory, at, &self.limbs, lane) else {
                    out.fill(0);
                    continue;
                };
                out.copy_from_slice(self.memories[index as usize].word(lane, found));
                let written = || {
                    memory.writes.iter().any(|write| {
                        rising.contains(&(write.clock as usize))
                            && enabled(write.enable)
                            && address(memory, program.value(write.address), &self.limbs, lane) == Some(found)
                    })
                };
                if memory.policy == ReadUnderWrite::Any && written() {
                    out.iter_mut().for_each(|limb| *limb = !*limb);
                    *out.last_mut().expect("a value has a limb") &= tilewright_circuit::top_mask(data.width);
                }
            }
        }
    }

    /// Computes the next values of registers that sample other state.
    fn stage_registers(&mut self, program: &Program, clock: usize) {
        for &index in &program.clocks[clock].registers {
            let Some(room) = self.plan.staged[index as usize] else { continue };
            let register = &program.registers[index as usize];
            let value = program.value(register.value);
            let out = &mut self.plan.waiting[room..room + value.range().len()];
            out.copy_from_slice(&self.limbs[value.range()]);
            let enable = register.enable.map(|id| &self.limbs[program.value(id).range()]);
            take(out, &self.limbs[program.value(register.next).range()], enable, value.limbs());
        }
    }

    /// Stores the new values of registers and read data of a clock; returns whether anything changed.
    fn commit(&mut self, program: &Program, clock: usize) -> bool {
        let mut changed = false;
        let (state, results) = self.limbs.split_at_mut(program.schedule.state_end);
        for &index in &program.clocks[clock].registers {
            let register = &program.registers[index as usize];
            let value = program.value(register.value);
            let out = &mut state[value.range()];
            let at = |id: ValueId| {
                let range = program.value(id).range();
                &results[range.start - program.schedule.state_end..range.end - program.schedule.state_end]
            };
            changed |= match (&register.reset, self.plan.staged[index as usize]) {
                (Some(_), _) if self.plan.resets[clock] => fill(out, register),
                (_, Some(room)) => replace(out, &self.plan.waiting[room..room + value.range().len()]),
                (_, None) => take(out, at(register.next), register.enable.map(at), value.limbs()),
            };
        }
        for (&(memory, port), &room) in program.clocks[clock].reads.iter().zip(&self.plan.reads[clock]) {
            let data = program.value(program.memories[memory as usize].reads[port as usize].value);
            changed |= replace(&mut state[data.range()], &self.plan.waiting[room..room + data.range().len()]);
        }
        changed
    }
}

/// Replaces the lanes of `out` by those of `next` where they are enabled; returns whether any changed.
fn take(out: &mut [u64], next: &[u64], enable: Option<&[u64]>, limbs: usize) -> bool {
    match enable {
        None => replace(out, next),
        Some(enable) if limbs == 1 => {
            let mut difference = 0;
            for ((out, next), enable) in out.iter_mut().zip(next).zip(enable) {
                let flip = (*out ^ *next) & enable.wrapping_neg();
                *out ^= flip;
                difference |= flip;
            }
            difference != 0
        }
        Some(enable) => {
            let lanes = out.chunks_exact_mut(limbs).zip(next.chunks_exact(limbs)).zip(enable);
            lanes
                .filter(|(_, enable)| **enable != 0)
                .fold(false, |changed, ((out, next), _)| replace(out, next) | changed)
        }
    }
}

/// Replaces `out` by `next`; returns whether it changed.
fn replace(out: &mut [u64], next: &[u64]) -> bool {
    let changed = out != next;
    out.copy_from_slice(next);
    changed
}

/// Resets every lane of a register; returns whether any changed.
fn fill(out: &mut [u64], register: &Register) -> bool {
    let limbs = register.reset(0).expect("it has a reset").len();
    let lanes = (0..).zip(out.chunks_exact_mut(limbs));
    lanes.fold(false, |changed, (lane, out)| replace(out, register.reset(lane).expect("it has a reset")) | changed)
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use tilewright_hdl::{Module, bits, block, def, elaborate};

    use super::*;
    use crate::engine::Beginning;
    use crate::engine::program::compile;

    block! {
        /// A running exclusive or.
        struct Toggle;
        in In { x: bits(8) }
        out Out { y: _ }
    }

    impl Toggle {
        fn build(&self, m: Module, i: In) -> Out {
            def!(y = m.reg(8).reset(0));
            y.next(y ^ i.x);
            Out { y: *y }
        }
    }

    #[test]
    fn a_clock_rests_until_something_changes() {
        let program = Arc::new(compile(&elaborate(&Toggle).unwrap(), &crate::Passes::default()));
        let mut engine = Engine::new(program.clone(), &Beginning::of(vec![0]));
        let (x, y) = (&program.inputs[0], program.outputs[0].value);
        engine.edge(&[0]);
        assert!(engine.idle[0], "nothing changed");
        engine.write(x.value, &[5], x.triggers);
        engine.edge(&[0]);
        assert_eq!((engine.idle[0], engine.read(y)[0]), (false, 5));
        engine.edge(&[0]);
        assert_eq!((engine.idle[0], engine.read(y)[0]), (false, 0), "the register feeds itself");
        engine.write(x.value, &[0], x.triggers);
        engine.edge(&[0]);
        assert!(engine.idle[0]);
        engine.set_reset(0, true);
        assert!(!engine.idle[0]);
    }
}
