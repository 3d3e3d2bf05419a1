//! Rows whose lanes are computed one after another, with one adder.

use crate::prelude::*;

/// A row that is filled lane by lane.
pub(super) struct Filled {
    /// The lanes written so far.
    pub kept: Signal,
    /// The lanes, including the one written in this clock.
    pub row: Signal,
}

/// A register with `lanes` lanes; lane number `step` becomes `value` while `enable` is high.
pub(super) fn lane_by_lane(m: Module, name: &str, lanes: u32, enable: Signal, step: Signal, value: Signal) -> Filled {
    let kept = m.reg(name, bits(value.width()).of(row(lanes)));
    let row = mux(numbers(step.width(), lanes).eq(step), value, *kept);
    kept.when(enable, row);
    Filled { kept: *kept, row }
}

/// The number of each lane.
pub(super) fn numbers(width: u32, lanes: u32) -> Signal {
    constants(bits(width).of(row(lanes)), |lane| lane)
}
