//! What takes part in a measurement: something that runs a design for so many cycles.

use crate::error::Error;
use crate::report::Made;
use std::time::Duration;

/// A simulator with a design in it.
pub trait Contender {
    /// Its name, for a table.
    fn name(&self) -> &str;

    /// What made it of what, if it is a model that Verilator made.
    fn made(&self) -> Option<&Made> {
        None
    }

    /// How long it took to make it, if that is not part of a run.
    fn build_time(&self) -> Option<Duration>;

    /// How many stimuli it runs at once.
    fn stimuli(&self) -> u32 {
        1
    }

    /// Runs the design from its reset for so many cycles, at least 1. A cycle is a time at which one or more clocks rise.
    ///
    /// # Errors
    ///
    /// It cannot be run.
    fn run(&self, cycles: u64) -> Result<Run, Error>;
}

/// What a run comes to.
#[derive(Debug, Clone)]
pub struct Run {
    /// At the end, by stimulus: at least one.
    pub checksums: Vec<u32>,
    /// From nothing to the end of the first cycle.
    pub first_cycle: Duration,
    /// The other cycles.
    pub others: Duration,
}
