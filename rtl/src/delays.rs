//! Signals, and what they were some clocks ago: one register behind another.

use crate::prelude::*;

/// The signal, and the same some clocks later each, up to so many; `name1` is the first register. They have no reset.
#[track_caller]
pub(crate) fn delays(m: Module, name: &str, clocks: u32, signal: Signal) -> Vec<Signal> {
    let mut delays = vec![signal];
    for clock in 1..=clocks {
        delays.push(m.pipe(&format!("{name}{clock}"), *delays.last().expect("there is the signal")));
    }
    delays
}

/// As [`delays`] of a mark, which a reset clears: it does not come before it is sent.
#[track_caller]
pub(crate) fn mark_delays(m: Module, name: &str, clocks: u32, mark: Signal) -> Vec<Signal> {
    let mut delays = vec![mark];
    for clock in 1..=clocks {
        let later = m.reg(&format!("{name}{clock}"), bit()).reset(0);
        later.next(*delays.last().expect("there is the mark"));
        delays.push(*later);
    }
    delays
}
