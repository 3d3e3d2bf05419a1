//! Scenarios: what a block's inputs do over time, as plain data that any simulator can play.

use crate::bits::Bits;
use crate::block::Block;
use crate::bundle::{Bundle, Fields};
use crate::clock::Period;
use crate::loc::Loc;
use crate::module::port_name;
use crate::stream::backwards;
use crate::uneven::{Uneven, uneven};
use crate::width::Width;

/// What the inputs do over time. A reset comes first, at one edge of every clock; inputs not mentioned are zero.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Scenario {
    /// What it shows.
    pub about: &'static str,
    /// The changes of inputs, in order of time.
    pub events: Vec<Event>,
    /// When it ends, in picoseconds after the reset.
    pub end_ps: u64,
}

/// A change of an input.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Event {
    /// When, in picoseconds after the reset; never at an edge.
    pub at_ps: u64,
    /// The input port's name.
    pub input: String,
    /// What it becomes.
    pub value: Bits,
}

/// Writes a scenario row by row: the inputs in each clock.
pub struct Script<B: Block> {
    widths: <B::In as Bundle>::Of<Width>,
    period: u64,
    /// The time of the next row: a quarter of a period after an edge.
    at_ps: u64,
    last: Vec<u64>,
    events: Vec<Event>,
}

impl<B: Block> Script<B> {
    /// An empty script for a block, in clocks of `period`; that of its fastest clock if it has several.
    pub fn new(block: &B, period: Period) -> Script<B> {
        let widths = block.inputs();
        let last = vec![0; widths.leaves().len()];
        let period = period.picoseconds();
        Script { widths, period, at_ps: period / 4, last, events: Vec::new() }
    }

    /// From now on a row is a clock of that period.
    pub fn in_clocks_of(&mut self, period: Period) {
        self.period = period.picoseconds();
    }

    /// One clock with these inputs.
    ///
    /// # Panics
    ///
    /// A list of inputs is not as long as the block's.
    #[track_caller]
    pub fn clock(&mut self, inputs: &<B::In as Bundle>::Of<u64>) {
        let (widths, values, back) = (self.widths.leaves(), inputs.leaves(), backwards(inputs));
        if let Some(uneven) = uneven(&values, &widths) {
            let (Uneven { has, needs, .. }, loc) = (&uneven, Loc::caller());
            panic!("input{uneven} is a list of {needs}, but a list of {has} is given, at {loc}");
        }
        for ((((path, value), (_, width)), last), back) in values.into_iter().zip(widths).zip(&mut self.last).zip(back)
        {
            if value != *last && !back {
                let input = port_name("", &path);
                self.events.push(Event { at_ps: self.at_ps, input, value: Bits::new(width.bits(), value) });
                *last = value;
            }
        }
        self.wait(1);
    }

    /// Some clocks with these inputs.
    ///
    /// # Panics
    ///
    /// As [`Script::clock`].
    #[track_caller]
    pub fn hold(&mut self, inputs: &<B::In as Bundle>::Of<u64>, clocks: u64) {
        self.clock(inputs);
        self.wait(clocks - 1);
    }

    /// From the next row on the receiver of an outgoing stream is ready, or is not; it is not at first. The stream is told by its path in
    /// the block's outputs, as `out` or `out.1`.
    pub fn ready(&mut self, stream: &str, is_ready: bool) {
        let input = port_name("", &format!("{stream}.ready"));
        self.events.push(Event { at_ps: self.at_ps, input, value: Bits::new(1, is_ready.into()) });
    }

    /// The same inputs for some clocks more.
    pub fn wait(&mut self, clocks: u64) {
        self.at_ps += clocks * self.period;
    }

    /// The scenario written so far.
    pub fn finish(self, about: &'static str) -> Scenario {
        Scenario { about, events: self.events, end_ps: self.at_ps }
    }
}
