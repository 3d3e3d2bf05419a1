//! Delay lines: a signal and its delayed copies, one register after another.

use crate::prelude::*;

/// The signal and its copies delayed by 1, 2, .. `clocks` clocks. `name1` is the first register. The registers have no
/// reset.
#[track_caller]
pub(crate) fn delays(m: Module, name: &str, clocks: u32, signal: Signal) -> Vec<Signal> {
    let mut delays = vec![signal];
    for clock in 1..=clocks {
        delays.push(m.pipe(&format!("{name}{clock}"), *delays.last().expect("the first is the signal")));
    }
    delays
}

/// Like [`delays`], for a flag. A reset clears the registers, so every flag at the end has been sent.
#[track_caller]
pub(crate) fn mark_delays(m: Module, name: &str, clocks: u32, flag: Signal) -> Vec<Signal> {
    let mut delays = vec![flag];
    for clock in 1..=clocks {
        let later = m.reg(&format!("{name}{clock}"), bit()).reset(0);
        later.next(*delays.last().expect("the first is the flag"));
        delays.push(*later);
    }
    delays
}
