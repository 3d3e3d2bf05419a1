//! The instants of a scenario that was played.

use tilewright_hdl::DEFAULT_PERIOD;
use tilewright_sim::Simulation;

/// The times at which a clock rises, from 0 to the end, in picoseconds.
#[derive(Debug)]
pub struct Instants {
    /// The clocks, each with its period. A block without clocks has one without a name.
    clocks: Vec<(String, u64)>,
    /// The last instant.
    pub end: u64,
}

impl Instants {
    /// Those of a simulation, whose end is now.
    pub fn of(sim: &Simulation) -> Instants {
        let mut clocks: Vec<_> = sim.program().clocks.iter().map(|clock| (clock.name.clone(), clock.period)).collect();
        if clocks.is_empty() {
            clocks.push((String::new(), DEFAULT_PERIOD.picoseconds()));
        }
        Instants { clocks, end: sim.time() }
    }

    fn periods(&self) -> impl Iterator<Item = u64> {
        self.clocks.iter().map(|(_, period)| *period)
    }

    /// The instant after a time.
    pub fn after(&self, time: u64) -> u64 {
        self.periods().map(|period| (time / period + 1) * period).min().unwrap_or(u64::MAX)
    }

    /// The instant before a time; 0 before the first.
    pub fn before(&self, time: u64) -> u64 {
        let time = time.saturating_sub(1);
        self.periods().map(|period| time - time % period).max().unwrap_or(0)
    }

    /// So many instants before a time.
    pub fn back(&self, time: u64, count: usize) -> u64 {
        (0..count).fold(time, |time, _| self.before(time))
    }

    /// The instants from one on, at most so many, up to the end.
    pub fn from(&self, start: u64, count: usize) -> Vec<u64> {
        let all = std::iter::successors(Some(start), |time| Some(self.after(*time)));
        all.take_while(|time| *time <= self.end).take(count).collect()
    }

    /// The cycle of the first clock that begins at a time, if one does.
    pub fn cycle_at(&self, time: u64) -> Option<u64> {
        let period = self.clocks[0].1;
        time.is_multiple_of(period).then_some(time / period)
    }

    /// A time in words: the cycles of all clocks, and the picoseconds.
    pub fn words(&self, time: u64) -> String {
        let cycle = |(name, period): &(String, u64)| match self.clocks.len() {
            1 => format!("cycle {} of {}", time / period, self.end / period),
            _ => format!("{name} {}", time / period),
        };
        let cycles: Vec<String> = self.clocks.iter().map(cycle).collect();
        format!("{}, {time} ps", cycles.join(", "))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn instants_of_two_clocks_are_those_of_either() {
        let clocks = vec![("fast".to_owned(), 4), ("slow".to_owned(), 6)];
        let instants = Instants { clocks, end: 18 };
        assert_eq!(instants.from(0, 100), [0, 4, 6, 8, 12, 16, 18]);
        assert_eq!(instants.from(6, 3), [6, 8, 12]);
        assert_eq!([0, 4, 5, 8, 18].map(|time| instants.before(time)), [0, 0, 4, 6, 16]);
        assert_eq!(instants.back(18, 3), 8);
        assert_eq!([4, 6, 8].map(|time| instants.cycle_at(time)), [Some(1), None, Some(2)]);
        assert_eq!(instants.words(12), "fast 3, slow 2, 12 ps");
    }
}
