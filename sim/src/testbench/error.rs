//! Errors, in whole sentences.

use std::fmt;
use std::path::PathBuf;

use tilewright_circuit::{Loc, Problems};

use crate::engine::Difference;
use crate::testbench::checkpoint::CheckpointError;
use crate::testbench::past::Unremembered;
use crate::testbench::replay::Unrepeated;

/// Why a simulation could not be made or could not continue.
///
/// Its `Debug` text is its sentences, so that a `main` that returns it prints them.
///
/// ```
/// # use tilewright_sim::{Simulation, Error, for_examples::Counter};
/// let mut sim = Simulation::of(&Counter)?;
/// sim.set(sim.i.enable, 1);
/// match sim.try_run(1000) {
///     Err(Error::Violated(violations)) => assert_eq!(violations[0].cycle, 200),
///     other => panic!("{other:?}"),
/// }
/// # Ok::<(), tilewright_sim::Error>(())
/// ```
#[derive(thiserror::Error)]
pub enum Error {
    /// The description has mistakes.
    #[error(transparent)]
    Description(#[from] Problems),
    /// Assertions or assumptions fail.
    #[error("{}", sentences(.0))]
    Violated(Vec<Violation>),
    /// A batch needs at least one run, and the number of runs is limited.
    #[error("a batch of this design has from 1 to {most} runs, not {runs}")]
    Runs {
        /// The requested number.
        runs: u32,
        /// The largest possible number.
        most: u32,
    },
    /// There is no such name.
    #[error("{0}")]
    Unknown(#[from] UnknownName),
    /// A recording cannot be repeated.
    #[error(transparent)]
    Unrepeated(#[from] Unrepeated),
    /// The time of the next edge does not fit in 64 bits.
    #[error("the simulation is at its end: the next edge would be later than 2^64 ps, which is 213 days")]
    Late,
    /// A time cannot be gone back to.
    #[error(transparent)]
    Unremembered(#[from] Unremembered),
    /// A checkpoint cannot be restored.
    #[error(transparent)]
    Checkpoint(#[from] CheckpointError),
    /// Two engines side by side differ.
    #[error(transparent)]
    Differs(#[from] Box<Difference>),
    /// A trace would have too many words of memories.
    #[error(
        "the waveform would have {words} words of memories, and the limit is {most}: name fewer memories or addresses"
    )]
    Words {
        /// The requested number.
        words: u64,
        /// The largest possible number.
        most: u64,
    },
    /// A trace could not be written.
    #[error("cannot write the trace {}: {source}", .path.display())]
    Trace {
        /// The file.
        path: PathBuf,
        /// The system's error.
        source: std::io::Error,
    },
}

impl fmt::Debug for Error {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Error::Description(problems) => fmt::Debug::fmt(problems, f),
            error => fmt::Display::fmt(error, f),
        }
    }
}

fn sentences(violations: &[Violation]) -> String {
    violations.iter().map(Violation::to_string).collect::<Vec<_>>().join("\n")
}

/// An assertion or assumption that fails at an edge of its clock.
///
/// ```
/// # use tilewright_sim::{Simulation, for_examples::Counter};
/// let mut sim = Simulation::of(&Counter)?;
/// sim.set(sim.i.enable, 1);
/// let error = sim.try_run(1000).unwrap_err().to_string();
/// assert!(error.starts_with("assertion failed in `counter` in cycle 200 of `clk`, at 2010000 ps: it counts"));
/// // The values are those before the edge, which does not happen.
/// assert_eq!(sim.get(sim.o.count), 200);
/// # Ok::<(), tilewright_sim::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Violation {
    /// Its message.
    pub message: String,
    /// It is an assumption: the stimulus is wrong, not the circuit.
    pub is_assumption: bool,
    /// The run of a [`Batch`](crate::Batch), from 0; `None` if there is only one.
    pub run: Option<u32>,
    /// The instance's path below the top; the top module's name for the top itself.
    pub instance: String,
    /// The clock.
    pub clock: String,
    /// The cycle of that clock that ends with this edge, from 0.
    pub cycle: u64,
    /// The time of the edge in picoseconds.
    pub time: u64,
    /// The place in the description.
    pub loc: Loc,
}

impl fmt::Display for Violation {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Violation { message, is_assumption, run, instance, clock, cycle, time, loc } = self;
        let run = run.map(|run| format!(" of run {run}")).unwrap_or_default();
        let what = if *is_assumption { "the stimulus breaks an assumption of" } else { "assertion failed in" };
        write!(f, "{what} `{instance}`{run} in cycle {cycle} of `{clock}`, at {time} ps: {message}\n  --> {loc}")
    }
}

/// A name that the circuit does not have.
///
/// ```
/// # use tilewright_sim::{Simulation, for_examples::Counter};
/// let mut sim = Simulation::of(&Counter)?;
/// let unknown = sim.peek("cuont").unwrap_err();
/// assert_eq!(unknown.to_string(), "there is no signal `cuont`: did you mean `count`?");
/// # Ok::<(), tilewright_sim::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UnknownName {
    /// The kind of object: `signal`, `memory`, `clock`, `port`.
    pub what: &'static str,
    /// The name as given.
    pub name: String,
    /// The nearest existing name, or a list of names to choose from.
    pub hint: String,
}

impl UnknownName {
    /// The error with the nearest of `names` as its hint.
    pub(crate) fn new(what: &'static str, name: &str, names: &[String]) -> UnknownName {
        UnknownName::among(what, name, names, names)
    }

    /// The error with the nearest of `names` as its hint or, if none is near, with the names to `choose` from.
    pub(crate) fn among(what: &'static str, name: &str, names: &[String], choose: &[String]) -> UnknownName {
        let distance = |candidate: &str| strsim::levenshtein(name, candidate);
        let nearest = names.iter().min_by_key(|candidate| distance(candidate));
        let hint = match nearest {
            Some(nearest) if distance(nearest) <= 2 + name.len() / 4 => format!("did you mean `{nearest}`?"),
            _ if choose.is_empty() => "there is none here".to_string(),
            _ => {
                let some: Vec<String> = choose.iter().take(12).map(|name| format!("`{name}`")).collect();
                let more = if choose.len() > 12 { ", ..." } else { "" };
                format!("there are {}{more}", some.join(", "))
            }
        };
        UnknownName { what, name: name.to_string(), hint }
    }
}

impl fmt::Display for UnknownName {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "there is no {} `{}`: {}", self.what, self.name, self.hint)
    }
}

impl std::error::Error for UnknownName {}
