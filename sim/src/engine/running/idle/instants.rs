//! Many instants of several clocks, while nobody sets or sees anything.
//!
//! At most instants one clock rises, and its function is known: a whole edge, or the remaining work while the clock
//! rests. Then only values that may have changed since its last edge are checked. The caller handles all other
//! instants.

use super::Clocks;
use crate::engine::Ticks;
use crate::engine::program::Triggers;
use crate::engine::running::Compiled;

impl Compiled {
    /// Executes the next instants up to a time, as long as they are plain.
    pub(in crate::engine::running) fn plain_instants(&mut self, ticks: &mut [Ticks], until: u64) {
        if ticks.len() > Clocks::BITS as usize || self.parked.is_empty() || self.any_reset || !self.versions.is_empty()
        {
            return;
        }
        if std::mem::take(&mut self.stirred) {
            self.wake_clocks();
        }
        self.renew_ready();
        self.looked = false;
        // The clocks for which it is not known whether the state of others is unchanged.
        let mut unseen = Clocks::MAX;
        while let Some((clock, most)) = alone(ticks, until) {
            let edges = match self.idle.get(clock) {
                Some(Some(idle)) if idle.rests => self.resting_edges(clock, most, unseen >> clock & 1 == 1),
                _ => self.working_edges(clock, most),
            };
            if edges == 0 {
                return;
            }
            ticks[clock].cycles += edges;
            self.change(Triggers::state(clock));
            unseen = unseen & !(1 << clock) | self.seen_by.get(clock).copied().unwrap_or(0);
        }
    }

    /// Executes at most `most` edges of a resting clock, none if it must wake; returns the number.
    #[inline]
    fn resting_edges(&mut self, clock: usize, most: u64, is_unseen: bool) -> u64 {
        let Some(idle) = &self.idle[clock] else { return 0 };
        if is_unseen && !self.sees_same(idle) {
            return 0;
        }
        let steps = idle.ways.get(idle.latest).and_then(|way| way.steps);
        let edges = most - steps.map_or(0, |steps| self.call(steps, most));
        self.idle_edges += edges;
        edges
    }

    /// Executes at most `most` edges of a working clock, none if something must be checked before or fails; returns
    /// the number.
    #[inline]
    fn working_edges(&mut self, clock: usize, most: u64) -> u64 {
        let Some((ready, left)) = &self.parked[clock] else { return 0 };
        let code = ready.code();
        let until_compared =
            self.idle.get(clock).and_then(Option::as_ref).map_or(u64::MAX, |idle| idle.left.saturating_sub(1));
        let most = most.min(*left).min(until_compared);
        if most == 0 {
            return 0;
        }
        let edges = most - self.call(code, most);
        if let Some((_, left)) = &mut self.parked[clock] {
            *left -= edges;
        }
        if let Some(Some(idle)) = self.idle.get_mut(clock) {
            idle.left -= edges;
        }
        edges
    }
}

/// The clock that rises alone at the next instant, if that comes by `until`, and the number of its edges before
/// another clock's.
#[inline]
fn alone(ticks: &[Ticks], until: u64) -> Option<(usize, u64)> {
    let (mut first, mut at, mut others) = (0, u64::MAX, u64::MAX);
    for (clock, ticks) in ticks.iter().enumerate() {
        let next = ticks.next()?;
        if next < at {
            (first, others, at) = (clock, at, next);
        } else {
            others = others.min(next);
        }
    }
    if at > until || at == others {
        return None;
    }
    let (period, last) = (ticks[first].period, until.min(others - 1));
    let edges = if last - at < period { 1 } else { (last - at) / period + 1 };
    Some((first, edges))
}
