//! Advancing many runs at once.

use tilewright_hdl::Bundle;

use super::Batch;
use crate::testbench::error::{Error, UnknownName};

impl<I: Bundle, O: Bundle> Batch<I, O> {
    /// Advances all runs to the next instant at which a clock rises, and through its edges.
    ///
    /// ```
    /// # use tilewright_sim::{Batch, for_examples::Counter};
    /// let mut batch = Batch::of(&Counter, 4)?;
    /// batch.set(batch.i.enable, 1, 1);
    /// batch.step();
    /// assert_eq!((batch.time(), batch.get(batch.o.count, 1).to_u64()), (10_000, Some(1)));
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// An assertion of the design fails in some run, or a trace cannot be written.
    #[track_caller]
    pub fn step(&mut self) {
        self.ready().step();
    }

    /// Calls [`Batch::step`] `n` times.
    ///
    /// ```
    /// # use tilewright_sim::{Batch, for_examples::Counter};
    /// let mut batch = Batch::of(&Counter, 4)?;
    /// batch.set_all(batch.i.enable, 1);
    /// batch.run(100);
    /// assert_eq!(batch.get(batch.o.count, 3), 100);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// As [`Batch::step`].
    #[track_caller]
    pub fn run(&mut self, n: u64) {
        self.ready().run(n);
    }

    /// Advances all runs through every instant up to and including this time in picoseconds.
    ///
    /// ```
    /// # use tilewright_sim::{Batch, for_examples::Counter};
    /// let mut batch = Batch::of(&Counter, 4)?;
    /// batch.run_to(35_000);
    /// assert_eq!(batch.time(), 30_000);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// As [`Batch::step`].
    #[track_caller]
    pub fn run_to(&mut self, time: u64) {
        self.ready().run_to(time);
    }

    /// Advances all runs until a clock, given directly or by name, has risen `n` more times. Other clocks rise in
    /// between.
    ///
    /// ```
    /// # use tilewright_sim::{Batch, for_examples::Counter};
    /// let mut batch = Batch::of(&Counter, 4)?;
    /// batch.step_clock("clk", 4);
    /// assert_eq!(batch.cycles("clk")?, 4);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// There is no such clock; or as [`Batch::step`].
    #[track_caller]
    pub fn step_clock(&mut self, clock: impl AsRef<str>, n: u64) {
        self.ready().step_clock(clock, n);
    }

    /// Makes every reset of all runs active for one edge of every clock, and then releases it.
    ///
    /// ```
    /// # use tilewright_sim::{Batch, for_examples::Counter};
    /// let mut batch = Batch::of(&Counter, 4)?;
    /// batch.set_all(batch.i.enable, 1);
    /// batch.run(10);
    /// batch.reset();
    /// assert!(batch.get_each(batch.o.count).iter().all(|count| count.is_zero()));
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// As [`Batch::step`].
    #[track_caller]
    pub fn reset(&mut self) {
        self.ready().reset();
    }

    /// Makes the reset of a clock active in all runs, or releases it. The clock is given directly or by name; see
    /// [`Simulation::set_reset`](crate::Simulation::set_reset).
    ///
    /// ```
    /// use tilewright_hdl::{DEFAULT_PERIOD, DefaultClock, Reset};
    /// # use tilewright_sim::{Batch, for_examples::Counter};
    /// let mut batch = Batch::at(&Counter, DefaultClock::new(DEFAULT_PERIOD).reset(Reset::AsynchronousLow), 4)?;
    /// batch.set_each(batch.i.enable, |run| run % 2);
    /// batch.run(10);
    /// batch.set_reset("clk", true);
    /// assert!(batch.get_each(batch.o.count).iter().all(|count| count.is_zero())); // without an edge
    /// batch.run(5);
    /// batch.set_reset("clk", false);
    /// batch.step();
    /// assert_eq!((batch.read_u64(2).count, batch.read_u64(3).count), (0, 1));
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// As [`Simulation::set_reset`](crate::Simulation::set_reset).
    #[track_caller]
    pub fn set_reset(&mut self, clock: impl AsRef<str>, active: bool) {
        self.ready().circuit.set_reset_of(clock.as_ref(), active);
    }

    /// Like [`Batch::step`], for a program that reports errors itself.
    ///
    /// ```
    /// # use tilewright_sim::{Batch, for_examples::Counter};
    /// let mut batch = Batch::of(&Counter, 4)?;
    /// batch.set(batch.i.enable, 2, 1);
    /// batch.run(200);
    /// let error = batch.try_step().unwrap_err();
    /// assert!(error.to_string().contains("of run 2 in cycle 200"));
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// Like [`Simulation::try_step`](crate::Simulation::try_step): if assertions fail in some runs, the edge happens
    /// in none.
    pub fn try_step(&mut self) -> Result<(), Error> {
        self.ready().try_step()
    }

    /// Like [`Batch::run`].
    ///
    /// ```
    /// # use tilewright_sim::{Batch, for_examples::Counter};
    /// let mut batch = Batch::of(&Counter, 4)?;
    /// batch.set(batch.i.enable, 2, 1);
    /// assert!(batch.try_run(1000).is_err());
    /// assert_eq!(batch.time(), 2_000_000); // the last instant, for all runs
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// As [`Batch::try_step`].
    pub fn try_run(&mut self, n: u64) -> Result<(), Error> {
        self.ready().try_run(n)
    }

    /// Like [`Batch::run_to`].
    ///
    /// ```
    /// # use tilewright_sim::{Batch, for_examples::Counter};
    /// let mut batch = Batch::of(&Counter, 4)?;
    /// assert!(batch.try_run_to(1_000_000_000).is_ok()); // nothing counts, so no assertion fails
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// As [`Batch::try_step`].
    pub fn try_run_to(&mut self, time: u64) -> Result<(), Error> {
        self.ready().try_run_to(time)
    }

    /// Like [`Batch::reset`]; after an error, the resets stay active.
    ///
    /// ```
    /// # use tilewright_sim::{Batch, for_examples::Counter};
    /// let mut batch = Batch::of(&Counter, 4)?;
    /// batch.set(batch.i.enable, 2, 1);
    /// assert!(batch.try_run(1000).is_err());
    /// batch.try_reset()?;
    /// assert!(batch.get(batch.o.count, 2).is_zero());
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// As [`Batch::try_step`].
    pub fn try_reset(&mut self) -> Result<(), Error> {
        self.ready().try_reset()
    }

    /// Ends every trace and writes the rest of it.
    ///
    /// ```
    /// # use tilewright_sim::{Batch, Vcd, for_examples::Counter};
    /// let mut batch = Batch::of(&Counter, 4)?;
    /// # let folder = tempfile::tempdir().unwrap();
    /// # let file = |run: u32| folder.path().join(format!("run{run}.vcd"));
    /// for run in 0..2 {
    ///     batch.trace(run, Vcd::to(file(run)))?;
    /// }
    /// batch.run(5);
    /// batch.finish()?;
    /// assert!(file(0).is_file() && file(1).is_file());
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`Error::Trace`] for the first file that could not be completed; the other files are complete.
    pub fn finish(&mut self) -> Result<(), Error> {
        self.ready().finish()
    }

    /// The time of the last instant in picoseconds; 0 before the first.
    ///
    /// ```
    /// # use tilewright_sim::{Batch, for_examples::Counter};
    /// let mut batch = Batch::of(&Counter, 4)?;
    /// batch.run(5);
    /// assert_eq!(batch.time(), 50_000);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn time(&self) -> u64 {
        self.all.time()
    }

    /// The number of times that a clock, given directly or by name, has risen.
    ///
    /// ```
    /// # use tilewright_sim::{Batch, for_examples::Counter};
    /// let mut batch = Batch::of(&Counter, 4)?;
    /// batch.run(5);
    /// assert_eq!(batch.cycles("clk")?, 5);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// There is no such clock.
    pub fn cycles(&self, clock: impl AsRef<str>) -> Result<u64, UnknownName> {
        self.all.cycles(clock)
    }
}
