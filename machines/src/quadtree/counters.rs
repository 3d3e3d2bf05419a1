//! What the hardware counts of itself, since its reset and modulo 2^32; a frame's part of it is a difference.

use super::report::{ProcessorReport, UnitReport};

/// All counters at a moment.
#[derive(Clone, Debug)]
pub(crate) struct Counters {
    /// By video processor, row by row.
    pub processors: Vec<ProcessorCounts>,
    pub broadcast_stalls: u32,
}

/// Those of a video processor.
#[derive(Clone, Debug)]
pub(crate) struct ProcessorCounts {
    /// The set-up, and then the raster processor's levels.
    pub units: Vec<UnitCounts>,
    pub fragments: u32,
}

/// Those of a unit, or of all units of a level.
#[derive(Clone, Copy, Debug)]
pub(crate) struct UnitCounts {
    pub busy: u32,
    pub stalled: u32,
    pub windows: u32,
}

/// What was counted between two moments; a frame counts less than 2^32.
fn since(now: u32, before: u32) -> u64 {
    now.wrapping_sub(before).into()
}

impl Counters {
    /// What each video processor did since `before`.
    pub fn each_since(&self, before: &Counters) -> Vec<ProcessorReport> {
        let unit = |(now, before): (&UnitCounts, &UnitCounts)| UnitReport {
            windows: since(now.windows, before.windows),
            busy: since(now.busy, before.busy),
            stalled: since(now.stalled, before.stalled),
        };
        let processor = |(now, before): (&ProcessorCounts, &ProcessorCounts)| ProcessorReport {
            units: now.units.iter().zip(&before.units).map(unit).collect(),
            fragments: since(now.fragments, before.fragments),
        };
        self.processors.iter().zip(&before.processors).map(processor).collect()
    }

    /// Clocks in which a packet of the broadcast waited for room since `before`.
    pub fn broadcast_stalls_since(&self, before: &Counters) -> u64 {
        since(self.broadcast_stalls, before.broadcast_stalls)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_counter_may_wrap_around_within_a_frame() {
        let at = |count: u32| {
            let unit = UnitCounts { busy: count, stalled: 0, windows: 1 };
            Counters {
                processors: vec![ProcessorCounts { units: vec![unit], fragments: count }],
                broadcast_stalls: count,
            }
        };
        let (before, now) = (at(u32::MAX - 1), at(5));
        let unit = UnitReport { windows: 0, busy: 7, stalled: 0 };
        assert_eq!(now.each_since(&before), [ProcessorReport { units: vec![unit], fragments: 7 }]);
        assert_eq!(now.broadcast_stalls_since(&before), 7);
    }
}
