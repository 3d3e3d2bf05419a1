//! Observers that rest: a waveform of a part of a run costs nothing before and after that part.

use tilewright_hdl::DEFAULT_PERIOD;

use crate::engine::program::Triggers;
use crate::testbench::running::Running;
use crate::testbench::trace::Observer;

/// Observers that need no sample now, each with the time at which it may.
#[derive(Default)]
pub(crate) struct Resting(Vec<(u64, Box<dyn Observer + Send>)>);

impl Resting {
    /// The time at which the first one may need a sample; the largest one if there is none.
    pub fn until(&self) -> u64 {
        self.0.iter().map(|(until, _)| *until).min().unwrap_or(u64::MAX)
    }

    /// All of them, which are awake then.
    pub fn take(&mut self) -> impl Iterator<Item = Box<dyn Observer + Send>> {
        std::mem::take(&mut self.0).into_iter().map(|(_, observer)| observer)
    }
}

impl Running {
    /// Whether there is an observer.
    pub fn is_observed(&self) -> bool {
        !self.observers.is_empty() || !self.resting.0.is_empty()
    }

    /// Adds an observer.
    pub fn observe_by(&mut self, observer: Box<dyn Observer + Send>) {
        self.changed = Triggers::ALL;
        self.observers.push(observer);
        self.let_rest();
    }

    /// Lets observers rest until the instant before they need a sample.
    pub fn let_rest(&mut self) {
        let now = self.timeline.time();
        if self.observers.iter().all(|observer| observer.needs(now) <= now) {
            return;
        }
        let periods = self.program.clocks.iter().map(|clock| clock.period);
        let most = periods.min().unwrap_or(DEFAULT_PERIOD.picoseconds());
        // A sample has the values since the last instant, which is at most the shortest period ago.
        let until = |observer: &dyn Observer| match observer.needs(now) {
            u64::MAX => u64::MAX,
            needed => needed.saturating_sub(most),
        };
        for observer in std::mem::take(&mut self.observers) {
            match until(&*observer) {
                until if until > now => self.resting.0.push((until, observer)),
                _ => self.observers.push(observer),
            }
        }
        self.pause_at = self.next_pause();
    }

    /// Wakes the observers that may need a sample now.
    pub fn wake(&mut self) {
        let now = self.timeline.time();
        if self.resting.until() <= now {
            let (due, resting) = std::mem::take(&mut self.resting.0).into_iter().partition(|(until, _)| *until <= now);
            self.resting.0 = resting;
            self.observers.extend(due.into_iter().map(|(_, observer)| observer));
            // They have not seen what changed meanwhile.
            self.changed = Triggers::ALL;
        }
    }
}
