//! What executes a program: the interface that every engine has.

use std::sync::Arc;

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

    /// That two engines side by side have agreed so far, also on what follows from the inputs of this moment.
    ///
    /// # Errors
    ///
    /// They differ.
    fn agree(&mut self) -> Result<(), Box<Difference>> {
        Ok(())
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

/// A circuit at its start on an engine.
pub(crate) struct Started {
    /// The engine that runs.
    pub kind: EngineKind,
    pub engine: Box<dyn Engine>,
    /// Why it is the reference engine alone, if another one was chosen.
    pub fallback: Option<String>,
}

impl EngineKind {
    /// The circuit at its start on this engine, or on the reference engine where code cannot be generated; `refused` is
    /// a reason not to generate any.
    pub(crate) fn start(self, program: &Arc<Program>, seed: u64, refused: Option<&str>) -> Started {
        let compiled = match (self, refused) {
            (EngineKind::Reference, _) => None,
            (_, Some(reason)) => Some(Err(reason.to_owned())),
            (_, None) => Some(Compiled::new(program.clone(), seed).map_err(|unsupported| unsupported.to_string())),
        };
        let reference = || Box::new(reference::Engine::new(program.clone(), seed));
        match compiled {
            None => Started { kind: EngineKind::Reference, engine: reference(), fallback: None },
            Some(Err(reason)) => Started { kind: EngineKind::Reference, engine: reference(), fallback: Some(reason) },
            Some(Ok(engine)) => Started {
                kind: self,
                engine: match self {
                    EngineKind::Both => Box::new(Lockstep::new(program.clone(), reference(), Box::new(engine))),
                    _ => Box::new(engine),
                },
                fallback: None,
            },
        }
    }
}
