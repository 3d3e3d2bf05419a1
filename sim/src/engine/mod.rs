//! The interface of all engines, and the engines.

mod choice;
mod cranelift;
mod emit;
pub(crate) mod explain;
mod fields;
mod function;
mod interpreter;
mod layout;
mod lockstep;
mod pack;
mod passes;
mod plan;
pub mod program;
mod reference;
mod rewrite;
mod running;
mod saved;
pub(crate) mod semantics;
mod start;
mod strips;
pub(crate) mod until;

use std::cell::Cell;
use std::fmt;

use tilewright_circuit::Bits;

pub use choice::EngineKind;
pub(crate) use choice::Started;
pub use cranelift::Unsupported;
pub use explain::{Explained, Pass, explain};
pub use passes::{Passes, Target};
use program::{Memory, Program, Triggers, ValueId};
#[doc(hidden)]
pub use running::examined;
pub(crate) use running::{Limb, Limbs, Slot};
pub(crate) use saved::{Saved, fingerprint, for_each_width, state_limbs};
pub(crate) use start::{Beginning, Given};
#[doc(hidden)]
pub use strips::Examined;
use until::Until;

/// An assertion that fails.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Failed {
    /// Its index in [`Program::asserts`](crate::engine::program::Program::asserts).
    pub assert: u32,
    /// The lane of its scope.
    pub lane: u32,
}

/// The part of a request that was carried out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Done {
    /// The number of edges.
    pub edges: u64,
    /// Everything that may have changed.
    pub changed: Triggers,
}

/// The state of a clock. Everything else follows from the count of its edges, so an edge changes one number only.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Ticks {
    /// In picoseconds.
    pub period: u64,
    /// The number of edges so far.
    pub cycles: u64,
    /// The largest number of edges whose time fits in 64 bits.
    pub most: u64,
}

impl Ticks {
    /// The time of the last edge; 0 if there was none.
    pub fn last(&self) -> u64 {
        self.cycles * self.period
    }

    /// The time of the next edge; `None` if it does not fit in 64 bits.
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
    /// The address within it.
    pub address: u32,
}

/// The first difference between two engines.
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
    /// The signal's hierarchical name. It may also be the name of a memory with an address, or of an instance with
    /// the message of an assertion in it. The value of an assertion is 1 if it passes.
    pub signal: String,
    /// The number of instants before it.
    pub instant: u64,
    /// The clocks that rose then; none if later inputs cause the difference.
    pub clocks: Vec<String>,
    /// The value on the reference engine.
    pub reference: Bits,
    /// The value on the other engine.
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

/// A row has a multiple of this number of limbs: a cache line.
pub(crate) const LINE: usize = 8;

/// A running circuit.
///
/// Values are exchanged as 64-bit limbs, lane after lane, the lowest limb first, with zeros above the width.
pub(crate) trait Engine: Send {
    /// A value in all lanes, computed if necessary.
    fn read(&mut self, id: ValueId) -> &[u64];

    /// One lane of a value of up to 64 bits, computed if necessary.
    fn number(&mut self, id: ValueId, lane: u32) -> u64 {
        self.read(id)[lane as usize]
    }

    /// Brings numbers seen earlier up to date. Each is the only lane of a value of up to 64 bits. `changed` gets the
    /// indices of those that differ. The engine may store notes about them in `note`, which is empty the first time.
    fn renew(&mut self, ids: &[ValueId], seen: &mut [u64], _note: &mut Vec<u32>, changed: &mut Vec<u32>) {
        renew_each(self, ids, seen, changed);
    }

    /// Sets an input, in all its lanes.
    fn write(&mut self, id: ValueId, limbs: &[u64], triggers: Triggers);

    /// Sets an input of one lane and up to 64 bits.
    fn write_number(&mut self, id: ValueId, number: u64, triggers: Triggers) {
        self.write(id, &[number], triggers);
    }

    /// A word of a memory.
    fn word(&self, memory: u32, lane: u32, address: u32) -> Vec<u64>;

    /// A word of up to 64 bits.
    fn short_word(&self, memory: u32, lane: u32, address: u32) -> u64 {
        self.word(memory, lane, address)[0]
    }

    /// Appends all words of a memory, lane by lane, address by address.
    fn all_words(&self, program: &Program, memory: u32, out: &mut Vec<u64>) {
        let Memory { lanes, depth, .. } = program.memories[memory as usize];
        for lane in 0..lanes {
            (0..depth).for_each(|address| out.extend(self.word(memory, lane, address)));
        }
    }

    /// Replaces a word of a memory.
    fn set_word(&mut self, memory: u32, lane: u32, address: u32, limbs: &[u64]);

    /// Sets whether a clock's reset is active. An asynchronous one then sets its registers at once.
    fn set_reset(&mut self, clock: usize, high: bool);

    /// Replaces all inputs, registers, read data and words. [`Engine::set_reset`] is called before it for each clock.
    fn restore(&mut self, program: &Program, saved: &Saved);

    /// The assertions that fail at an edge of these clocks.
    fn check(&mut self, rising: &[usize]) -> Vec<Failed>;

    /// Executes `count` edges of these clocks, one after another, with nothing in between. It stops before an edge at
    /// which an assertion fails. At an edge all clocks sample first; then their registers, read data and memories
    /// change.
    ///
    /// # Errors
    ///
    /// The two engines of a pair differ.
    fn edges(&mut self, rising: &[usize], count: u64) -> Result<Done, Box<Difference>>;

    /// Executes some of the next instants of several clocks, up to a time; perhaps none. All assertions pass before
    /// each of them.
    fn instants(&mut self, _ticks: &mut [Ticks], _until: u64) {}

    /// Like [`Engine::edges`], but stops after an edge after which the condition is true; returns whether it is true
    /// at the end.
    ///
    /// # Errors
    ///
    /// The two engines of a pair differ.
    fn edges_until(&mut self, rising: &[usize], count: u64, until: &Until) -> Result<(Done, bool), Box<Difference>> {
        one_by_one(self, rising, count, until)
    }

    /// Checks that the two engines of a pair have agreed so far, including values that depend on the present inputs.
    ///
    /// # Errors
    ///
    /// They differ.
    fn agree(&mut self) -> Result<(), Box<Difference>> {
        Ok(())
    }

    /// Whether a value is certainly the same as at the last call with the same `seen`, where the engine may store
    /// notes; it is empty the first time. This is cheaper than reading the value.
    fn is_as_seen(&mut self, _id: ValueId, _seen: &mut Vec<u64>) -> bool {
        false
    }

    /// The number of edges at which units had nothing to do and were skipped, summed over all units; or the number of
    /// clock edges that were skipped.
    fn left_out(&self) -> u64 {
        0
    }

    /// The number of specialised loop versions made for frequent values.
    fn versions(&self) -> u64 {
        0
    }

    /// Prepares for reading these values together.
    fn watch(&mut self, _values: &[ValueId]) {}

    /// Reads limbs together, which are the same in many calls. Returns `false` and does nothing if they are better read one by one.
    fn glance(&mut self, _limbs: &Limbs, _numbers: &mut [u64]) -> bool {
        false
    }

    /// Prepares for collecting these values before each of many edges, in rows. Returns the index for
    /// [`Engine::edges_in_rows`], or `None` if the engine cannot do so for them.
    fn take_in_rows(&mut self, _values: &[ValueId]) -> Option<usize> {
        None
    }

    /// Executes edges like [`Engine::edges`], perhaps fewer, and collects the values before each. Each executed edge
    /// has a row: the limbs of one value after another, and zeros up to a multiple of [`LINE`]. Returns `None` if the
    /// values must be read at each edge instead.
    fn edges_in_rows(&mut self, _rows: usize, _rising: &[usize], _count: u64) -> Option<(Done, &[Cell<u64>])> {
        None
    }
}

/// Like [`Engine::renew`], one number after another.
fn renew_each<E: Engine + ?Sized>(engine: &mut E, ids: &[ValueId], seen: &mut [u64], changed: &mut Vec<u32>) {
    changed.clear();
    for ((&id, seen), index) in ids.iter().zip(seen).zip(0..) {
        let number = engine.number(id, 0);
        if std::mem::replace(seen, number) != number {
            changed.push(index);
        }
    }
}

/// Executes edges until a condition is true, checking it after each.
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
