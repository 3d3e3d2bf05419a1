//! Which engine runs, and one that is made when it is needed.

use std::cell::OnceCell;
use std::ops::{Deref, DerefMut};
use std::sync::Arc;

use crate::engine::Engine;
use crate::engine::compiled::{self, Compiled, Slot};
use crate::engine::lockstep::Lockstep;
use crate::engine::program::{Program, Triggers, ValueId};
use crate::engine::{interpreter, reference};

/// Which engine executes a circuit. All give the same results.
///
/// ```
/// # use tilewright_sim::{EngineKind, Simulation, for_examples::Counter};
/// let mut counts = Vec::new();
/// for kind in [EngineKind::Reference, EngineKind::Interpreter, EngineKind::Compiled, EngineKind::Both] {
///     let mut sim = Simulation::of(&Counter)?.on(kind);
///     sim.set(sim.i.enable, 1);
///     sim.run(100);
///     counts.push(sim.get_u64(sim.o.count));
/// }
/// assert_eq!(counts, [100; 4]);
/// # Ok::<(), tilewright_sim::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum EngineKind {
    /// The plainest one: the meaning that the others are held to.
    Reference,
    /// An interpreter that takes over by itself where no code can be generated.
    Interpreter,
    /// Machine code made for the circuit.
    #[default]
    Compiled,
    /// Machine code beside the reference engine; the first difference is an error that names the signal and the clock.
    Both,
}

impl EngineKind {
    /// Why this engine cannot run on this computer, if it cannot: only those that make machine code may be unable to.
    ///
    /// ```
    /// use tilewright_sim::EngineKind;
    ///
    /// assert_eq!(EngineKind::Interpreter.refused(), None);
    /// assert_eq!(EngineKind::Compiled.refused(), EngineKind::Both.refused());
    /// ```
    pub fn refused(self) -> Option<String> {
        let needs_code = matches!(self, EngineKind::Compiled | EngineKind::Both);
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
    made: OnceCell<Made>,
}

/// An engine. The compiled one is told from the others: what a testbench asks of it in every cycle is done in less time
/// than it takes to find out at run time which engine it is.
enum Made {
    Compiled(Box<Compiled>),
    Other(Box<dyn Engine>),
}

impl Made {
    #[inline]
    fn engine(&mut self) -> &mut (dyn Engine + 'static) {
        match self {
            Made::Compiled(engine) => &mut **engine,
            Made::Other(engine) => &mut **engine,
        }
    }
}

impl Started {
    /// The circuit at its start on this engine, or on the interpreter where code cannot be generated.
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
        if self.fallback().is_some() { EngineKind::Interpreter } else { self.chosen }
    }

    /// Why it is not the one that was asked for.
    pub fn fallback(&self) -> Option<&str> {
        let needs_code = matches!(self.chosen, EngineKind::Compiled | EngineKind::Both);
        self.refused.as_deref().filter(|_| needs_code)
    }

    /// An edge of the only clock, if that is quickly done; whether it was.
    #[inline]
    pub fn quick_edge(&mut self) -> bool {
        match self.made.get_mut() {
            Some(Made::Compiled(engine)) => engine.quick_edge(),
            _ => false,
        }
    }

    /// Sets an input that stands in that slot, if that is quickly done; whether it was.
    #[inline]
    pub fn quick_set(&mut self, slot: Slot, number: u64, triggers: Triggers) -> bool {
        match self.made.get_mut() {
            Some(Made::Compiled(engine)) => engine.quick_set(slot, number, triggers),
            _ => false,
        }
    }

    /// Where an input stands for [`Started::quick_set`], as long as this engine runs.
    pub fn slot(&mut self, id: ValueId) -> Slot {
        match self.made.get_mut() {
            Some(Made::Compiled(engine)) => engine.slot(id),
            _ => Slot::NONE,
        }
    }

    /// A number of one lane, if it stands somewhere as it is now.
    #[inline]
    pub fn quick_get(&mut self, id: ValueId) -> Option<u64> {
        match self.made.get_mut() {
            Some(Made::Compiled(engine)) => engine.quick_get(id),
            _ => None,
        }
    }

    /// Puts another engine in its place.
    #[cfg(test)]
    pub fn replace(&mut self, engine: Box<dyn Engine>) {
        self.made = OnceCell::from(Made::Other(engine));
    }

    #[cold]
    fn begin(&mut self) {
        self.made = OnceCell::from(self.make());
    }

    fn make(&self) -> Made {
        let reference = || reference::Engine::new(self.program.clone(), &self.seeds);
        let compiled = || Box::new(Compiled::new(self.program.clone(), &self.seeds).expect("it was asked before"));
        match self.kind() {
            EngineKind::Reference => Made::Other(Box::new(reference())),
            EngineKind::Interpreter => {
                Made::Other(Box::new(interpreter::Engine::new(self.program.clone(), &self.seeds)))
            }
            EngineKind::Compiled => Made::Compiled(compiled()),
            EngineKind::Both => Made::Other(Box::new(Lockstep::new(self.program.clone(), reference(), compiled()))),
        }
    }
}

impl Deref for Started {
    type Target = dyn Engine;

    fn deref(&self) -> &Self::Target {
        match self.made.get_or_init(|| self.make()) {
            Made::Compiled(engine) => &**engine,
            Made::Other(engine) => &**engine,
        }
    }
}

impl DerefMut for Started {
    #[inline]
    fn deref_mut(&mut self) -> &mut Self::Target {
        if self.made.get().is_none() {
            self.begin();
        }
        self.made.get_mut().expect("it is made by now").engine()
    }
}
