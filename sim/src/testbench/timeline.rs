//! Which clocks rise when.
//!
//! Every clock is low at time 0, rises for the first time after one period, falls half a period later, and so on. An
//! instant is a time at which one or more clocks rise.

use crate::engine::program::Program;

/// The state of all clocks.
#[derive(Debug, Clone)]
pub(crate) struct Timeline {
    /// Now: the time of the last instant, in picoseconds.
    pub time: u64,
    clocks: Vec<Ticks>,
}

/// The state of a clock.
#[derive(Debug, Clone, Copy)]
struct Ticks {
    period: u64,
    /// When it rises next.
    next: u64,
    /// How often it has risen.
    cycles: u64,
}

impl Ticks {
    #[inline]
    fn advance(&mut self, edges: u64) {
        self.next += edges * self.period;
        self.cycles += edges;
    }
}

impl Timeline {
    pub fn new(program: &Program) -> Timeline {
        let ticks = |period| Ticks { period, next: period, cycles: 0 };
        Timeline { time: 0, clocks: program.clocks.iter().map(|clock| ticks(clock.period)).collect() }
    }

    /// The time of the next instant; `None` without clocks.
    pub fn next_time(&self) -> Option<u64> {
        self.clocks.iter().map(|ticks| ticks.next).min()
    }

    /// The clocks that rise at `time`, into `rising`.
    pub fn rising_at(&self, time: u64, rising: &mut Vec<usize>) {
        rising.clear();
        rising.extend((0..self.clocks.len()).filter(|&clock| self.clocks[clock].next == time));
    }

    /// How many edges a clock has had.
    pub fn cycles(&self, clock: usize) -> u64 {
        self.clocks[clock].cycles
    }

    /// So many edges of the only clock are done.
    #[inline]
    pub fn repeat(&mut self, edges: u64) {
        let ticks = &mut self.clocks[0];
        ticks.advance(edges);
        self.time += edges * ticks.period;
    }

    /// The edges of `rising` are done.
    pub fn advance(&mut self, time: u64, rising: &[usize]) {
        self.time = time;
        rising.iter().for_each(|&clock| self.clocks[clock].advance(1));
    }
}
