//! What executes a program: the interface that every engine has.

use std::cell::OnceCell;
use std::ops::{Deref, DerefMut};
use std::sync::Arc;

use crate::compiled::{self, Compiled};
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

/// A word of a memory.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Word {
    /// The memory, by index.
    pub memory: u32,
    /// The lane.
    pub lane: u32,
    /// The address in it.
    pub address: u32,
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

    /// That two engines side by side have agreed so far, also on what follows from the inputs of this moment.
    ///
    /// # Errors
    ///
    /// They differ.
    fn agree(&mut self) -> Result<(), Box<Difference>> {
        Ok(())
    }

    /// Whether a value is certainly as it was when this was last asked with the same `seen`, in which an engine notes what
    /// it likes; empty the first time. Cheaper than to read it.
    fn is_as_seen(&mut self, _id: ValueId, _seen: &mut Vec<u64>) -> bool {
        false
    }

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
    /// Why this engine cannot run on this computer, if it cannot: the reference engine always can.
    pub fn refused(self) -> Option<String> {
        let needs_code = self != EngineKind::Reference;
        needs_code.then(compiled::unsupported).flatten().map(|reason| reason.to_string())
    }
}

/// An engine that is made when it is first needed: until then a simulation can be given another one for nothing.
pub(crate) struct Started {
    program: Arc<Program>,
    /// The engine that was asked for.
    chosen: EngineKind,
    /// Why no code can be generated, if it cannot.
    refused: Option<String>,
    /// Of each run.
    pub seeds: Vec<u64>,
    made: OnceCell<Box<dyn Engine>>,
}

impl Started {
    /// The circuit at its start on this engine, or on the reference engine where code cannot be generated.
    pub fn new(program: Arc<Program>, chosen: EngineKind, seeds: Vec<u64>) -> Started {
        let refused = EngineKind::Compiled.refused();
        Started { program, chosen, refused, seeds, made: OnceCell::new() }
    }

    /// The circuit at its start, with another engine or other seeds.
    pub fn again(&self, chosen: EngineKind, seeds: Vec<u64>) -> Started {
        Started { program: self.program.clone(), chosen, refused: self.refused.clone(), seeds, made: OnceCell::new() }
    }

    /// As on a machine that no code can be generated for, for that reason.
    pub fn refuse(&self, reason: &str) -> Started {
        Started { refused: Some(reason.to_owned()), ..self.again(self.chosen, self.seeds.clone()) }
    }

    /// The engine that was asked for.
    pub fn chosen(&self) -> EngineKind {
        self.chosen
    }

    /// The engine that runs.
    pub fn kind(&self) -> EngineKind {
        if self.refused.is_some() { EngineKind::Reference } else { self.chosen }
    }

    /// Why it is not the one that was asked for.
    pub fn fallback(&self) -> Option<&str> {
        self.refused.as_deref().filter(|_| self.chosen != EngineKind::Reference)
    }

    /// Puts another engine in its place.
    #[cfg(test)]
    pub fn replace(&mut self, engine: Box<dyn Engine>) {
        self.made = OnceCell::from(engine);
    }

    fn make(&self) -> Box<dyn Engine> {
        let reference = || reference::Engine::new(self.program.clone(), &self.seeds);
        let compiled = || Box::new(Compiled::new(self.program.clone(), &self.seeds).expect("it was asked before"));
        match self.kind() {
            EngineKind::Reference => Box::new(reference()),
            EngineKind::Compiled => compiled(),
            EngineKind::Both => Box::new(Lockstep::new(self.program.clone(), reference(), compiled())),
        }
    }
}

impl Deref for Started {
    type Target = dyn Engine;

    fn deref(&self) -> &Self::Target {
        &**self.made.get_or_init(|| self.make())
    }
}

impl DerefMut for Started {
    fn deref_mut(&mut self) -> &mut Self::Target {
        self.made.get_or_init(|| self.make());
        &mut **self.made.get_mut().expect("it has just been made")
    }
}
