//! Which engine runs, and one that is made when it is needed.

use std::cell::OnceCell;
use std::ops::{Deref, DerefMut};
use std::sync::Arc;

use crate::engine::Engine;
use crate::engine::compiled::{self, Compiled};
use crate::engine::lockstep::Lockstep;
use crate::engine::program::Program;
use crate::engine::reference;

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
