//! A unit's counters of its own work.

use crate::prelude::*;

record! {
    /// The work of a unit, in clocks since the reset and modulo 2^32. A clock in which it waits for work is not
    /// counted.
    pub struct Tally {
        /// Clocks in which the unit worked.
        busy: bits(32),
        /// Clocks in which the unit had a result that was not taken.
        stalled: bits(32),
        /// Results that the unit delivered.
        results: bits(32),
    }
}

impl Tally {
    /// Counts the clocks in which each of the three is high.
    pub(super) fn count(m: Module, is: Tally) -> Tally {
        let counter = |what: &str, is: Signal| {
            let count = m.reg(what, 32).reset(0);
            count.when(is, count + 1);
            *count
        };
        Tally {
            busy: counter("busy", is.busy),
            stalled: counter("stalled", is.stalled),
            results: counter("results", is.results),
        }
    }
}
