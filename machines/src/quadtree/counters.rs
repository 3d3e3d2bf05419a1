//! The hardware's counters, since its reset and modulo 2^32. The counts of a frame are differences.

use super::model::{Counts, Processor};
use super::report::{ProcessorReport, UnitReport};

/// All counters at one time.
#[derive(Clone, Debug)]
pub(crate) struct Counters {
    /// By video processor, row by row.
    pub processors: Vec<Processor>,
    pub broadcast: Counts,
}

/// The counts between two times; a frame counts less than 2^32.
fn since(now: u64, before: u64) -> u64 {
    (now as u32).wrapping_sub(before as u32).into()
}

impl Counters {
    /// The counts of each video processor since `before`.
    pub fn each_since(&self, before: &Counters) -> Vec<ProcessorReport> {
        let unit = |(now, before): (&Counts, &Counts)| UnitReport {
            windows: since(now.results, before.results),
            busy: since(now.busy, before.busy),
            stalled: since(now.stalled, before.stalled),
        };
        let processor = |(now, before): (&Processor, &Processor)| ProcessorReport {
            units: now.units.iter().zip(&before.units).map(unit).collect(),
            fragments: since(now.fragments, before.fragments),
        };
        self.processors.iter().zip(&before.processors).map(processor).collect()
    }

    /// Clocks in which a packet of the broadcast waited for room since `before`.
    pub fn broadcast_stalls_since(&self, before: &Counters) -> u64 {
        since(self.broadcast.stalled, before.broadcast.stalled)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_counter_may_wrap_around_within_a_frame() {
        let at = |count: u32| {
            let count = count.into();
            let unit = Counts { busy: count, stalled: 0, results: 1 };
            Counters {
                processors: vec![Processor { units: vec![unit], fragments: count }],
                broadcast: Counts { stalled: count, ..Counts::default() },
            }
        };
        let (before, now) = (at(u32::MAX - 1), at(5));
        let unit = UnitReport { windows: 0, busy: 7, stalled: 0 };
        assert_eq!(now.each_since(&before), [ProcessorReport { units: vec![unit], fragments: 7 }]);
        assert_eq!(now.broadcast_stalls_since(&before), 7);
    }
}
