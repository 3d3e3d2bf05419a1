//! Scenarios: a block's inputs over time, as plain data that any simulator can play.

use crate::block::Block;
use crate::bundle::Bundle;
use crate::fields::{Fields, Leaf};
use crate::integers::{Integer, not_negative};
use crate::names::port_name;
use crate::port_names::{PortNames, named};
use crate::stream::backwards;
use crate::uneven::{Uneven, uneven};
use crate::width::Width;
use tilewright_circuit::{Bits, Loc, Period};

/// The inputs of a block over time. A reset comes first, at one edge of every clock. Inputs without an event are
/// zero.
///
/// ```
/// # use tilewright_hdl::*;
/// # use tilewright_sim::for_examples::{Counter, CounterIn};
/// let mut script = Script::new(&Counter, DEFAULT_PERIOD);
/// script.clock(&CounterIn { enable: 1 });
/// let scenario = script.finish("counts once");
/// assert_eq!((scenario.events.len(), scenario.end_ps), (1, 12_500));
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Scenario {
    /// What the scenario shows.
    pub about: &'static str,
    /// The changes of inputs, in the sequence of time.
    pub events: Vec<Event>,
    /// The end, in picoseconds after the reset.
    pub end_ps: u64,
}

/// A change of an input.
///
/// ```
/// # use tilewright_hdl::*;
/// # use tilewright_sim::for_examples::{Counter, CounterIn};
/// let mut script = Script::new(&Counter, Period::ns(10));
/// script.clock(&CounterIn { enable: 0 });
/// script.clock(&CounterIn { enable: 1 });
/// // Without an event, an input is zero. A change comes a quarter of a period after an edge.
/// let rises = scenario::Event { at_ps: 12_500, input: "enable".to_owned(), value: Bits::new(1, 1) };
/// assert_eq!(script.finish("counts once").events, [rises]);
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Event {
    /// The time, in picoseconds after the reset; never at an edge.
    pub at_ps: u64,
    /// The input port's name.
    pub input: String,
    /// Its new value.
    pub value: Bits,
}

/// Writes a scenario row by row: the inputs in each clock.
///
/// ```
/// # use tilewright_hdl::*;
/// # use tilewright_sim::for_examples::{Counter, CounterIn};
/// let mut script = Script::new(&Counter, Period::ns(10));
/// for enable in [1, 1, 0] {
///     script.clock(&CounterIn { enable });
/// }
/// // An unchanged input makes no event.
/// assert_eq!(script.finish("counts to 2").events.len(), 2);
/// ```
pub struct Script<B: Block> {
    widths: <B::In as Bundle>::Of<Width>,
    names: PortNames,
    period: u64,
    /// The time of the next row: a quarter of a period after an edge.
    at_ps: u64,
    last: Vec<Bits>,
    events: Vec<Event>,
}

impl<B: Block> Script<B> {
    /// An empty script for a block, in clocks of `period`; if the block has several clocks, in those of the fastest.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_sim::for_examples::{Counter, CounterIn};
    /// let nothing = Script::new(&Counter, Period::ns(10)).finish("nothing happens");
    /// assert!(nothing.events.is_empty());
    /// ```
    pub fn new(block: &B, period: Period) -> Script<B> {
        let widths = block.inputs();
        let last = widths.leaves().iter().map(|(_, width)| Bits::zero(all_lanes(*width))).collect();
        let period = period.picoseconds();
        Script { widths, names: block.port_names(), period, at_ps: period / 4, last, events: Vec::new() }
    }

    /// From now on, a row is a clock of this period.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_sim::for_examples::{Counter, CounterIn};
    /// let mut script = Script::new(&Counter, Period::ns(10));
    /// script.clock(&CounterIn { enable: 1 });
    /// script.in_clocks_of(Period::ns(40));
    /// script.clock(&CounterIn { enable: 0 });
    /// assert_eq!(script.finish("a fast clock and a slow one").end_ps, 52_500);
    /// ```
    pub fn in_clocks_of(&mut self, period: Period) {
        self.period = period.picoseconds();
    }

    /// Adds one clock with these inputs.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # block! {
    /// #     struct Scan;
    /// #     in ScanIn { restart: bit(), enable: bit() }
    /// #     out ScanOut { x: bits(8) }
    /// # }
    /// # impl Scan {
    /// #     fn build(&self, m: Module, i: ScanIn) -> ScanOut {
    /// #         let x = m.reg("column", 8).reset(0);
    /// #         x.when(i.restart, 0).when(i.enable, x + 1);
    /// #         ScanOut { x: *x }
    /// #     }
    /// # }
    /// const IDLE: ScanIn<u64> = ScanIn { restart: 0, enable: 0 };
    ///
    /// let mut script = Script::new(&Scan, Period::ns(10));
    /// script.clock(&ScanIn { restart: 1, ..IDLE });
    /// script.clock(&ScanIn { enable: 1, ..IDLE });
    /// let inputs: Vec<_> = script.finish("a start").events.into_iter().map(|event| event.input).collect();
    /// assert_eq!(inputs, ["restart", "restart", "enable"]); // `restart` rises, and goes low when `enable` rises
    /// ```
    ///
    /// # Panics
    ///
    /// The length of a list of inputs is not the block's.
    #[track_caller]
    pub fn clock(&mut self, inputs: &<B::In as Bundle>::Of<u64>) {
        self.row(inputs, |width, value| Bits::new(width, *value), Loc::caller());
    }

    /// Like [`Script::clock`], with values wider than 64 bits.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # block! {
    /// #     struct Keep;
    /// #     in KeepIn { words: bits(50).of(row(2)) }
    /// #     out KeepOut { kept: bits(50).of(row(2)) }
    /// # }
    /// # impl Keep {
    /// #     fn build(&self, m: Module, i: KeepIn) -> KeepOut {
    /// #         KeepOut { kept: m.pipe("kept", i.words) }
    /// #     }
    /// # }
    /// let mut script = Script::new(&Keep, Period::ns(10));
    /// script.clock_bits(&KeepIn { words: Bits::ones(100) });
    /// assert_eq!(script.finish("two lanes").events[0].value, Bits::ones(100));
    /// ```
    ///
    /// # Panics
    ///
    /// As [`Script::clock`].
    #[track_caller]
    pub fn clock_bits(&mut self, inputs: &<B::In as Bundle>::Of<Bits>) {
        self.row(inputs, |_, value| value.clone(), Loc::caller());
    }

    fn row<V: Leaf>(&mut self, inputs: &<B::In as Bundle>::Of<V>, bits: impl Fn(u32, &V) -> Bits, loc: Loc) {
        let (widths, values, back) = (self.widths.leaves(), inputs.leaves(), backwards(inputs));
        if let Some(uneven) = uneven(&values, &widths) {
            let Uneven { has, needs, .. } = &uneven;
            panic!("input{uneven} is a list of {needs}, but a list of {has} is given, at {loc}");
        }
        let rows = values.into_iter().zip(widths).zip(&mut self.last).zip(back);
        let mut changed = Vec::new();
        for ((((path, value), (_, width)), last), _) in rows.filter(|(_, back)| !back) {
            let value = bits(all_lanes(width), &value);
            if value != *last {
                changed.push((path, value.clone()));
                *last = value;
            }
        }
        changed.into_iter().for_each(|(path, value)| self.event(&path, value));
        self.wait(1);
    }

    /// Adds `clocks` clocks with these inputs.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_sim::for_examples::{Counter, CounterIn};
    /// let mut script = Script::new(&Counter, Period::ns(10));
    /// script.hold(&CounterIn { enable: 1 }, 5);
    /// script.clock(&CounterIn { enable: 0 });
    /// assert_eq!(script.finish("counts to 5").events[1].at_ps, 52_500);
    /// ```
    ///
    /// # Panics
    ///
    /// As [`Script::clock`].
    #[track_caller]
    pub fn hold(&mut self, inputs: &<B::In as Bundle>::Of<u64>, clocks: impl Integer) {
        self.clock(inputs);
        self.wait(clocks.integer() - 1);
    }

    /// Sets whether the receiver of an outgoing stream is ready, from the next row on; at first it is not. The stream
    /// is given by its path in the block's outputs, such as `out` or `out.1`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_sim::for_examples::{Increment, IncrementIn};
    /// let mut script = Script::new(&Increment, Period::ns(10));
    /// script.ready("sums", true);
    /// script.clock(&IncrementIn { words: Stream::of(1, 7) });
    /// let inputs: Vec<_> = script.finish("a word").events.into_iter().map(|event| event.input).collect();
    /// assert_eq!(inputs, ["sums_ready", "words_valid", "words_payload"]);
    /// ```
    pub fn ready(&mut self, stream: &str, is_ready: bool) {
        self.event(&format!("{stream}.ready"), Bits::new(1, is_ready.into()));
    }

    /// The port with this path gets a value now.
    fn event(&mut self, path: &str, value: Bits) {
        let input = named(&self.names, path).unwrap_or_else(|| port_name("", path));
        self.events.push(Event { at_ps: self.at_ps, input, value });
    }

    /// Adds clocks with the same inputs.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_sim::for_examples::{Counter, CounterIn};
    /// let mut script = Script::new(&Counter, Period::ns(10));
    /// script.clock(&CounterIn { enable: 1 });
    /// script.wait(4);
    /// let mut held = Script::new(&Counter, Period::ns(10));
    /// held.hold(&CounterIn { enable: 1 }, 5);
    /// assert_eq!(script.finish("counts to 5"), held.finish("counts to 5"));
    /// ```
    pub fn wait(&mut self, clocks: impl Integer) {
        let clocks = u64::try_from(not_negative(clocks)).unwrap_or(u64::MAX);
        let at_ps = clocks.checked_mul(self.period).and_then(|time| self.at_ps.checked_add(time));
        self.at_ps = at_ps.unwrap_or_else(|| panic!("a script of {clocks} clocks more is longer than 2^64 ps"));
    }

    /// The scenario written so far.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_sim::for_examples::{Counter, CounterIn};
    /// let mut script = Script::new(&Counter, Period::ns(10));
    /// script.hold(&CounterIn { enable: 1 }, 3);
    /// let scenario = script.finish("counts to 3");
    /// assert_eq!(scenario.about, "counts to 3");
    /// ```
    pub fn finish(self, about: &'static str) -> Scenario {
        Scenario { about, events: self.events, end_ps: self.at_ps }
    }
}

/// The bits of a port in all its lanes.
fn all_lanes(width: Width) -> u32 {
    width.bits().checked_mul(width.shape().lanes()).expect("all lanes of an input have less than 2^32 bits")
}
