//! Letting time pass.

use tilewright_hdl::Bundle;

use crate::engine::Failed;
use crate::engine::program::Triggers;
use crate::testbench::error::{Error, UnknownName, Violation};
use crate::testbench::simulation::Simulation;
use crate::testbench::trace::View;

impl<I: Bundle, O: Bundle> Simulation<I, O> {
    /// Goes to the next instant at which a clock rises, and through the edges there.
    ///
    /// # Panics
    ///
    /// An assertion of the design does not hold, a trace cannot be written, or there is no clock.
    #[track_caller]
    pub fn step(&mut self) {
        done(self.try_step());
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
    pub fn run_until(&mut self, time: u64) {
        done(self.try_run_until(time));
    }

    /// Runs until a clock, by its name, has risen `n` more times; other clocks rise as they may.
    ///
    /// # Panics
    ///
    /// There is no such clock; or as [`Simulation::step`].
    #[track_caller]
    pub fn step_clock(&mut self, clock: &str, n: u64) {
        let index = match self.clock(clock) {
            Ok(index) => index,
            Err(unknown) => panic!("{unknown}"),
        };
        let end = self.timeline.cycles(index) + n;
        while self.timeline.cycles(index) < end {
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

    fn set_reset(&mut self, clock: usize, high: bool) {
        self.resets[clock] = high;
        self.engine.set_reset(clock, high);
    }

    /// As [`Simulation::step`], for a program that reports errors itself.
    ///
    /// # Errors
    ///
    /// [`Error::Violated`] if assertions do not hold before the edge, which then does not happen; [`Error::Trace`] if a
    /// file could not be written at an instant before; [`Error::NoClock`]; [`Error::Differs`].
    pub fn try_step(&mut self) -> Result<(), Error> {
        let until = self.timeline.next_time().ok_or(Error::NoClock)?;
        self.timeline.rising_at(until, &mut self.rising);
        if !self.observers.is_empty() {
            let failed = self.engine.check(&self.rising);
            self.engine.agree()?;
            self.observe(until)?;
            if !failed.is_empty() {
                self.observers.iter_mut().for_each(|observer| observer.failed());
                return Err(self.violated(failed, until));
            }
        }
        let done = self.engine.edges(&self.rising, 1)?;
        if done.edges == 0 {
            let failed = self.engine.check(&self.rising);
            return Err(self.violated(failed, until));
        }
        self.changed = self.changed.with(done.changed);
        self.timeline.advance(until, &self.rising);
        Ok(())
    }

    /// As [`Simulation::reset`]; after an error the resets stay high.
    ///
    /// # Errors
    ///
    /// As [`Simulation::try_step`].
    pub fn try_reset(&mut self) -> Result<(), Error> {
        (0..self.resets.len()).for_each(|clock| self.set_reset(clock, true));
        let before: Vec<u64> = (0..self.resets.len()).map(|clock| self.timeline.cycles(clock)).collect();
        while (0..before.len()).any(|clock| self.timeline.cycles(clock) == before[clock]) {
            self.try_step()?;
        }
        (0..self.resets.len()).for_each(|clock| self.set_reset(clock, false));
        Ok(())
    }

    /// As [`Simulation::run`].
    ///
    /// # Errors
    ///
    /// As [`Simulation::try_step`].
    pub fn try_run(&mut self, n: u64) -> Result<(), Error> {
        if self.program.clocks.len() > 1 || !self.observers.is_empty() {
            return (0..n).try_for_each(|_| self.try_step());
        }
        // Instants follow each other alike.
        let until = self.timeline.next_time().ok_or(Error::NoClock)?;
        let done = self.engine.edges(&[0], n)?;
        self.timeline.repeat(done.edges);
        if done.edges < n {
            let failed = self.engine.check(&[0]);
            let period = self.program.clocks[0].period;
            return Err(self.violated(failed, until + done.edges * period));
        }
        Ok(())
    }

    /// As [`Simulation::run_until`].
    ///
    /// # Errors
    ///
    /// As [`Simulation::try_step`].
    pub fn try_run_until(&mut self, time: u64) -> Result<(), Error> {
        while self.timeline.next_time().ok_or(Error::NoClock)? <= time {
            self.try_step()?;
        }
        Ok(())
    }

    /// Ends every trace: writes what is left of it.
    ///
    /// # Errors
    ///
    /// [`Error::Trace`] for the first file that could not be written to its end; the others are. [`Error::Differs`].
    pub fn finish(&mut self) -> Result<(), Error> {
        let until = self.timeline.next_time().unwrap_or(1);
        self.rising.clear();
        let mut observers = std::mem::take(&mut self.observers);
        let ends: Vec<_> = observers.iter_mut().map(|observer| observer.finish(&mut self.view(until))).collect();
        ends.into_iter().collect::<Result<(), Error>>()?;
        Ok(self.engine.agree()?)
    }

    /// The time of the last instant in picoseconds; 0 before the first.
    pub fn time(&self) -> u64 {
        self.timeline.time
    }

    /// How many times a clock, by its name, has risen.
    ///
    /// # Errors
    ///
    /// There is no such clock.
    pub fn cycles(&self, clock: &str) -> Result<u64, UnknownName> {
        Ok(self.timeline.cycles(self.clock(clock)?))
    }

    pub(crate) fn clock(&self, name: &str) -> Result<usize, UnknownName> {
        let clocks = &self.program.clocks;
        clocks.iter().position(|clock| clock.name == name || clock.port == name).ok_or_else(|| {
            UnknownName::new("clock", name, &clocks.iter().map(|clock| clock.name.clone()).collect::<Vec<_>>())
        })
    }

    /// Shows the circuit before an edge to every trace.
    fn observe(&mut self, until: u64) -> Result<(), Error> {
        let mut observers = std::mem::take(&mut self.observers);
        let result = observers.iter_mut().try_for_each(|observer| observer.sample(&mut self.view(until)));
        self.observers = observers;
        self.observers.retain(|observer| !observer.is_over());
        if result.is_ok() {
            self.changed = Triggers::NONE;
        }
        result
    }

    fn view(&mut self, until: u64) -> View<'_> {
        View {
            program: &self.program,
            engine: &mut *self.engine,
            since: self.timeline.time,
            until,
            rising: &self.rising,
            resets: &self.resets,
            changed: self.changed,
        }
    }

    fn violated(&self, failed: Vec<Failed>, time: u64) -> Error {
        Error::Violated(failed.into_iter().map(|it| self.violation(it, time)).collect())
    }

    fn violation(&self, failed: Failed, time: u64) -> Violation {
        let assert = &self.program.asserts[failed.assert as usize];
        let hierarchy = &self.program.hierarchy;
        let place = hierarchy.instance(&assert.scopes, failed.lane / assert.group);
        let path = hierarchy.path(place);
        Violation {
            message: assert.message.clone(),
            run: (self.program.lanes() > 1).then(|| hierarchy.run(place)),
            instance: if path.is_empty() { hierarchy.scopes[0].name.clone() } else { path },
            clock: self.program.clocks[assert.clock as usize].name.clone(),
            cycle: self.timeline.cycles(assert.clock as usize),
            time,
            loc: assert.loc,
        }
    }
}

#[track_caller]
fn done(result: Result<(), Error>) {
    if let Err(error) = result {
        panic!("{error}");
    }
}
