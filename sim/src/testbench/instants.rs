//! Advancing a running circuit in time.

use tilewright_circuit::Reset;

use crate::engine::Failed;
use crate::engine::program::{self, Triggers};
use crate::testbench::error::{Error, UnknownName, Violation};
use crate::testbench::past::Change;
use crate::testbench::run::done;
use crate::testbench::running::Running;
use crate::testbench::trace::View;

impl Running {
    /// Sets whether a clock's reset is active; without effect on a clock that has none.
    pub fn set_reset(&mut self, clock: usize, active: bool) {
        if self.resets[clock] == active || self.program.clocks[clock].kind == Reset::PowerOn {
            return;
        }
        self.note(|| Change::Reset(clock as u32, active));
        self.cover_reset(clock, active);
        self.resets[clock] = active;
        self.reset_since[clock] = self.timeline.time();
        self.engine.set_reset(clock, active);
        self.may_have_changed(Triggers::state(clock));
    }

    /// Sets whether the reset of the clock with this name is active.
    #[track_caller]
    pub fn set_reset_of(&mut self, name: &str, active: bool) {
        let clock = self.clock(name).unwrap_or_else(|unknown| panic!("{unknown}"));
        let program::Clock { name, kind, .. } = &self.program.clocks[clock];
        assert!(
            *kind != Reset::PowerOn,
            "clock `{name}` has no reset: its registers have their values at power-on in a new simulation"
        );
        // A recording has the resets at edges: no replay would show a pulse between two.
        let is_pulse = self.resets[clock] && !active && self.reset_since[clock] == self.timeline.time();
        assert!(
            !is_pulse || !kind.is_asynchronous(),
            "the reset of clock `{name}` is released at the time at which it became active: step in between"
        );
        self.set_reset(clock, active);
    }

    /// Like [`Running::try_step`].
    ///
    /// # Panics
    ///
    /// There is an error.
    #[track_caller]
    #[inline]
    pub fn step(&mut self) {
        if !self.quick_step() {
            self.slow_step();
        }
    }

    #[track_caller]
    #[cold]
    fn slow_step(&mut self) {
        done(self.try_step());
    }

    /// Advances to the next instant, if there is a fast path.
    #[inline]
    fn quick_step(&mut self) -> bool {
        let timeline = &self.timeline;
        let is_free = self.observers.is_empty() && timeline.room() > 0 && timeline.time_of_first() < self.pause_at;
        let is_done = is_free && self.engine.quick_edge();
        if is_done {
            self.timeline.repeat(1);
        }
        is_done
    }

    /// Advances to the next instant and through its edges.
    #[inline]
    pub fn try_step(&mut self) -> Result<(), Error> {
        if self.quick_step() {
            return Ok(());
        }
        self.attend();
        if self.is_plain() {
            return self.repeat(1);
        }
        if self.rows(1)? == 1 {
            return Ok(());
        }
        self.single_step()
    }

    /// Advances to the next instant, with all checks and observers, and through its edges.
    fn single_step(&mut self) -> Result<(), Error> {
        let until = self.timeline.next_time().ok_or(Error::Late)?;
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
        self.rise(until)
    }

    /// Executes the edges of the clocks that rise then.
    fn rise(&mut self, until: u64) -> Result<(), Error> {
        if self.rising.is_empty() {
            self.timeline.advance(&[]);
            return Ok(());
        }
        let done = self.engine.edges(&self.rising, 1)?;
        if done.edges == 0 {
            let failed = self.engine.check(&self.rising);
            return Err(self.violated(failed, until));
        }
        self.may_have_changed(done.changed);
        self.timeline.advance(&self.rising);
        Ok(())
    }

    /// Executes the next instants that the only observer takes in rows, perhaps none. It stops before an instant at
    /// which an assertion fails.
    fn rows(&mut self, n: u64) -> Result<u64, Error> {
        if self.program.clocks.len() != 1 || self.observers.len() != 1 {
            return Ok(0);
        }
        let (until, n) = match self.timeline.next_time() {
            Some(until) => (until, n.min(self.timeline.room()).min(self.until_pause())),
            None => return Ok(0),
        };
        self.timeline.rising_at(until, &mut self.rising);
        let mut observers = std::mem::take(&mut self.observers);
        let done = observers[0].rows(&mut self.view(until), n);
        self.observers = observers;
        let done = done?;
        if done.edges > 0 {
            self.changed = done.changed;
            self.timeline.repeat(done.edges);
        }
        Ok(done.edges)
    }

    /// An edge of every clock with every reset active.
    pub fn try_reset(&mut self) -> Result<(), Error> {
        (0..self.resets.len()).for_each(|clock| self.set_reset(clock, true));
        let before: Vec<u64> = (0..self.resets.len()).map(|clock| self.timeline.cycles(clock)).collect();
        while (0..before.len()).any(|clock| self.timeline.cycles(clock) == before[clock]) {
            self.try_step()?;
        }
        (0..self.resets.len()).for_each(|clock| self.set_reset(clock, false));
        Ok(())
    }

    /// Executes `n` instants.
    pub fn try_run(&mut self, n: u64) -> Result<(), Error> {
        match self.is_plain() {
            // An engine counts down to the last edge, so it executes at least one.
            true if n == 0 => Ok(()),
            true => self.repeat(n),
            false => self.repeat_seen(n),
        }
    }

    /// Executes `n` instants with observers.
    fn repeat_seen(&mut self, n: u64) -> Result<(), Error> {
        let mut left = n;
        while left > 0 {
            self.attend();
            if self.is_plain() {
                return self.repeat(left);
            }
            let rows = self.rows(left)?;
            if rows == 0 {
                self.single_step()?;
            }
            left -= rows.max(1);
        }
        Ok(())
    }

    /// Whether all instants are alike: there is one clock and no observer.
    pub fn is_plain(&self) -> bool {
        self.program.clocks.len() == 1 && self.observers.is_empty()
    }

    /// Executes `n` edges of the only clock.
    fn repeat(&mut self, n: u64) -> Result<(), Error> {
        let mut left = n;
        // An engine counts down to the last edge, so it executes at least one.
        while left > 0 {
            self.attend();
            if !self.is_plain() {
                return self.repeat_seen(left);
            }
            let fits = left.min(self.timeline.room()).min(self.until_pause());
            if fits == 0 {
                return Err(Error::Late);
            }
            let done = self.engine.edges(&[0], fits)?;
            self.timeline.repeat(done.edges);
            if done.edges < fits {
                return Err(self.stopped());
            }
            left -= fits;
        }
        Ok(())
    }

    /// Why the only clock does not rise.
    #[cold]
    pub fn stopped(&mut self) -> Error {
        let failed = self.engine.check(&[0]);
        self.violated(failed, self.timeline.next_time().unwrap_or(u64::MAX))
    }

    /// Executes every instant up to and including this time.
    pub fn try_run_to(&mut self, time: u64) -> Result<(), Error> {
        while let next = self.timeline.next_time().ok_or(Error::Late)?
            && next <= time
        {
            if self.observers.is_empty() && self.program.clocks.len() > 1 {
                self.run_unseen_to(time)?;
                continue;
            }
            match &self.program.clocks[..] {
                [clock] => self.try_run((time - next) / clock.period + 1)?,
                _ => self.try_step()?,
            }
        }
        Ok(())
    }

    /// The same for several clocks, until there is an observer.
    fn run_unseen_to(&mut self, time: u64) -> Result<(), Error> {
        loop {
            self.attend();
            if !self.observers.is_empty() {
                return Ok(());
            }
            self.engine.instants(self.timeline.ticks(), time.min(self.pause_at));
            let until = self.timeline.next_time().ok_or(Error::Late)?;
            if until > time {
                return Ok(());
            }
            if self.is_due() {
                continue;
            }
            self.timeline.rising_at(until, &mut self.rising);
            self.rise(until)?;
        }
    }

    /// Ends all observers.
    pub fn finish(&mut self) -> Result<(), Error> {
        let until = self.timeline.next_time().unwrap_or(1);
        self.rising.clear();
        let mut observers = std::mem::take(&mut self.observers);
        observers.extend(self.resting.take());
        let ends: Vec<_> = observers.iter_mut().map(|observer| observer.finish(&mut self.view(until))).collect();
        ends.into_iter().collect::<Result<(), Error>>()?;
        Ok(self.engine.agree()?)
    }

    /// The clock with this name or port name.
    pub fn clock(&self, name: &str) -> Result<usize, UnknownName> {
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
            self.let_rest();
        }
        result
    }

    fn view(&mut self, until: u64) -> View<'_> {
        View {
            program: &self.program,
            engine: &mut self.engine,
            since: self.timeline.time(),
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
            is_assumption: assert.is_assumption,
            run: (self.program.lanes() > 1).then(|| hierarchy.run(place)),
            instance: if path.is_empty() { hierarchy.scopes[0].name.clone() } else { path },
            clock: self.program.clocks[assert.clock as usize].name.clone(),
            cycle: self.timeline.cycles(assert.clock as usize),
            time,
            loc: assert.loc,
        }
    }
}
