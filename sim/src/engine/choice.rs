//! The choice of an engine, and an engine that is created when it is first needed.

mod tiers;

use std::cell::OnceCell;
use std::ops::{Deref, DerefMut};
use std::sync::Arc;

use crate::engine::cranelift::{SharedCode, unsupported};
use crate::engine::lockstep::Lockstep;
use crate::engine::program::{Program, Triggers, ValueId};
use crate::engine::running::{Compiled, Slot};
use crate::engine::{Beginning, Engine};
use crate::engine::{interpreter, reference};
use tiers::Early;

/// The engine that executes a circuit. All engines give the same results.
///
/// ```
/// # use tilewright_sim::{EngineKind, Simulation, for_examples::Counter};
/// let mut counts = Vec::new();
/// use EngineKind::{Both, Compiled, Interpreter, Reference, Tiered};
/// for kind in [Reference, Interpreter, Compiled, Tiered, Both] {
///     let mut sim = Simulation::of(&Counter)?.on(kind);
///     sim.set(sim.i.enable, 1);
///     sim.run(100);
///     counts.push(sim.get_u64(sim.o.count));
/// }
/// assert_eq!(counts, [100; 5]);
/// # Ok::<(), tilewright_sim::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum EngineKind {
    /// The simplest one, which defines the correct results.
    Reference,
    /// An interpreter, which takes over if no code can be generated.
    Interpreter,
    /// Machine code generated for the circuit.
    Compiled,
    /// The interpreter at first, so that a circuit runs at once. Machine code takes over when the run has been as long
    /// as making it takes.
    #[default]
    Tiered,
    /// Machine code beside the reference engine; the first difference is an error that names the signal and the clock.
    Both,
}

impl EngineKind {
    /// Why this engine cannot run on this computer, if it cannot. This concerns only the engines that generate
    /// machine code.
    ///
    /// ```
    /// use tilewright_sim::EngineKind;
    ///
    /// assert_eq!(EngineKind::Interpreter.refused(), None);
    /// assert_eq!(EngineKind::Compiled.refused(), EngineKind::Both.refused());
    /// ```
    pub fn refused(self) -> Option<String> {
        self.has_code().then(unsupported).flatten().map(|reason| reason.to_string())
    }

    /// Whether the engine makes code.
    fn has_code(self) -> bool {
        matches!(self, EngineKind::Compiled | EngineKind::Tiered | EngineKind::Both)
    }
}

/// An engine that is created when it is first needed. Until then, a simulation can switch engines at no cost.
pub(crate) struct Started {
    program: Arc<Program>,
    /// The requested engine.
    chosen: EngineKind,
    /// Why no code can be generated, if it cannot.
    refused: Option<String>,
    /// What it begins with.
    pub beginning: Beginning,
    /// What simulations of the circuit share.
    code: Arc<SharedCode>,
    /// The engine, if it is the compiled one. It is stored apart from the others because a testbench calls it in
    /// every cycle, in less time than a dynamic dispatch would take.
    compiled: OnceCell<Box<Compiled>>,
    /// The engine, if it is the interpreter.
    interpreter: OnceCell<Box<interpreter::Engine>>,
    /// The engine, if it is any other one.
    other: OnceCell<Box<dyn Engine>>,
    /// How long the interpreter runs before code takes over, if it does.
    early: Early,
    /// The code's indices of values that are collected in rows, in the sequence in which they were asked for.
    rows: Vec<Option<usize>>,
}

impl Started {
    /// The circuit at its start on this engine, or on the interpreter if no code can be generated.
    pub fn new(program: Arc<Program>, chosen: EngineKind, beginning: Beginning) -> Started {
        let refused = EngineKind::Compiled.refused();
        Started::of(program, chosen, refused, beginning, Arc::default(), None)
    }

    fn of(
        program: Arc<Program>,
        chosen: EngineKind,
        refused: Option<String>,
        beginning: Beginning,
        code: Arc<SharedCode>,
        edges: Option<u64>,
    ) -> Started {
        let early = match (chosen, &refused) {
            (EngineKind::Tiered, None) => Early::of(&program, edges),
            _ => Early::default(),
        };
        let (compiled, interpreter, other) = (OnceCell::new(), OnceCell::new(), OnceCell::new());
        Started { program, chosen, refused, beginning, code, compiled, interpreter, other, early, rows: Vec::new() }
    }

    /// The circuit at its start, with another engine or another beginning.
    pub fn again(&self, chosen: EngineKind, beginning: Beginning) -> Started {
        self.anew(chosen, self.refused.clone(), beginning, self.early.given())
    }

    /// The circuit at its start, beside this one.
    pub fn another(&self) -> Started {
        self.code.share();
        self.again(self.chosen, self.beginning.clone())
    }

    /// Acts as on a machine for which no code can be generated, for the given reason.
    pub fn refuse(&self, reason: &str) -> Started {
        self.anew(self.chosen, Some(reason.to_owned()), self.beginning.clone(), None)
    }

    /// The same on two tiers, of which the second one begins after this number of edges.
    pub fn code_after(&self, edges: u64) -> Started {
        self.anew(EngineKind::Tiered, self.refused.clone(), self.beginning.clone(), Some(edges))
    }

    fn anew(&self, chosen: EngineKind, refused: Option<String>, beginning: Beginning, edges: Option<u64>) -> Started {
        Started::of(self.program.clone(), chosen, refused, beginning, self.code.clone(), edges)
    }

    /// The requested engine.
    pub fn chosen(&self) -> EngineKind {
        self.chosen
    }

    /// The engine that runs.
    pub fn kind(&self) -> EngineKind {
        if self.fallback().is_some() { EngineKind::Interpreter } else { self.chosen }
    }

    /// Why it is not the requested engine.
    pub fn fallback(&self) -> Option<&str> {
        self.refused.as_deref().filter(|_| self.chosen.has_code())
    }

    /// An edge of the only clock, if there is a fast path; returns whether there was.
    #[inline]
    pub fn quick_edge(&mut self) -> bool {
        self.compiled.get_mut().is_some_and(|engine| engine.quick_edge())
    }

    /// Sets the input in this slot, if there is a fast path; returns whether there was.
    #[inline]
    pub fn quick_set(&mut self, slot: Slot, number: u64, triggers: Triggers) -> bool {
        self.compiled.get_mut().is_some_and(|engine| engine.quick_set(slot, number, triggers))
    }

    /// The slot of a value for [`Started::quick_set`] and [`Started::quick_get`], valid as long as this engine runs.
    pub fn slot(&mut self, id: ValueId) -> Slot {
        self.compiled.get().map_or(Slot::NONE, |engine| engine.slot(id))
    }

    /// The number in this slot, if it is up to date.
    #[inline]
    pub fn quick_get(&mut self, slot: Slot) -> Option<u64> {
        self.compiled.get_mut()?.quick_get(slot)
    }

    /// Like [`Started::quick_get`], but brings the number up to date first.
    pub fn refreshed(&mut self, slot: Slot) -> Option<u64> {
        self.compiled.get_mut()?.refreshed(slot)
    }

    /// Replaces the engine.
    #[cfg(test)]
    pub fn replace(&mut self, engine: Box<dyn Engine>) {
        (self.compiled, self.interpreter) = (OnceCell::new(), OnceCell::new());
        self.other = OnceCell::from(engine);
    }

    /// Creates the engine.
    #[cold]
    fn begin(&self) {
        let program = || self.program.clone();
        let reference = || reference::Engine::new(program(), &self.beginning);
        let first = match self.kind() {
            EngineKind::Tiered if self.early.is_over() => EngineKind::Compiled,
            kind => kind,
        };
        match first {
            EngineKind::Compiled => {
                self.compiled.get_or_init(|| self.with_code());
            }
            EngineKind::Interpreter | EngineKind::Tiered => {
                self.interpreter.get_or_init(|| Box::new(interpreter::Engine::new(program(), &self.beginning)));
            }
            EngineKind::Reference => {
                self.other.get_or_init(|| Box::new(reference()));
            }
            EngineKind::Both => {
                self.other.get_or_init(|| Box::new(Lockstep::new(program(), reference(), self.with_code())));
            }
        }
    }

    fn with_code(&self) -> Box<Compiled> {
        Box::new(Compiled::new(self.program.clone(), &self.beginning, &self.code).expect("it was asked before"))
    }

    fn is_made(&self) -> bool {
        self.compiled.get().is_some() || self.interpreter.get().is_some() || self.other.get().is_some()
    }
}

impl Deref for Started {
    type Target = dyn Engine;

    fn deref(&self) -> &Self::Target {
        if !self.is_made() {
            self.begin();
        }
        match (self.compiled.get(), self.interpreter.get()) {
            (Some(code), _) => &**code,
            (None, Some(interpreter)) => &**interpreter,
            (None, None) => &**self.other.get().expect("it is made by now"),
        }
    }
}

impl DerefMut for Started {
    #[inline]
    fn deref_mut(&mut self) -> &mut Self::Target {
        if !self.is_made() {
            self.begin();
        }
        match (self.compiled.get_mut(), self.interpreter.get_mut()) {
            (Some(code), _) => &mut **code,
            (None, Some(interpreter)) => &mut **interpreter,
            (None, None) => &mut **self.other.get_mut().expect("it is made by now"),
        }
    }
}
