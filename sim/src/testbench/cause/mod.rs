//! The cause of a value: the registers and inputs that decided it, step by step back to where it came from.
//!
//! Nothing is recorded for it. The values of a time follow from its state and inputs, and an earlier state from what a
//! simulation remembers of its past. So the way back is found when somebody asks.

mod edge;
mod forced;
mod lanes;
mod mask;
mod names;
mod operation;
#[cfg(test)]
mod tests;
mod text;
mod tree;
mod values;
mod walk;

use tilewright_circuit::ir::Kind;
use tilewright_circuit::{Bits, Loc};
use tilewright_hdl::Bundle;

use crate::engine::program::Triggers;
use crate::testbench::attach::Probe;
use crate::testbench::error::{Error, UnknownName};
use crate::testbench::lookup::{self, Found};
use crate::testbench::running::Running;
use crate::testbench::simulation::Simulation;
use operation::Place;
use walk::Walk;

/// How far [`Simulation::why_within`] follows causes.
///
/// ```
/// # use tilewright_sim::{Limits, Simulation, for_examples::Counter};
/// let mut sim = Simulation::of(&Counter)?;
/// sim.remember(1 << 20);
/// sim.set(sim.i.enable, 1);
/// sim.run(100);
/// let deep = Limits { depth: 20, ..Limits::default() };
/// assert_eq!(sim.why_within("count", &deep)?.iter().filter(|cause| cause.name == "count").count(), 21);
/// # Ok::<(), tilewright_sim::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Limits {
    /// The most steps from the value in question, at most 1000.
    pub depth: usize,
    /// About the most causes in the tree. Later ones come first.
    pub nodes: usize,
    /// Also show operations without a name of their own, and constants.
    pub operations: bool,
    /// Also follow why registers and words were not written since: enables that were off, other addresses.
    pub kept: bool,
}

impl Default for Limits {
    /// Eight steps, a hundred causes, those with names.
    fn default() -> Limits {
        Limits { depth: 8, nodes: 100, operations: false, kept: false }
    }
}

impl Limits {
    /// Back to inputs and to the start, as far as that is remembered.
    ///
    /// ```
    /// # use tilewright_sim::{End, Limits, Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// sim.remember(1 << 20);
    /// sim.set(sim.i.enable, 1);
    /// sim.run(100);
    /// let cause = sim.why_within("count", &Limits::none())?;
    /// assert!(cause.iter().any(|cause| cause.end == Some(End::Start)));
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn none() -> Limits {
        Limits { depth: usize::MAX, nodes: usize::MAX, ..Limits::default() }
    }
}

/// What a [`Cause`] is.
///
/// ```
/// # use tilewright_sim::{Part, Simulation, for_examples::Counter};
/// let cause = Simulation::of(&Counter)?.why("square")?;
/// assert_eq!(cause.part, Part::Net);
/// assert_eq!([cause.causes[0].part, cause.causes[1].part], [Part::Word, Part::Register]);
/// # Ok::<(), tilewright_sim::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// An input of the top module.
    Input,
    /// A register.
    Register,
    /// The data of a synchronous read.
    ReadData,
    /// A word of a memory.
    Word,
    /// A named net, or a port.
    Net,
    /// An operation without a name: its name is the operation in words.
    Operation,
}

/// Why a [`Cause`] has no causes, or not all of them.
///
/// ```
/// # use tilewright_sim::{End, Simulation, for_examples::Counter};
/// let cause = Simulation::of(&Counter)?.why("square")?;
/// assert_eq!(cause.causes[0].end, Some(End::Start)); // the contents of the memory
/// # Ok::<(), tilewright_sim::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum End {
    /// It is an input.
    Input,
    /// It has been so since the start: a value at power-on, or contents of a memory.
    Start,
    /// A reset.
    Reset,
    /// The testbench set a word.
    Testbench,
    /// It is constant.
    Constant,
    /// It came before the earliest time that is remembered.
    Unremembered,
    /// The limits ended the search.
    Cut,
    /// Its causes are told at another place of the tree.
    Elsewhere,
}

/// The cause of a value: a tree, whose root is the value in question.
///
/// The value, or rather those of its [`bits`](Cause::bits) that count, is what it is because of its
/// [`causes`](Cause::causes). A choice counts its condition and its chosen side; an AND that is 0 counts its zeros, and
/// an OR that is 1 its ones. A register came from its next value and its enable at its last write.
///
/// ```
/// # use tilewright_sim::{Simulation, for_examples::Counter};
/// let mut sim = Simulation::of(&Counter)?;
/// sim.remember(1 << 20);
/// for enable in [1, 0, 1, 0, 0] {
///     sim.set(sim.i.enable, enable);
///     sim.step();
/// }
/// let cause = sim.why("count")?;
/// let lines = cause.iter().map(|cause| format!("{} = {} in {}", cause.label(), cause.number(), cause.cycle));
/// let lines: Vec<String> = lines.collect();
/// assert_eq!(lines, ["count = 2 in 3", "count = 1 in 1", "count = 0 in 0", "enable = 1 in 0", "enable = 1 in 2"]);
/// # Ok::<(), tilewright_sim::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Cause {
    /// The hierarchical name, with an address behind a memory.
    pub name: String,
    /// What it is.
    pub part: Part,
    /// The value.
    pub value: Bits,
    /// The bits of the value that count are 1.
    pub bits: Bits,
    /// The clock, if there are several.
    pub clock: Option<String>,
    /// The cycle of its clock: for a register or a word the first one in which it had this value, unless that is not
    /// followed further.
    pub cycle: u64,
    /// The time at which this cycle begins, in picoseconds.
    pub time: u64,
    /// The place in the description; `None` for a word.
    pub loc: Option<Loc>,
    /// It chose the value, as a condition, an enable or an address does. Otherwise the value came from it.
    pub chooses: bool,
    /// Why there are no causes, or not all of them.
    pub end: Option<End>,
    /// What decided it.
    pub causes: Vec<Cause>,
    /// The meaning of the value's bits.
    meaning: Kind,
}

impl Cause {
    /// All causes, each before its own.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let cause = Simulation::of(&Counter)?.why("square")?;
    /// assert_eq!(cause.iter().map(|cause| cause.name.as_str()).collect::<Vec<_>>(), ["square", "squares[0]", "count"]);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn iter(&self) -> impl Iterator<Item = &Cause> {
        let mut open = vec![self];
        std::iter::from_fn(move || {
            let cause = open.pop()?;
            open.extend(cause.causes.iter().rev());
            Some(cause)
        })
    }

    /// What to do to see more, in sentences.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// sim.run(3);
    /// let notes = sim.why("count")?.notes();
    /// assert_eq!(notes, ["nothing before cycle 3 is remembered: call `remember` at the start to see further"]);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn notes(&self) -> Vec<String> {
        let first = |end: End| self.iter().find(|cause| cause.end == Some(end));
        let unremembered = first(End::Unremembered).map(|cause| {
            let clock = cause.clock.as_ref().map(|clock| format!(" of `{clock}`")).unwrap_or_default();
            let cycle = cause.cycle;
            format!("nothing before cycle {cycle}{clock} is remembered: call `remember` at the start to see further")
        });
        let cut =
            first(End::Cut).map(|_| "the limits cut the tree: give `why_within` larger ones to see all".to_owned());
        unremembered.into_iter().chain(cut).collect()
    }
}

impl<I: Bundle, O: Bundle> Simulation<I, O> {
    /// The cause of a value, given as a [`Port`](crate::Port) or by name, such as `u_cell[3].sum`, or `squares[5]` for
    /// a word of a memory: the registers and inputs that decided it, back to where it came from.
    ///
    /// A simulation that remembers its past ([`Simulation::remember`]) goes back for it, and then returns to the
    /// present. A trace sees nothing of this. Otherwise the causes are those of one cycle. The tree is within
    /// [`Limits::default`].
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// sim.remember(1 << 20);
    /// sim.set(sim.i.enable, 1);
    /// sim.run(2);
    /// sim.set(sim.i.enable, 0);
    /// sim.run(40);
    /// let text = sim.why(sim.o.count)?.to_string();
    /// let lines: Vec<&str> = text.lines().map(|line| line.split("  sim/").next().unwrap()).collect();
    /// assert_eq!(lines, [
    ///     "count = 2  cycle 2", // and since then
    ///     "  from count = 1  cycle 1",
    ///     "    from count = 0  cycle 0",
    ///     "    when enable = 1  cycle 0",
    ///     "  when enable = 1  cycle 1",
    /// ]);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// There is no such name; the error suggests the nearest one.
    pub fn why(&mut self, of: impl Into<Probe>) -> Result<Cause, Error> {
        self.why_within(of, &Limits::default())
    }

    /// Like [`Simulation::why`], within other limits.
    ///
    /// ```
    /// # use tilewright_sim::{Limits, Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// let all = Limits { operations: true, ..Limits::default() };
    /// let cause = sim.why_within("square", &all)?;
    /// let names: Vec<&str> = cause.iter().map(|cause| cause.name.as_str()).collect();
    /// assert_eq!(names, ["square", "squares[0]", "count[3:0]", "count"]);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// As [`Simulation::why`].
    pub fn why_within(&mut self, of: impl Into<Probe>, limits: &Limits) -> Result<Cause, Error> {
        self.circuit.why(of.into(), limits)
    }
}

impl Running {
    fn why(&mut self, of: Probe, limits: &Limits) -> Result<Cause, Error> {
        let (name, place, lane) = self.asked(of)?;
        let width = match place {
            Place::Word(memory, _) => self.program.memories[memory as usize].width,
            Place::Value(id) => self.program.circuit[id].width,
        };
        let limits = Limits { depth: limits.depth.min(1000), ..limits.clone() };
        self.unobserved(|running| {
            let now = running.timeline.time();
            let mut walk = Walk::new(running, &limits);
            let walked = walk.run(place, lane, mask::all(width));
            let cause = walk.tree();
            running.end_visits();
            if running.timeline.time() != now {
                running.go_to(now)?;
            }
            walked.map(|()| Cause { name, ..cause })
        })
    }

    /// Does something that ends at the present time, without traces, which have no time that goes back.
    fn unobserved<T>(&mut self, work: impl FnOnce(&mut Running) -> T) -> T {
        let (observers, resting) = (std::mem::take(&mut self.observers), std::mem::take(&mut self.resting));
        self.pause_at = self.next_pause();
        let done = work(self);
        (self.observers, self.resting) = (observers, resting);
        self.pause_at = self.next_pause();
        // The engine was elsewhere meanwhile: they look at everything again.
        self.may_have_changed(Triggers::ALL);
        done
    }

    /// What is asked about: its name, and where it is.
    fn asked(&self, of: Probe) -> Result<(String, Place, u32), UnknownName> {
        match of {
            Probe::Port(port) => {
                let declared = self.declared(port);
                Ok((declared.name.clone(), Place::Value(declared.value), 0))
            }
            Probe::Path(path) => match lookup::signal(&self.program.hierarchy, &path, 0) {
                Ok(Found { signal, lane }) => Ok((path, Place::Value(signal.value), lane)),
                Err(unknown) => match self.word(&path) {
                    Some((place, lane)) => Ok((path, place, lane)),
                    None => Err(UnknownName { hint: self.words_of(&path).unwrap_or(unknown.hint), ..unknown }),
                },
            },
        }
    }

    /// The words to choose from, if a name means a memory, with or without its lane or some address.
    fn words_of(&self, path: &str) -> Option<String> {
        let parts = path.match_indices('[').map(|(at, _)| path[..at].to_owned());
        let lanes = ["", "[0]", "[0][0]"].map(|lane| format!("{path}{lane}"));
        lanes.into_iter().chain(parts).find_map(|name| {
            let (memory, _) = lookup::memory(&self.program.hierarchy, &name, 0).ok()?;
            let last = self.program.memories[memory as usize].depth - 1;
            Some(format!("the memory has the words `{name}[0]` to `{name}[{last}]`"))
        })
    }

    /// A word of a memory, by the memory's name and its address.
    fn word(&self, path: &str) -> Option<(Place, u32)> {
        let (memory, address) = path.strip_suffix(']')?.rsplit_once('[')?;
        let (memory, lane) = lookup::memory(&self.program.hierarchy, memory, 0).ok()?;
        let address = address.parse().ok().filter(|&address| address < self.program.memories[memory as usize].depth)?;
        Some((Place::Word(memory, address), lane))
    }
}
