//! Letting time pass.

use tilewright_hdl::Bundle;

use crate::testbench::error::{Error, UnknownName};
use crate::testbench::simulation::Simulation;

impl<I: Bundle, O: Bundle> Simulation<I, O> {
    /// Goes to the next instant at which a clock rises, and through the edges there.
    ///
    /// # Panics
    ///
    /// An assertion of the design does not hold, a trace cannot be written, or there is no clock.
    #[track_caller]
    #[inline]
    pub fn step(&mut self) {
        self.circuit.step();
    }

    /// As [`Simulation::step`], `n` times.
    ///
    /// # Panics
    ///
    /// As [`Simulation::step`].
    #[track_caller]
    pub fn run(&mut self, n: u64) {
        done(self.try_run(n));
    }

    /// Runs through every instant up to and including that time in picoseconds.
    ///
    /// # Panics
    ///
    /// As [`Simulation::step`].
    #[track_caller]
    pub fn run_to(&mut self, time: u64) {
        done(self.try_run_to(time));
    }

    /// Runs until a clock, or one of that name, has risen `n` more times; other clocks rise as they may.
    ///
    /// # Panics
    ///
    /// There is no such clock; or as [`Simulation::step`].
    #[track_caller]
    pub fn step_clock(&mut self, clock: impl AsRef<str>, n: u64) {
        let index = match self.circuit.clock(clock.as_ref()) {
            Ok(index) => index,
            Err(unknown) => panic!("{unknown}"),
        };
        let end = self.circuit.timeline.cycles(index) + n;
        while self.circuit.timeline.cycles(index) < end {
            done(self.try_step());
        }
    }

    /// Holds every reset high for one edge of every clock, then low.
    ///
    /// # Panics
    ///
    /// As [`Simulation::step`].
    #[track_caller]
    pub fn reset(&mut self) {
        done(self.try_reset());
    }

    /// As [`Simulation::step`], for a program that reports errors itself.
    ///
    /// # Errors
    ///
    /// [`Error::Violated`] if assertions do not hold before the edge, which then does not happen; [`Error::Trace`] if a
    /// file could not be written at an instant before; [`Error::NoClock`]; [`Error::Differs`].
    pub fn try_step(&mut self) -> Result<(), Error> {
        self.circuit.try_step()
    }

    /// As [`Simulation::reset`]; after an error the resets stay high.
    ///
    /// # Errors
    ///
    /// As [`Simulation::try_step`].
    pub fn try_reset(&mut self) -> Result<(), Error> {
        self.circuit.try_reset()
    }

    /// As [`Simulation::run`].
    ///
    /// # Errors
    ///
    /// As [`Simulation::try_step`].
    pub fn try_run(&mut self, n: u64) -> Result<(), Error> {
        self.circuit.try_run(n)
    }

    /// As [`Simulation::run_to`].
    ///
    /// # Errors
    ///
    /// As [`Simulation::try_step`].
    pub fn try_run_to(&mut self, time: u64) -> Result<(), Error> {
        self.circuit.try_run_to(time)
    }

    /// Ends every trace: writes what is left of it.
    ///
    /// # Errors
    ///
    /// [`Error::Trace`] for the first file that could not be written to its end; the others are. [`Error::Differs`].
    pub fn finish(&mut self) -> Result<(), Error> {
        self.circuit.finish()
    }

    /// The time of the last instant in picoseconds; 0 before the first.
    pub fn time(&self) -> u64 {
        self.circuit.timeline.time
    }

    /// How many times a clock, or one of that name, has risen.
    ///
    /// # Errors
    ///
    /// There is no such clock.
    pub fn cycles(&self, clock: impl AsRef<str>) -> Result<u64, UnknownName> {
        Ok(self.circuit.timeline.cycles(self.circuit.clock(clock.as_ref())?))
    }
}

#[track_caller]
pub(crate) fn done(result: Result<(), Error>) {
    if let Err(error) = result {
        panic!("{error}");
    }
}
