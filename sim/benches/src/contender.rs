//! The participants of a measurement: each runs a design for some cycles.

use crate::error::Error;
use crate::report::Made;
use std::time::Duration;

/// A simulator with a design in it.
pub trait Contender {
    /// Its name, for a table.
    fn name(&self) -> &str;

    /// What made it, if it is a model made by Verilator.
    fn made(&self) -> Option<&Made> {
        None
    }

    /// The build time, if that is not part of a run.
    fn build_time(&self) -> Option<Duration>;

    /// The number of stimuli that it runs at once.
    fn stimuli(&self) -> u32 {
        1
    }

    /// Runs the design from its reset for `cycles` cycles, at least 1. A cycle is a time at which one or more clocks
    /// rise.
    ///
    /// # Errors
    ///
    /// It cannot be run.
    fn run(&self, cycles: u64) -> Result<Run, Error>;
}

/// The result of a run.
#[derive(Debug, Clone)]
pub struct Run {
    /// At the end, by stimulus: at least one.
    pub checksums: Vec<u32>,
    /// The time from nothing to the end of the first cycle.
    pub first_cycle: Duration,
    /// The time of the other cycles.
    pub others: Duration,
}
