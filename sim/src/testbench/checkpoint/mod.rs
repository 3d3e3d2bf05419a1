//! The state of a simulation at one time: saved, restored, compared, and kept in a file.

mod file;

use std::fmt;
use std::sync::Arc;

use rustc_hash::FxHashMap;
use tilewright_circuit::Bits;
use tilewright_circuit::ir::Shape;
use tilewright_hdl::Bundle;

use crate::engine::program::Program;
use crate::engine::program::hierarchy::{self, Role};
use crate::engine::{Saved, fingerprint};
use crate::testbench::running::Running;
use crate::testbench::simulation::Simulation;
use crate::testbench::timeline::Timeline;

/// The state of a simulation at one time: time, inputs, resets, registers, memories and the counts of covers.
///
/// It belongs to the design, not to the engine: a simulation of the same design on any engine goes on from it.
///
/// ```
/// # use tilewright_sim::{EngineKind, Simulation, for_examples::Counter};
/// let mut sim = Simulation::of(&Counter)?;
/// sim.set(sim.i.enable, 1);
/// sim.run(100);
/// let hundred = sim.checkpoint();
/// sim.run(50);
/// let mut other = Simulation::of(&Counter)?.on(EngineKind::Reference);
/// other.restore(&hundred)?;
/// other.run(50);
/// assert_eq!(other.checkpoint(), sim.checkpoint());
/// # Ok::<(), tilewright_sim::Error>(())
/// ```
#[derive(Clone)]
pub struct Checkpoint {
    pub(crate) program: Arc<Program>,
    pub(crate) saved: Saved,
    pub(crate) timeline: Timeline,
    /// For each clock: its reset is active, and since when.
    resets: Vec<(bool, u64)>,
    /// For each cover, its counts in resets: [`Running::in_reset`] and [`Running::before_reset`].
    covers: Vec<[Vec<u64>; 2]>,
}

/// Why a checkpoint cannot be read or restored.
///
/// ```
/// # use tilewright_sim::{Checkpoint, CheckpointError, Simulation, for_examples::Counter};
/// let sim = Simulation::of(&Counter)?;
/// let error = Checkpoint::read(&b"no checkpoint"[..], &sim).unwrap_err();
/// assert!(matches!(error, CheckpointError::NoCheckpoint));
/// # Ok::<(), tilewright_sim::Error>(())
/// ```
#[derive(Debug, thiserror::Error)]
pub enum CheckpointError {
    /// It is of another design, or of other parameters, or other passes have prepared the design.
    #[error(
        "the checkpoint is of `{found}`, whose state differs from that of `{expected}` here: run the description that it is of"
    )]
    OtherDesign {
        /// The top of its design.
        found: String,
        /// The top of the simulation's design.
        expected: String,
    },
    /// The file has another format.
    #[error("the checkpoint has format {found}, and this version reads format {expected}: make it again")]
    OtherFormat {
        /// The number of its format.
        found: String,
        /// The number of the format that this version writes.
        expected: u32,
    },
    /// The file is something else.
    #[error("this is not a checkpoint: one begins with `tilewright checkpoint`")]
    NoCheckpoint,
    /// The file is cut off, or some of it was replaced.
    #[error("the checkpoint is damaged: make it again")]
    Damaged,
    /// The file cannot be read.
    #[error("the checkpoint cannot be read: {0}")]
    Unreadable(#[from] std::io::Error),
}

/// What differs between two checkpoints: a register, input, read data or word.
///
/// ```
/// # use tilewright_sim::{Simulation, for_examples::Counter};
/// let mut sim = Simulation::of(&Counter)?;
/// let start = sim.checkpoint();
/// sim.set(sim.i.enable, 1);
/// sim.run(3);
/// let all = sim.checkpoint().differences(&start);
/// let texts = all.iter().map(|it| it.to_string()).collect::<Vec<_>>();
/// assert_eq!(texts, ["`enable`: 1'h1, and 1'h0", "`count`: 8'h03, and 8'h00", "`late`: 8'h02, and 8'h00"]);
/// # Ok::<(), tilewright_sim::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StateDifference {
    /// The hierarchical name, with an address behind a memory.
    pub name: String,
    /// The value in the first checkpoint.
    pub first: Bits,
    /// The value in the second one.
    pub second: Bits,
}

impl fmt::Display for StateDifference {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let StateDifference { name, first, second } = self;
        write!(f, "`{name}`: {first:?}, and {second:?}")
    }
}

impl Checkpoint {
    /// The time of the last instant in picoseconds.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// sim.run(3);
    /// assert_eq!(sim.checkpoint().time(), 30_000);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn time(&self) -> u64 {
        self.timeline.time()
    }

    /// What differs between this checkpoint and another one of the design, in the sequence of the hierarchy; memories
    /// come last in each instance.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// let before = sim.checkpoint();
    /// sim.poke_memory("squares", 5, 7)?;
    /// let differences = sim.checkpoint().differences(&before);
    /// assert_eq!(differences[0].to_string(), "`squares[5]`: 8'h07, and 8'h19");
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// They are of different designs.
    #[track_caller]
    pub fn differences(&self, other: &Checkpoint) -> Vec<StateDifference> {
        assert!(self.is_of(&other.program), "the checkpoints are of different designs");
        let program = &*self.program;
        let (mut values, mut words) = (Differing::default(), Differing::default());
        self.saved.for_each_difference(
            &other.saved,
            program,
            |id, lane, both| {
                let pair = both.map(|limbs| Bits::from_limbs(program.circuit[id].width, limbs));
                values.entry(id.0).or_default().push((lane, 0, pair));
            },
            |memory, lane, address, both| {
                let pair = both.map(|limbs| Bits::from_limbs(program.memories[memory as usize].width, limbs));
                words.entry(memory).or_default().push((lane, address, pair));
            },
        );
        named(program, &values, &words)
    }

    /// Whether it is of a program with this state.
    fn is_of(&self, program: &Arc<Program>) -> bool {
        Arc::ptr_eq(&self.program, program) || fingerprint(&self.program) == fingerprint(program)
    }
}

/// A lane, an address, and what is there in both checkpoints.
type Pair = (u32, u32, [Bits; 2]);

/// All that differs, by value or by memory.
type Differing = FxHashMap<u32, Vec<Pair>>;

/// The differences with their names; those that have no name are left out.
fn named(program: &Program, values: &Differing, words: &Differing) -> Vec<StateDifference> {
    let hierarchy = &program.hierarchy;
    let mut all = Vec::new();
    for place in (0..program.lanes()).flat_map(|run| hierarchy.places(run)) {
        let scope = hierarchy.scope(place.scope);
        let mut add = |name: &str, shape: Shape, differing: Option<&Vec<Pair>>, is_memory: bool| {
            let own = |lane: u32| lane / shape.lanes() == place.lane;
            for (lane, address, [first, second]) in differing.into_iter().flatten().filter(|pair| own(pair.0)) {
                let lane = hierarchy::index(shape, lane % shape.lanes());
                let address = if is_memory { format!("[{address}]") } else { String::new() };
                let name = format!("{}{lane}{address}", hierarchy.path_in(place, name));
                all.push(StateDifference { name, first: first.clone(), second: second.clone() });
            }
        };
        // The inputs of instances are those outside of them.
        let is_own = |role| match role {
            Role::Input => scope.parent.is_none(),
            role => matches!(role, Role::Register | Role::ReadData),
        };
        for signal in scope.signals.iter().filter(|signal| is_own(signal.role)) {
            add(&signal.name, signal.shape, values.get(&signal.value.0), false);
        }
        scope.memories.iter().for_each(|(name, memory, shape)| add(name, *shape, words.get(memory), true));
    }
    all
}

impl PartialEq for Checkpoint {
    /// Whether a simulation goes on alike from both.
    fn eq(&self, other: &Checkpoint) -> bool {
        let rest = |it: &Checkpoint| (it.timeline.cycles_of_all(), it.resets.clone(), it.covers.clone());
        self.is_of(&other.program) && rest(self) == rest(other) && self.saved == other.saved
    }
}

impl Eq for Checkpoint {}

impl fmt::Debug for Checkpoint {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let top = &self.program.hierarchy.scopes[0].name;
        f.debug_struct("Checkpoint").field("of", top).field("time", &self.time()).finish_non_exhaustive()
    }
}

impl<I: Bundle, O: Bundle> Simulation<I, O> {
    /// The present state.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// sim.set(sim.i.enable, 1);
    /// let start = sim.checkpoint();
    /// sim.run(7);
    /// sim.restore(&start)?;
    /// assert_eq!((sim.time(), sim.get_u64(sim.o.count), sim.get_u64(sim.i.enable)), (0, 0, 1));
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn checkpoint(&mut self) -> Checkpoint {
        self.circuit.checkpoint(None)
    }

    /// Goes to a state, which may be of another simulation of the design. What is remembered of the past, if anything
    /// ([`Simulation::remember`]), is forgotten.
    ///
    /// ```
    /// # use tilewright_sim::{CheckpointError, Error, Simulation, for_examples::{Counter, Increment}};
    /// let other = Simulation::of(&Increment)?.checkpoint();
    /// let error = Simulation::of(&Counter)?.restore(&other).unwrap_err();
    /// let said = "the checkpoint is of `increment`, whose state differs from that of `counter` here";
    /// assert!(error.to_string().starts_with(said), "{error}");
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// It is of another design.
    ///
    /// # Panics
    ///
    /// A trace is attached: none has time that goes back.
    #[track_caller]
    pub fn restore(&mut self, checkpoint: &Checkpoint) -> Result<(), CheckpointError> {
        self.circuit.check_no_trace();
        if !checkpoint.is_of(&self.circuit.program) {
            let expected = self.circuit.program.hierarchy.scopes[0].name.clone();
            return Err(CheckpointError::OtherDesign { found: checkpoint.top(), expected });
        }
        self.circuit.go_on_from(checkpoint);
        self.circuit.remember_again();
        Ok(())
    }
}

impl Checkpoint {
    fn top(&self) -> String {
        self.program.hierarchy.scopes[0].name.clone()
    }
}

impl Running {
    /// The present state, which shares with an earlier one what is the same.
    pub fn checkpoint(&mut self, before: Option<&Saved>) -> Checkpoint {
        let covers = self.in_reset.iter().zip(&self.before_reset);
        Checkpoint {
            saved: Saved::of(&self.program, &mut *self.engine, before),
            program: self.program.clone(),
            timeline: self.timeline.clone(),
            resets: self.resets.iter().copied().zip(self.reset_since.iter().copied()).collect(),
            covers: covers.map(|(all, before)| [all.clone(), before.clone()]).collect(),
        }
    }

    /// Goes to a state of the same design.
    pub fn go_on_from(&mut self, checkpoint: &Checkpoint) {
        for (clock, (is_active, since)) in checkpoint.resets.iter().copied().enumerate() {
            (self.resets[clock], self.reset_since[clock]) = (is_active, since);
            // An asynchronous one sets registers, which come next.
            self.engine.set_reset(clock, is_active);
        }
        self.engine.restore(&self.program.clone(), &checkpoint.saved);
        self.timeline = checkpoint.timeline.clone();
        (self.in_reset, self.before_reset) =
            checkpoint.covers.iter().map(|[all, before]| (all.clone(), before.clone())).unzip();
    }

    /// A trace has one direction.
    #[track_caller]
    pub fn check_no_trace(&self) {
        assert!(!self.is_observed(), "a trace is attached, whose time cannot go back: end it with `finish`");
    }
}
