//! An interpreter: it runs a circuit before there is code, and where none can be generated. It computes only what may
//! have changed, and values of up to 64 bits in loops over their lanes.
//!
//! All values are in one array of limbs in the program's sequence, so operands always precede results.

mod edge;
mod memory;
mod narrow;

use std::ops::Range;
use std::sync::Arc;

use crate::engine::program::{Cell, Kind, Program, Readers, Triggers, ValueId};
use crate::engine::semantics::{self, Number};
use crate::engine::start::{self, Beginning, State};
use crate::engine::{self, Difference, Done, Failed, Saved};
use memory::Words;

/// The state of a running circuit.
#[derive(Debug, Clone)]
pub(crate) struct Engine {
    program: Arc<Program>,
    /// Every value; [`Program::values`] has the places.
    limbs: Vec<u64>,
    memories: Vec<Words>,
    /// The changes since segments were last flagged as stale.
    pending: Triggers,
    /// For each segment: its results must be computed again before they are read.
    stale: Vec<bool>,
    /// For each value: whether it and its operands have up to 64 bits.
    narrow: Vec<bool>,
    /// For each clock: its last edge changed nothing, and nothing that it depends on has changed since.
    idle: Vec<bool>,
    plan: edge::Plan,
}

impl Engine {
    /// The circuit after a reset. State without a reset value starts from the seed of its run, or from zeros if the
    /// seed is 0.
    pub fn new(program: Arc<Program>, beginning: &Beginning) -> Engine {
        let mut limbs = vec![0; program.schedule.storage];
        for (id, cell) in program.circuit.cells() {
            if let Kind::Const(bits) = &cell.kind {
                let lanes = limbs[program.value(id).range()].chunks_exact_mut(bits.limbs().len());
                lanes.for_each(|lane| lane.copy_from_slice(bits.limbs()));
            }
        }
        let mut engine = Engine {
            limbs,
            memories: program.memories.iter().map(Words::zeros).collect(),
            pending: Triggers::NONE,
            stale: vec![true; program.schedule.segments.len()],
            narrow: program.circuit.cells().map(|(_, cell)| is_narrow(&program, cell)).collect(),
            idle: vec![false; program.clocks.len()],
            plan: edge::Plan::new(&program),
            program,
        };
        start::start(&engine.program.clone(), beginning, &mut engine);
        engine.memories.iter_mut().for_each(Words::begin);
        engine
    }

    /// The limbs of a value in all lanes, computed if necessary.
    pub fn read(&mut self, id: ValueId) -> &[u64] {
        let value = self.program.value(id);
        if let Some(segment) = value.segment {
            self.mark();
            if self.stale[segment as usize] {
                self.settle(segment);
            }
        }
        &self.limbs[value.range()]
    }

    /// Sets an input, in all its lanes.
    pub fn write(&mut self, id: ValueId, limbs: &[u64], triggers: Triggers) {
        let range = self.program.value(id).range();
        if self.limbs[range.clone()] != *limbs {
            self.limbs[range].copy_from_slice(limbs);
            self.pending = self.pending.with(triggers);
        }
    }

    /// A word of a memory.
    pub fn word(&self, memory: u32, lane: u32, address: u32) -> &[u64] {
        self.memories[memory as usize].word(lane, address)
    }

    /// Replaces a word of a memory.
    pub fn set_word(&mut self, memory: u32, lane: u32, address: u32, limbs: &[u64]) {
        self.memories[memory as usize].write(lane, address, limbs);
        let clocks = 0..self.program.clocks.len();
        self.pending = clocks.fold(self.pending, |all, clock| all.with(Triggers::state(clock)));
        self.stale.fill(true);
    }

    /// Brings an engine that is at its beginning to the present state.
    pub fn hand_over(&mut self, to: &mut dyn engine::Engine) {
        let program = self.program.clone();
        to.restore(&program, &Saved::without_words(&program, self));
        for (index, words) in (0..).zip(&self.memories) {
            words.for_each_written(|lane, address, limbs| to.set_word(index, lane, address, limbs));
        }
    }

    /// Flags what pending changes make stale.
    fn mark(&mut self) {
        if self.pending == Triggers::NONE {
            return;
        }
        for (stale, segment) in self.stale.iter_mut().zip(&self.program.schedule.segments) {
            *stale |= segment.triggers.meet(self.pending);
        }
        for (idle, clock) in self.idle.iter_mut().zip(&self.program.clocks) {
            *idle &= !clock.triggers.meet(self.pending);
        }
        self.pending = Triggers::NONE;
    }

    /// Computes a stale segment and the stale ones that it needs.
    fn settle(&mut self, segment: u32) {
        let program = self.program.clone();
        for &needed in program.schedule.segments[segment as usize].needs.iter().chain([&segment]) {
            self.refresh(needed as usize);
        }
    }

    /// Computes every stale segment of these readers.
    fn settle_for(&mut self, readers: Readers) {
        let program = self.program.clone();
        for (index, segment) in program.schedule.segments.iter().enumerate() {
            if segment.readers.meet(readers) {
                self.refresh(index);
            }
        }
    }

    fn refresh(&mut self, segment: usize) {
        if !std::mem::take(&mut self.stale[segment]) {
            return;
        }
        let program = self.program.clone();
        for id in program.schedule.segments[segment].values.clone().map(ValueId) {
            let cell = &program.circuit[id];
            match (&cell.kind, self.narrow[id.index()]) {
                (Kind::Read { memory, address }, _) => self.read_memory(id, *memory, *address),
                (_, true) => narrow::evaluate(&program, cell, id, &mut self.limbs),
                (_, false) => self.wide(&program, cell, id),
            }
        }
    }

    /// Computes a value of any width.
    fn wide(&mut self, program: &Program, cell: &Cell, id: ValueId) {
        let value = program.value(id);
        let (before, rest) = self.limbs.split_at_mut(value.offset);
        let lanes = rest[..value.range().len()].chunks_exact_mut(value.limbs());
        for (lane, out) in (0..).zip(lanes) {
            semantics::lane(cell, lane, out, |id, lane| {
                let value = program.value(id);
                let start = value.offset + lane as usize * value.limbs();
                Number { limbs: &before[start..start + value.limbs()], width: value.width }
            });
        }
    }
}

impl State for Engine {
    fn set(&mut self, id: ValueId, lanes: Range<u32>, limbs: &[u64]) {
        let value = self.program.value(id);
        let range = lanes.start as usize * limbs.len()..lanes.end as usize * limbs.len();
        self.limbs[value.range()][range].chunks_exact_mut(limbs.len()).for_each(|lane| lane.copy_from_slice(limbs));
    }

    fn set_words(&mut self, memory: u32, lanes: Range<u32>, addresses: Range<u32>, limbs: &[u64]) {
        let words = &mut self.memories[memory as usize];
        for lane in lanes {
            for address in addresses.clone() {
                words.write(lane, address, limbs);
            }
        }
    }
}

/// Whether a value and all its operands have up to 64 bits.
fn is_narrow(program: &Program, cell: &Cell) -> bool {
    let mut narrow = cell.width <= 64;
    cell.kind.for_each_operand(|operand| narrow &= program.circuit[operand].width <= 64);
    narrow
}

impl engine::Engine for Engine {
    fn read(&mut self, id: ValueId) -> &[u64] {
        self.read(id)
    }

    fn write(&mut self, id: ValueId, limbs: &[u64], triggers: Triggers) {
        self.write(id, limbs, triggers);
    }

    fn word(&self, memory: u32, lane: u32, address: u32) -> Vec<u64> {
        self.word(memory, lane, address).to_vec()
    }

    fn set_word(&mut self, memory: u32, lane: u32, address: u32, limbs: &[u64]) {
        self.set_word(memory, lane, address, limbs);
    }

    fn set_reset(&mut self, clock: usize, high: bool) {
        self.set_reset(clock, high);
    }

    fn restore(&mut self, program: &Program, saved: &Saved) {
        saved.for_each_lane(program, |id, lane, limbs| self.set(id, lane..lane + 1, limbs));
        saved.for_each_word(program, |memory, lane, address, limbs| {
            self.set_words(memory, lane..lane + 1, address..address + 1, limbs);
        });
        (self.pending, self.stale) = (Triggers::ALL, vec![true; self.stale.len()]);
    }

    fn check(&mut self, rising: &[usize]) -> Vec<Failed> {
        self.check(rising)
    }

    fn edges(&mut self, rising: &[usize], count: u64) -> Result<Done, Box<Difference>> {
        let mut done = Done { edges: 0, changed: Triggers::NONE };
        while done.edges < count && (self.program.asserts.is_empty() || self.check(rising).is_empty()) {
            done = Done { edges: done.edges + 1, changed: done.changed.with(self.edge(rising)) };
        }
        Ok(done)
    }
}
