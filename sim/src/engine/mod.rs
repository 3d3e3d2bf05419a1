//! What executes a circuit: the interface that every engine has, and the engines.

mod choice;
mod compiled;
mod explain;
mod fields;
mod interpreter;
mod lockstep;
mod pack;
mod passes;
pub mod program;
mod reference;
mod rewrite;
mod semantics;
mod start;
pub(crate) mod until;

use std::cell::Cell;
use std::fmt;

use tilewright_hdl::Bits;

pub use choice::EngineKind;
pub(crate) use choice::Started;
pub(crate) use compiled::Slot;
pub use compiled::Unsupported;
pub use explain::{Explained, Pass, explain};
pub use passes::Passes;
use program::{Program, Triggers, ValueId};
use until::Until;

/// An assertion that does not hold.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Failed {
    /// Its index in [`Program::asserts`](crate::engine::program::Program::asserts).
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

/// The state of a clock. All else follows from how often it has risen, so that an edge is a matter of one number.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Ticks {
    /// In picoseconds.
    pub period: u64,
    /// How often it has risen.
    pub cycles: u64,
    /// How often it can rise until its time has no room in 64 bits.
    pub most: u64,
}

impl Ticks {
    /// When it rose last; 0 if it has not.
    pub fn last(&self) -> u64 {
        self.cycles * self.period
    }

    /// When it rises next; none if that time has no room in 64 bits.
    #[inline]
    pub fn next(&self) -> Option<u64> {
        (self.cycles < self.most).then(|| self.last() + self.period)
    }
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

/// Where two engines first differ.
///
/// ```
/// use tilewright_hdl::Bits;
/// use tilewright_sim::{Difference, Error};
///
/// let (reference, other) = (Bits::new(8, 5), Bits::new(8, 4));
/// let difference = Difference { signal: "count".to_owned(), instant: 7, clocks: vec!["clk".to_owned()], reference, other };
/// let error = Error::from(Box::new(difference));
/// assert!(error.to_string().starts_with("the engines differ in `count` after instant 7, an edge of clk:"));
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Difference {
    /// The signal's hierarchical name, that of a memory with the address, or an instance and the message of an assertion
    /// in it, which is 1 if it holds.
    pub signal: String,
    /// How many instants had passed.
    pub instant: u64,
    /// The clocks that rose then; none if the inputs of a later moment make the difference.
    pub clocks: Vec<String>,
    /// What the reference engine has.
    pub reference: Bits,
    /// What the other one has.
    pub other: Bits,
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Difference { signal, instant, clocks, reference, other } = self;
        let moment = match &clocks[..] {
            [] => "before the next edge".to_owned(),
            clocks => format!("an edge of {}", clocks.join(" and ")),
        };
        write!(
            f,
            "the engines differ in `{signal}` after instant {instant}, {moment}: the reference engine has {reference:?}, \
             the other one {other:?}: this is a mistake in tilewright, please report the design"
        )
    }
}

impl std::error::Error for Difference {}

/// How many limbs a row is a multiple of: a line of the cache.
pub(crate) const LINE: usize = 8;

/// A running circuit.
///
/// Values are exchanged as 64-bit limbs, lane after lane, the lowest limb first, with zeros above the width.
pub(crate) trait Engine: Send {
    /// A value in all lanes, computed if it has to be.
    fn read(&mut self, id: ValueId) -> &[u64];

    /// One lane of a value of up to 64 bits, computed if it has to be.
    fn number(&mut self, id: ValueId, lane: u32) -> u64 {
        self.read(id)[lane as usize]
    }

    /// Brings numbers that were seen up to date, each the only lane of a value of up to 64 bits; leaves the indices of those
    /// that were others in `changed`. In `note`, which is empty the first time, an engine notes what it likes about them.
    fn renew(&mut self, ids: &[ValueId], seen: &mut [u64], _note: &mut Vec<u32>, changed: &mut Vec<u32>) {
        renew_each(self, ids, seen, changed);
    }

    /// Sets an input, all lanes of it.
    fn write(&mut self, id: ValueId, limbs: &[u64], triggers: Triggers);

    /// Sets an input of one lane and up to 64 bits.
    fn write_number(&mut self, id: ValueId, number: u64, triggers: Triggers) {
        self.write(id, &[number], triggers);
    }

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

    /// Goes through some of the next instants of several clocks, up to a time; perhaps through none. An assertion holds before each.
    fn instants(&mut self, _ticks: &mut [Ticks], _until: u64) {}

    /// As [`Engine::edges`], but that none follows on one after which the condition holds; whether it does at the end.
    ///
    /// # Errors
    ///
    /// Two engines side by side differ.
    fn edges_until(&mut self, rising: &[usize], count: u64, until: &Until) -> Result<(Done, bool), Box<Difference>> {
        one_by_one(self, rising, count, until)
    }

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

    /// At how many edges units had nothing to do and were left out, of all units together; or how many edges of clocks were left out.
    fn left_out(&self) -> u64 {
        0
    }

    /// How many versions of loops have been made for what came often.
    fn versions(&self) -> u64 {
        0
    }

    /// Prepares for these values being read together.
    fn watch(&mut self, _values: &[ValueId]) {}

    /// Prepares for these values being taken before each of many edges, in rows; gives what [`Engine::edges_in_rows`]
    /// knows them by, or nothing where the engine does not do so with them.
    fn take_in_rows(&mut self, _values: &[ValueId]) -> Option<usize> {
        None
    }

    /// Edges as in [`Engine::edges`], perhaps fewer of them, with the values as they are before each: a row for each edge
    /// that is done, of the limbs of one value after the other and zeros up to a multiple of [`LINE`]. Nothing where the values have to be read at each edge.
    fn edges_in_rows(&mut self, _rows: usize, _rising: &[usize], _count: u64) -> Option<(Done, &[Cell<u64>])> {
        None
    }
}

/// As [`Engine::renew`], one number after another.
fn renew_each<E: Engine + ?Sized>(engine: &mut E, ids: &[ValueId], seen: &mut [u64], changed: &mut Vec<u32>) {
    changed.clear();
    for ((&id, seen), index) in ids.iter().zip(seen).zip(0..) {
        let number = engine.number(id, 0);
        if std::mem::replace(seen, number) != number {
            changed.push(index);
        }
    }
}

/// Edges until a condition holds, with a look at it after each.
fn one_by_one<E: Engine + ?Sized>(
    engine: &mut E,
    rising: &[usize],
    count: u64,
    until: &Until,
) -> Result<(Done, bool), Box<Difference>> {
    let mut all = Done { edges: 0, changed: Triggers::NONE };
    while all.edges < count {
        let done = engine.edges(rising, 1)?;
        if done.edges == 0 {
            break;
        }
        all = Done { edges: all.edges + 1, changed: all.changed.with(done.changed) };
        if until.holds(engine.read(until.value)) {
            return Ok((all, true));
        }
    }
    Ok((all, false))
}

/// One lane of a value, settled.
pub(crate) fn lane(program: &Program, engine: &mut dyn Engine, id: ValueId, lane: u32) -> Bits {
    let value = program.value(id);
    if value.width <= 64 {
        return Bits::new(value.width, engine.number(id, lane));
    }
    let start = lane as usize * value.limbs();
    Bits::from_limbs(value.width, &engine.read(id)[start..start + value.limbs()])
}
