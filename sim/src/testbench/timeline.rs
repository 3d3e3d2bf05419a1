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
    periods: Vec<u64>,
    next: Vec<u64>,
    cycles: Vec<u64>,
}

impl Timeline {
    pub fn new(program: &Program) -> Timeline {
        let periods: Vec<u64> = program.clocks.iter().map(|clock| clock.period).collect();
        Timeline { time: 0, next: periods.clone(), cycles: vec![0; periods.len()], periods }
    }

    /// The time of the next instant; `None` without clocks.
    pub fn next_time(&self) -> Option<u64> {
        self.next.iter().copied().min()
    }

    /// The clocks that rise at `time`, into `rising`.
    pub fn rising_at(&self, time: u64, rising: &mut Vec<usize>) {
        rising.clear();
        rising.extend((0..self.next.len()).filter(|&clock| self.next[clock] == time));
    }

    /// How many edges a clock has had.
    pub fn cycles(&self, clock: usize) -> u64 {
        self.cycles[clock]
    }

    /// So many edges of the only clock are done.
    pub fn repeat(&mut self, edges: u64) {
        self.time += edges * self.periods[0];
        self.next[0] += edges * self.periods[0];
        self.cycles[0] += edges;
    }

    /// The edges of `rising` are done.
    pub fn advance(&mut self, time: u64, rising: &[usize]) {
        self.time = time;
        for &clock in rising {
            self.next[clock] += self.periods[clock];
            self.cycles[clock] += 1;
        }
    }
}
