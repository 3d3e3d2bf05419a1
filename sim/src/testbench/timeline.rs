//! The times at which clocks rise.
//!
//! Every clock is low at time 0. It rises first after one period, falls half a period later, and so on. A clock that
//! acts where it falls has the opposite levels, and counts as rising where it falls. An instant is a time at which one
//! or more clocks rise. A circuit without clocks has an instant every 10 ns, at which nothing rises.

use crate::engine::Ticks;
use crate::engine::program::Program;
use tilewright_hdl::DEFAULT_PERIOD;

/// The state of all clocks.
#[derive(Debug, Clone)]
pub(crate) struct Timeline {
    clocks: Vec<Ticks>,
    /// What stands in for a clock if there is none.
    idle: Option<Ticks>,
}

impl Timeline {
    pub fn new(program: &Program) -> Timeline {
        let ticks = |period| Ticks { period, cycles: 0, most: u64::MAX / period };
        let clocks: Vec<_> = program.clocks.iter().map(|clock| ticks(clock.period)).collect();
        let idle = clocks.is_empty().then(|| ticks(DEFAULT_PERIOD.picoseconds()));
        Timeline { clocks, idle }
    }

    /// The time of the last instant, in picoseconds.
    pub fn time(&self) -> u64 {
        self.clocks.iter().chain(&self.idle).map(Ticks::last).max().unwrap_or(0)
    }

    /// The time of the last edge of the first clock; 0 without clocks.
    #[inline]
    pub fn time_of_first(&self) -> u64 {
        self.clocks.first().map_or(0, Ticks::last)
    }

    /// The time of the next instant; `None` if that time does not fit in 64 bits.
    pub fn next_time(&self) -> Option<u64> {
        self.clocks.iter().chain(&self.idle).filter_map(Ticks::next).min()
    }

    /// All clocks, for an engine that executes many instants.
    pub fn ticks(&mut self) -> &mut [Ticks] {
        &mut self.clocks
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

    /// How many edges each clock has had, or what stands in for a clock.
    pub fn cycles_of_all(&self) -> Vec<u64> {
        self.clocks.iter().chain(&self.idle).map(|ticks| ticks.cycles).collect()
    }

    /// The same clocks after so many edges of each; `None` if a time does not fit.
    pub fn with_cycles(&self, cycles: &[u64]) -> Option<Timeline> {
        let mut timeline = self.clone();
        for (ticks, &cycles) in timeline.clocks.iter_mut().chain(&mut timeline.idle).zip(cycles) {
            ticks.cycles = Some(cycles).filter(|&cycles| cycles <= ticks.most)?;
        }
        Some(timeline)
    }

    /// Notes that `edges` edges of the only clock are done.
    #[inline]
    pub fn repeat(&mut self, edges: u64) {
        self.clocks[0].cycles += edges;
    }

    /// Notes that an instant with the edges of `rising` is done.
    pub fn advance(&mut self, rising: &[usize]) {
        rising.iter().for_each(|&clock| self.clocks[clock].cycles += 1);
        self.idle.iter_mut().for_each(|idle| idle.cycles += 1);
    }
}
