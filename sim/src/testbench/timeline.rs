//! The times at which clocks rise.
//!
//! Every clock is low at time 0. It rises first after one period, falls half a period later, and so on. An instant is
//! a time at which one or more clocks rise.

use crate::engine::Ticks;
use crate::engine::program::Program;
use crate::testbench::error::Error;

/// The state of all clocks.
#[derive(Debug, Clone)]
pub(crate) struct Timeline {
    clocks: Vec<Ticks>,
}

impl Timeline {
    pub fn new(program: &Program) -> Timeline {
        let ticks = |period| Ticks { period, cycles: 0, most: u64::MAX / period };
        Timeline { clocks: program.clocks.iter().map(|clock| ticks(clock.period)).collect() }
    }

    /// The time of the last instant, in picoseconds.
    pub fn time(&self) -> u64 {
        self.clocks.iter().map(Ticks::last).max().unwrap_or(0)
    }

    /// The time of the next instant; `None` without clocks, or if that time does not fit in 64 bits.
    pub fn next_time(&self) -> Option<u64> {
        self.clocks.iter().filter_map(Ticks::next).min()
    }

    /// All clocks, for an engine that executes many instants.
    pub fn ticks(&mut self) -> &mut [Ticks] {
        &mut self.clocks
    }

    /// Why there is no next instant.
    pub fn ended(&self) -> Error {
        if self.clocks.is_empty() { Error::NoClock } else { Error::Late }
    }

    /// The number of edges of the only clock whose times still fit; 0 without clocks.
    #[inline]
    pub fn room(&self) -> u64 {
        self.clocks.first().map_or(0, |clock| clock.most - clock.cycles)
    }

    /// Writes the clocks that rise at `time` to `rising`.
    pub fn rising_at(&self, time: u64, rising: &mut Vec<usize>) {
        rising.clear();
        rising.extend((0..self.clocks.len()).filter(|&clock| self.clocks[clock].next() == Some(time)));
    }

    /// The number of edges that a clock has had.
    pub fn cycles(&self, clock: usize) -> u64 {
        self.clocks[clock].cycles
    }

    /// Notes that `edges` edges of the only clock are done.
    #[inline]
    pub fn repeat(&mut self, edges: u64) {
        self.clocks[0].cycles += edges;
    }

    /// Notes that the edges of `rising` are done.
    pub fn advance(&mut self, rising: &[usize]) {
        rising.iter().for_each(|&clock| self.clocks[clock].cycles += 1);
    }
}
