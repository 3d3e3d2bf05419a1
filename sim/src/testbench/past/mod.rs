//! Going back: what a simulation remembers of its past, and how it gets there.
//!
//! A run is determined by its inputs. So checkpoints from time to time and the changes of inputs, resets and memories
//! that the testbench makes are enough: any earlier time is some instants after a checkpoint. In the past, the
//! remembered changes happen again, up to the present.

mod log;
mod remembered;
mod visits;

use tilewright_hdl::Bundle;

use crate::testbench::condition::Condition;
use crate::testbench::error::Error;
use crate::testbench::simulation::Simulation;

pub(crate) use log::Change;
pub(crate) use remembered::Past;

/// Why a simulation cannot go to a time.
///
/// ```
/// # use tilewright_sim::{Simulation, for_examples::Counter};
/// let mut sim = Simulation::of(&Counter)?;
/// sim.run(3);
/// let said = sim.go_to(10_000).unwrap_err().to_string();
/// assert_eq!(said, "the simulation is at 30000 ps and remembers nothing before: call `remember` at the start");
/// # Ok::<(), tilewright_sim::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum Unremembered {
    /// Nothing is remembered.
    #[error("the simulation is at {now} ps and remembers nothing before: call `remember` at the start")]
    Nothing {
        /// The present time in picoseconds.
        now: u64,
    },
    /// The time was forgotten, to stay within the memory that was given.
    #[error(
        "{time} ps is forgotten: the simulation remembers the time from {earliest} ps on, so give `remember` more memory"
    )]
    Forgotten {
        /// The time.
        time: u64,
        /// The earliest time that is remembered.
        earliest: u64,
    },
}

impl<I: Bundle, O: Bundle> Simulation<I, O> {
    /// Remembers the past from now on, in at most so many bytes, so that [`Simulation::go_to`] goes back. If the
    /// memory is used up, it first keeps fewer checkpoints, so that going back takes longer, and then forgets the
    /// earliest time.
    ///
    /// A run of many clocks takes up to 4 % longer, and a testbench that sets an input in each clock about a tenth
    /// (`cargo bench -p tilewright-benches --bench past`).
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// sim.remember(64 << 20);
    /// for clock in 0..100 {
    ///     sim.set(sim.i.enable, clock % 3 == 0);
    ///     sim.step();
    /// }
    /// sim.go_to(500_000)?; // 50 clocks
    /// assert_eq!(sim.get_u64(sim.o.count), 17);
    /// sim.run(50); // the inputs change as they did
    /// assert_eq!(sim.get_u64(sim.o.count), 34);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn remember(&mut self, bytes: usize) {
        self.circuit.remember(bytes);
    }

    /// Remembers with a checkpoint after so many instants of the first clock, for tests.
    #[doc(hidden)]
    pub fn remember_often(&mut self, bytes: usize, instants: u64) {
        self.circuit.remember_often(bytes, instants);
    }

    /// Goes to a time in picoseconds, earlier or later: to the last instant up to it, with the inputs that the
    /// testbench then gave. In the past, a step goes on with the remembered inputs. Once an input, a reset or a word
    /// is set there, what came after that time is forgotten.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// sim.remember(64 << 20);
    /// sim.set(sim.i.enable, 1);
    /// sim.run(100);
    /// sim.go_to(205_000)?;
    /// assert_eq!((sim.time(), sim.get_u64(sim.o.count)), (200_000, 20));
    /// sim.set(sim.i.enable, 0);
    /// sim.run(100);
    /// assert_eq!(sim.get_u64(sim.o.count), 20); // another future
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`Error::Unremembered`]; or, after the present, as [`Simulation::try_run_to`].
    ///
    /// # Panics
    ///
    /// A trace is attached: none has time that goes back.
    #[track_caller]
    pub fn go_to(&mut self, time: u64) -> Result<(), Error> {
        self.circuit.go_to(time)
    }

    /// Goes to the time at which a clock, given directly or by name, had risen so many times, as [`Simulation::go_to`].
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// sim.remember(64 << 20);
    /// sim.set(sim.i.enable, 1);
    /// sim.run(100);
    /// sim.go_to_cycle("clk", 42)?;
    /// assert_eq!(sim.get_u64(sim.o.count), 42);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// There is no such clock; or as [`Simulation::go_to`].
    ///
    /// # Panics
    ///
    /// As [`Simulation::go_to`].
    #[track_caller]
    pub fn go_to_cycle(&mut self, clock: impl AsRef<str>, cycle: u64) -> Result<(), Error> {
        let period = self.circuit.program.clocks[self.circuit.clock(clock.as_ref())?].period;
        self.circuit.go_to(cycle.checked_mul(period).ok_or(Error::Late)?)
    }

    /// Goes back to the last instant before now after which a condition was true, with the inputs that the testbench
    /// then gave, and returns its time; or stays and returns `None` if there was none.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// sim.remember(64 << 20);
    /// sim.set(sim.i.enable, 1);
    /// sim.run(100);
    /// assert_eq!(sim.run_until_back(sim.o.square.is(9))?, Some(990_000)); // 99, whose lower 4 bits are 3
    /// assert_eq!(sim.run_until_back(sim.o.square.is(9))?, Some(830_000)); // 83
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`Error::Unremembered`] if nothing is remembered.
    ///
    /// # Panics
    ///
    /// The condition is invalid for its port, as in [`Simulation::run_until`]; or as [`Simulation::go_to`].
    #[track_caller]
    pub fn run_until_back(&mut self, condition: impl Into<Condition>) -> Result<Option<u64>, Error> {
        self.circuit.run_until_back(condition.into())
    }
}
