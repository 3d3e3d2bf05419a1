//! Advancing in time.

use tilewright_hdl::Bundle;

use crate::testbench::error::{Error, UnknownName};
use crate::testbench::simulation::Simulation;

impl<I: Bundle, O: Bundle> Simulation<I, O> {
    /// Advances to the next instant at which a clock rises, and through its edges.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// sim.set(sim.i.enable, 1);
    /// sim.step();
    /// assert_eq!((sim.time(), sim.get_u64(sim.o.count)), (10_000, 1));
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// An assertion of the design fails, or a trace cannot be written.
    #[track_caller]
    #[inline]
    pub fn step(&mut self) {
        self.circuit.step();
    }

    /// Calls [`Simulation::step`] `n` times.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// sim.set(sim.i.enable, 1);
    /// sim.run(100);
    /// assert_eq!(sim.get(sim.o.count), 100);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// As [`Simulation::step`].
    #[track_caller]
    pub fn run(&mut self, n: u64) {
        done(self.try_run(n));
    }

    /// Tells that the run has at least this many clock edges to come, when each is asked for by itself. An engine that
    /// makes machine code for long runs alone then makes it at once, if that is worth it. Results are the same.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// sim.set(sim.i.enable, 1);
    /// sim.expect(1_000_000);
    /// while sim.get_u64(sim.o.count) < 200 {
    ///     sim.step();
    /// }
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn expect(&mut self, edges: u64) {
        self.circuit.engine.expect(edges);
    }

    /// Advances through every instant up to and including this time in picoseconds.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// sim.set(sim.i.enable, 1);
    /// sim.run_to(35_000);
    /// assert_eq!((sim.time(), sim.get_u64(sim.o.count)), (30_000, 3)); // the last edge before was at 30 ns
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// As [`Simulation::step`].
    #[track_caller]
    pub fn run_to(&mut self, time: u64) {
        done(self.try_run_to(time));
    }

    /// Advances until a clock, given directly or by name, has risen `n` more times. Other clocks rise in between.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// sim.set(sim.i.enable, 1);
    /// sim.step_clock("clk", 4);
    /// assert_eq!(sim.cycles("clk")?, 4);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
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

    /// Makes every reset active for one edge of every clock, and then releases it. On a clock without a reset the edge
    /// is one like all others.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// sim.set(sim.i.enable, 1);
    /// sim.run(10);
    /// sim.reset();
    /// // Registers without a reset value continue, and time advances.
    /// assert_eq!((sim.get_u64(sim.o.count), sim.peek("late")?.to_u64(), sim.time()), (0, Some(10), 110_000));
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// As [`Simulation::step`].
    #[track_caller]
    pub fn reset(&mut self) {
        done(self.try_reset());
    }

    /// Makes the reset of a clock active, or releases it. The clock is given directly or by name. An active reset sets
    /// the registers at each edge of the clock; an asynchronous one sets them at once as well. While it is active, no
    /// assertion on the clock is checked.
    ///
    /// ```
    /// use tilewright_hdl::{DEFAULT_PERIOD, DefaultClock, Reset};
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::at(&Counter, DefaultClock::new(DEFAULT_PERIOD).reset(Reset::AsynchronousLow))?;
    /// sim.set(sim.i.enable, 1);
    /// sim.run(10);
    /// sim.set_reset("clk", true); // the port `rst_n` is low now
    /// assert_eq!((sim.get_u64(sim.o.count), sim.time()), (0, 100_000)); // without an edge
    /// sim.run(5);
    /// assert_eq!(sim.get_u64(sim.o.count), 0);
    /// sim.set_reset("clk", false);
    /// sim.step();
    /// assert_eq!(sim.get_u64(sim.o.count), 1);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// There is no such clock; it has no reset; or an asynchronous reset is released at the time at which it became
    /// active, which no recording would show.
    #[track_caller]
    pub fn set_reset(&mut self, clock: impl AsRef<str>, active: bool) {
        self.circuit.set_reset_of(clock.as_ref(), active);
    }

    /// Like [`Simulation::step`], for a program that reports errors itself.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// sim.set(sim.i.enable, 1);
    /// sim.run(200);
    /// assert!(sim.try_step().is_err());
    /// assert_eq!(sim.time(), 2_000_000); // the edge did not happen
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`Error::Violated`] if assertions fail before the edge, which then does not happen; [`Error::Trace`] if a file
    /// could not be written at an earlier instant; [`Error::Late`]; [`Error::Differs`].
    pub fn try_step(&mut self) -> Result<(), Error> {
        self.circuit.try_step()
    }

    /// Like [`Simulation::reset`]; after an error, the resets stay active.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// sim.set(sim.i.enable, 1);
    /// assert!(sim.try_run(1000).is_err());
    /// sim.try_reset()?; // no assertion is checked while the reset is high
    /// assert_eq!(sim.get(sim.o.count), 0);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// As [`Simulation::try_step`].
    pub fn try_reset(&mut self) -> Result<(), Error> {
        self.circuit.try_reset()
    }

    /// Like [`Simulation::run`].
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// sim.set(sim.i.enable, 1);
    /// assert!(sim.try_run(200).is_ok());
    /// assert!(sim.try_run(1).is_err());
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// As [`Simulation::try_step`].
    pub fn try_run(&mut self, n: u64) -> Result<(), Error> {
        self.circuit.try_run(n)
    }

    /// Like [`Simulation::run_to`].
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// sim.set(sim.i.enable, 1);
    /// assert!(sim.try_run_to(1_000_000_000).is_err());
    /// assert_eq!(sim.time(), 2_000_000);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// As [`Simulation::try_step`].
    pub fn try_run_to(&mut self, time: u64) -> Result<(), Error> {
        self.circuit.try_run_to(time)
    }

    /// Ends every trace and writes the rest of it.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, Vcd, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// # let folder = tempfile::tempdir().unwrap();
    /// # let path = folder.path().join("counter.vcd");
    /// sim.trace(Vcd::to(&path))?;
    /// sim.run(3);
    /// sim.finish()?;
    /// let size = std::fs::metadata(&path).unwrap().len();
    /// sim.run(3); // continues without the trace
    /// assert_eq!(std::fs::metadata(&path).unwrap().len(), size);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`Error::Trace`] for the first file that could not be completed; the other files are complete.
    /// [`Error::Differs`].
    pub fn finish(&mut self) -> Result<(), Error> {
        self.circuit.finish()
    }

    /// The time of the last instant in picoseconds; 0 before the first.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// sim.run(3);
    /// assert_eq!(sim.time(), 30_000); // the first edge comes after one period
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn time(&self) -> u64 {
        self.circuit.timeline.time()
    }

    /// The number of times that a clock, given directly or by name, has risen.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// sim.run(3);
    /// assert_eq!(sim.cycles("clk")?, 3);
    /// assert!(sim.cycles("video").is_err());
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
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
