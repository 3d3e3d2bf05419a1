//! The reference engine: the effect of a program, as plainly as possible. It computes every value whenever anything
//! has changed, lane by lane, by [`semantics`]; at an edge everything samples, then everything changes. All other
//! engines must agree with it.

mod edge;

use std::ops::Range;
use std::sync::Arc;

use tilewright_circuit::limbs_for;

use crate::engine::program::{Kind, Memory, Program, Triggers, ValueId};
use crate::engine::semantics::{self, Number};
use crate::engine::start::{self, Beginning, State};
use crate::engine::{self, Difference, Done, Failed, Saved, Word};

/// The state of a running circuit.
#[derive(Debug, Clone)]
pub(crate) struct Engine {
    program: Arc<Program>,
    /// Every value, lane by lane.
    values: Vec<Vec<u64>>,
    /// The words of every memory: lane by lane, address by address.
    memories: Vec<Vec<u64>>,
    /// For each clock: its reset is high.
    resets: Vec<bool>,
    /// Something has changed since everything was computed.
    is_stale: bool,
    /// The words that edges have written.
    written: Vec<Word>,
}

impl Engine {
    /// The circuit after a reset. State without a reset value starts from the seed of its run, or from zeros if the
    /// seed is 0.
    pub fn new(program: Arc<Program>, beginning: &Beginning) -> Engine {
        let zeros = |count: usize, width: u32| vec![0; count * limbs_for(width)];
        let mut engine = Engine {
            values: program.circuit.cells().map(|(_, cell)| zeros(cell.lanes as usize, cell.width)).collect(),
            memories: program
                .memories
                .iter()
                .map(|it| zeros(it.lanes as usize * it.depth as usize, it.width))
                .collect(),
            resets: vec![false; program.clocks.len()],
            is_stale: true,
            written: Vec::new(),
            program: program.clone(),
        };
        start::start(&program, beginning, &mut engine);
        engine
    }

    /// The words that edges have written since the last call, perhaps with repetitions.
    pub fn take_written(&mut self) -> Vec<Word> {
        std::mem::take(&mut self.written)
    }

    /// Computes every value.
    fn settle(&mut self) {
        if !std::mem::take(&mut self.is_stale) {
            return;
        }
        let program = self.program.clone();
        for (id, cell) in program.circuit.cells().filter(|(_, cell)| cell.kind != Kind::State) {
            let mut value = std::mem::take(&mut self.values[id.index()]);
            for (lane, out) in (0..).zip(value.chunks_exact_mut(limbs_for(cell.width))) {
                let word = |memory, lane, address: Number, out: &mut [u64]| {
                    out.copy_from_slice(&self.read_word(memory, lane, address));
                };
                semantics::lane_with_words(cell, lane, out, |id, lane| self.number(id, lane), word);
            }
            self.values[id.index()] = value;
        }
    }

    /// A lane of a value.
    fn number(&self, id: ValueId, lane: u32) -> Number<'_> {
        let width = self.program.circuit[id].width;
        let limbs = &self.values[id.index()][lane as usize * limbs_for(width)..][..limbs_for(width)];
        Number { limbs, width }
    }

    /// Whether a lane of a flag is 1; an absent flag is.
    fn holds(&self, flag: Option<ValueId>, lane: u32) -> bool {
        flag.is_none_or(|flag| self.number(flag, lane).limbs[0] != 0)
    }

    /// The address in a lane, if it is within the depth.
    fn address(&self, memory: u32, lane: u32, address: ValueId) -> Option<u32> {
        self.within(memory, self.number(address, lane))
    }

    /// An address of a memory, if it is within the depth.
    fn within(&self, memory: u32, address: Number) -> Option<u32> {
        let (low, high) = address.limbs.split_first().expect("a value has a limb");
        let depth = self.program.memories[memory as usize].depth;
        (high.iter().all(|&limb| limb == 0) && *low < u64::from(depth)).then_some(*low as u32)
    }

    /// The word of a lane of a memory at an address; zero beyond the depth.
    fn read_word(&self, memory: u32, lane: u32, address: Number) -> Vec<u64> {
        match self.within(memory, address) {
            Some(address) => self.memories[memory as usize][self.place(memory, lane, address)].to_vec(),
            None => vec![0; limbs_for(self.program.memories[memory as usize].width)],
        }
    }

    /// The range of a word among the limbs of its memory.
    fn place(&self, memory: u32, lane: u32, address: u32) -> Range<usize> {
        let Memory { depth, width, .. } = self.program.memories[memory as usize];
        let first = (lane as usize * depth as usize + address as usize) * limbs_for(width);
        first..first + limbs_for(width)
    }
}

impl State for Engine {
    fn set(&mut self, id: ValueId, lanes: Range<u32>, limbs: &[u64]) {
        let range = lanes.start as usize * limbs.len()..lanes.end as usize * limbs.len();
        self.values[id.index()][range].chunks_exact_mut(limbs.len()).for_each(|lane| lane.copy_from_slice(limbs));
        self.is_stale = true;
    }

    fn set_words(&mut self, memory: u32, lanes: Range<u32>, addresses: Range<u32>, limbs: &[u64]) {
        for lane in lanes {
            for address in addresses.clone() {
                engine::Engine::set_word(self, memory, lane, address, limbs);
            }
        }
    }
}

impl engine::Engine for Engine {
    fn read(&mut self, id: ValueId) -> &[u64] {
        self.settle();
        &self.values[id.index()]
    }

    fn write(&mut self, id: ValueId, limbs: &[u64], _: Triggers) {
        self.values[id.index()].copy_from_slice(limbs);
        self.is_stale = true;
    }

    fn word(&self, memory: u32, lane: u32, address: u32) -> Vec<u64> {
        self.memories[memory as usize][self.place(memory, lane, address)].to_vec()
    }

    fn set_word(&mut self, memory: u32, lane: u32, address: u32, limbs: &[u64]) {
        let place = self.place(memory, lane, address);
        self.memories[memory as usize][place].copy_from_slice(limbs);
        self.is_stale = true;
    }

    fn set_reset(&mut self, clock: usize, high: bool) {
        self.resets[clock] = high;
        let program = self.program.clone();
        for register in program.reset_at_once(clock, high) {
            start::reset(&program, register, self);
        }
    }

    fn restore(&mut self, program: &Program, saved: &Saved) {
        saved.for_each_lane(program, |id, lane, limbs| self.set(id, lane..lane + 1, limbs));
        saved.for_each_word(program, |memory, lane, address, limbs| self.set_word(memory, lane, address, limbs));
    }

    fn check(&mut self, rising: &[usize]) -> Vec<Failed> {
        self.settle();
        let mut failed = Vec::new();
        for &clock in rising.iter().filter(|&&clock| !self.resets[clock]) {
            for &assert in &self.program.clocks[clock].asserts {
                let condition = self.program.asserts[assert as usize].condition;
                let lanes = 0..self.program.circuit[condition].lanes;
                failed.extend(
                    lanes.filter(|&lane| !self.holds(Some(condition), lane)).map(|lane| Failed { assert, lane }),
                );
            }
        }
        failed
    }

    fn edges(&mut self, rising: &[usize], count: u64) -> Result<Done, Box<Difference>> {
        let mut edges = 0;
        while edges < count && self.check(rising).is_empty() {
            self.edge(rising);
            edges += 1;
        }
        Ok(Done { edges, changed: rising.iter().fold(Triggers::NONE, |all, &clock| all.with(Triggers::state(clock))) })
    }
}
