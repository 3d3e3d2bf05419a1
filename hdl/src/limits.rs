//! Limits on the width of a signal, the size of a design, and the period of a clock.

use crate::elaboration::{self, Elaboration};
use crate::integers::{self, Integer};
use std::fmt;
use tilewright_circuit::ir::NodeId;
use tilewright_circuit::{Loc, Mistake, Period, Problem};

pub(crate) use tilewright_circuit::limits::{DEEPEST, MOST_LANES, WIDEST};

/// The most ports in a list.
pub(crate) const MOST_PORTS: u32 = 1 << 16;

/// The most stages of a pipeline.
const MOST_STAGES: u32 = 1 << 16;

/// The longest period of a clock, in picoseconds: 18 minutes.
pub(crate) const LONGEST_PERIOD: u64 = 1 << 50;

/// A valid width for `what`. No bits, or more than [`WIDEST`], are a problem, and the nearest width stands in.
/// `operands` are the nodes that it is made of.
pub(crate) fn sound_width(
    e: &mut Elaboration,
    operands: &[NodeId],
    what: impl fmt::Display,
    width: u64,
    loc: Loc,
) -> u32 {
    let sound = width.clamp(1, WIDEST.into());
    if sound == width {
        return sound as u32;
    }
    let problem = match width {
        0 => Problem::new(Mistake::NoBits, loc, format!("{what} has no bits")).help("a width is at least 1"),
        _ => Problem::new(Mistake::TooWide, loc, format!("{what} of {width} bits is wider than {WIDEST}"))
            .help("keep wide data in a memory"),
    };
    e.report_instead_of(operands, problem);
    sound as u32
}

/// A number of stages; too many are a problem, and one stands in.
#[track_caller]
pub(crate) fn sound_stages(count: impl Integer, loc: Loc) -> u32 {
    let stages = integers::count(count);
    if stages <= MOST_STAGES {
        return stages;
    }
    let problem =
        Problem::new(Mistake::TooManyStages, loc, format!("a pipeline of {stages} stages has more than {MOST_STAGES}"));
    elaboration::with(|e| e.report(problem.help("a memory can delay by as many clocks as it has words")));
    1
}

/// Reports a period that a clock cannot have.
pub(crate) fn check_period(e: &mut Elaboration, clock: &str, period: Period, loc: Loc) {
    if period.picoseconds() > LONGEST_PERIOD {
        let message = format!("{clock} has a period of {period}, more than {LONGEST_PERIOD} ps");
        e.report(
            Problem::new(Mistake::LongPeriod, loc, message)
                .help("a period is some nanoseconds, and 18 minutes at most"),
        );
    }
}
