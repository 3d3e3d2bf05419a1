//! Letting time pass for many runs at once.

use tilewright_hdl::Bundle;

use super::Batch;
use crate::testbench::error::{Error, UnknownName};

impl<I: Bundle, O: Bundle> Batch<I, O> {
    /// Takes all runs to the next instant at which a clock rises, and through the edges there.
    ///
    /// # Panics
    ///
    /// An assertion of the design does not hold in some run, a trace cannot be written, or there is no clock.
    #[track_caller]
    pub fn step(&mut self) {
        self.ready().step();
    }

    /// As [`Batch::step`], `n` times.
    ///
    /// # Panics
    ///
    /// As [`Batch::step`].
    #[track_caller]
    pub fn run(&mut self, n: u64) {
        self.ready().run(n);
    }

    /// Takes all runs through every instant up to and including that time in picoseconds.
    ///
    /// # Panics
    ///
    /// As [`Batch::step`].
    #[track_caller]
    pub fn run_to(&mut self, time: u64) {
        self.ready().run_to(time);
    }

    /// Takes all runs to where a clock, or one of that name, has risen `n` more times; other clocks rise as they may.
    ///
    /// # Panics
    ///
    /// There is no such clock; or as [`Batch::step`].
    #[track_caller]
    pub fn step_clock(&mut self, clock: impl AsRef<str>, n: u64) {
        self.ready().step_clock(clock, n);
    }

    /// Holds every reset of all runs high for one edge of every clock, then low.
    ///
    /// # Panics
    ///
    /// As [`Batch::step`].
    #[track_caller]
    pub fn reset(&mut self) {
        self.ready().reset();
    }

    /// As [`Batch::step`], for a program that reports errors itself.
    ///
    /// # Errors
    ///
    /// As [`Simulation::try_step`](crate::Simulation::try_step): if assertions do not hold in some runs, the edge
    /// happens in none.
    pub fn try_step(&mut self) -> Result<(), Error> {
        self.ready().try_step()
    }

    /// As [`Batch::run`].
    ///
    /// # Errors
    ///
    /// As [`Batch::try_step`].
    pub fn try_run(&mut self, n: u64) -> Result<(), Error> {
        self.ready().try_run(n)
    }

    /// As [`Batch::run_to`].
    ///
    /// # Errors
    ///
    /// As [`Batch::try_step`].
    pub fn try_run_to(&mut self, time: u64) -> Result<(), Error> {
        self.ready().try_run_to(time)
    }

    /// As [`Batch::reset`]; after an error the resets stay high.
    ///
    /// # Errors
    ///
    /// As [`Batch::try_step`].
    pub fn try_reset(&mut self) -> Result<(), Error> {
        self.ready().try_reset()
    }

    /// Ends every trace: writes what is left of it.
    ///
    /// # Errors
    ///
    /// [`Error::Trace`] for the first file that could not be written to its end; the others are.
    pub fn finish(&mut self) -> Result<(), Error> {
        self.ready().finish()
    }

    /// The time of the last instant in picoseconds; 0 before the first.
    pub fn time(&self) -> u64 {
        self.all.time()
    }

    /// How many times a clock, or one of that name, has risen.
    ///
    /// # Errors
    ///
    /// There is no such clock.
    pub fn cycles(&self, clock: impl AsRef<str>) -> Result<u64, UnknownName> {
        self.all.cycles(clock)
    }
}
