//! What executes a program: the interface that every engine has.

use std::sync::Arc;

use tilewright_hdl::ir::Contents;

use crate::compiled::Compiled;
use crate::lockstep::{Difference, Lockstep};
use crate::program::{Program, Triggers, ValueId};
use crate::reference;

/// An assertion that does not hold.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Failed {
    /// Its index in [`Program::asserts`](crate::program::Program::asserts).
    pub assert: u32,
    /// The lane of its scope.
    pub lane: u32,
}

/// What has been done of what was asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Done {
    /// How many edges.
    pub edges: u64,
    /// What may have changed.
    pub changed: Triggers,
}

/// A running circuit.
///
/// Values are exchanged as 64-bit limbs, lane after lane, the lowest limb first, with zeros above the width.
pub(crate) trait Engine: Send {
    /// A value in all lanes, computed if it has to be.
    fn read(&mut self, id: ValueId) -> &[u64];

    /// Sets an input, all lanes of it.
    fn write(&mut self, id: ValueId, limbs: &[u64], triggers: Triggers);

    /// A word of a memory.
    fn word(&self, memory: u32, lane: u32, address: u32) -> Vec<u64>;

    /// Replaces a word of a memory.
    fn set_word(&mut self, memory: u32, lane: u32, address: u32, limbs: &[u64]);

    /// Sets a clock's reset.
    fn set_reset(&mut self, clock: usize, high: bool);

    /// The assertions that fail at an edge of these clocks.
    fn check(&mut self, rising: &[usize]) -> Vec<Failed>;

    /// So many edges of these clocks, one after another, with nothing in between; none before which an assertion fails.
    /// At an edge all of them sample, then their registers, read data and memories change.
    ///
    /// # Errors
    ///
    /// Two engines side by side differ.
    fn edges(&mut self, rising: &[usize], count: u64) -> Result<Done, Box<Difference>>;

    /// Prepares for these values being read together.
    fn watch(&mut self, _values: &[ValueId]) {}
}

/// Which engine executes a circuit. All give the same results.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum EngineKind {
    /// A plain interpreter: the meaning that the others are held to.
    Reference,
    /// Machine code made for the circuit.
    #[default]
    Compiled,
    /// Both side by side; the first difference is an error that names the signal and the clock.
    Both,
}

impl EngineKind {
    /// The circuit at its start on this engine, or on the reference engine where code cannot be generated; with a seed
    /// for each run.
    pub(crate) fn start(self, program: &Arc<Program>, seeds: &[u64]) -> (EngineKind, Box<dyn Engine>) {
        if let Some(seed) = seeds.first().filter(|&first| seeds.iter().all(|seed| seed == first)) {
            return self.start_alike(program, *seed);
        }
        let (kind, mut engine) = self.start_alike(program, 0);
        scatter(&mut *engine, program, &mut reference::Engine::seeded(program.clone(), seeds));
        (kind, engine)
    }

    fn start_alike(self, program: &Arc<Program>, seed: u64) -> (EngineKind, Box<dyn Engine>) {
        let reference = || Box::new(reference::Engine::new(program.clone(), seed));
        if self == EngineKind::Reference {
            return (self, reference());
        }
        match (self, Compiled::new(program.clone(), seed)) {
            (EngineKind::Compiled, Ok(engine)) => (self, Box::new(engine)),
            (EngineKind::Both, Ok(engine)) => {
                (self, Box::new(Lockstep::new(program.clone(), reference(), Box::new(engine))))
            }
            _ => (EngineKind::Reference, reference()),
        }
    }
}

/// Gives an engine the state of another one: registers, the data of synchronous reads, memories of unknown contents.
fn scatter(engine: &mut dyn Engine, program: &Program, from: &mut reference::Engine) {
    let registers = program.registers.iter().map(|register| register.value);
    let reads = program.memories.iter().flat_map(|memory| &memory.reads).map(|read| read.value);
    for id in registers.chain(reads) {
        engine.write(id, from.read(id), Triggers::ALL);
    }
    let unknown = (0..).zip(&program.memories).filter(|(_, memory)| memory.contents == Contents::Unknown);
    for (index, memory) in unknown {
        for lane in 0..memory.lanes {
            (0..memory.depth).for_each(|at| engine.set_word(index, lane, at, from.word(index, lane, at)));
        }
    }
}
