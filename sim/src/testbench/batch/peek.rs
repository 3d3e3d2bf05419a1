//! Values inside the runs of a batch.

use tilewright_circuit::Bits;
use tilewright_hdl::Bundle;

use super::Batch;
use crate::testbench::error::UnknownName;
use crate::testbench::port::IntoValue;

impl<I: Bundle, O: Bundle> Batch<I, O> {
    /// The settled value of any named object in one run; see [`Simulation::peek`](crate::Simulation::peek).
    ///
    /// ```
    /// # use tilewright_sim::{Batch, for_examples::Counter};
    /// let mut batch = Batch::of(&Counter, 4)?;
    /// batch.set(batch.i.enable, 1, 1);
    /// batch.run(5);
    /// assert_eq!(batch.peek("late", 1)?, 4);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// There is no such name; the error suggests the nearest one.
    ///
    /// # Panics
    ///
    /// There is no such run.
    #[track_caller]
    pub fn peek(&mut self, path: &str, run: u32) -> Result<Bits, UnknownName> {
        self.check(run);
        self.ready().circuit.peek(path, run)
    }

    /// A word of a memory in one run.
    ///
    /// ```
    /// # use tilewright_sim::{Batch, for_examples::Counter};
    /// let mut batch = Batch::of(&Counter, 4)?;
    /// assert_eq!(batch.peek_memory("squares", 3, 5)?, 25);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// There is no such memory.
    ///
    /// # Panics
    ///
    /// The address is beyond its depth, or there is no such run.
    #[track_caller]
    pub fn peek_memory(&self, path: &str, run: u32, address: u32) -> Result<Bits, UnknownName> {
        self.check(run);
        self.all.circuit.peek_word(path, run, address)
    }

    /// Replaces a word of a memory in one run immediately.
    ///
    /// ```
    /// # use tilewright_sim::{Batch, for_examples::Counter};
    /// let mut batch = Batch::of(&Counter, 4)?;
    /// batch.poke_memory("squares", 3, 0, 99)?;
    /// let squares = batch.get_each(batch.o.square);
    /// assert!(squares[2] == 0 && squares[3] == 99); // each run has a memory of its own
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// There is no such memory.
    ///
    /// # Panics
    ///
    /// As [`Simulation::poke_memory`](crate::Simulation::poke_memory), or there is no such run.
    #[track_caller]
    pub fn poke_memory(
        &mut self,
        path: &str,
        run: u32,
        address: u32,
        value: impl IntoValue,
    ) -> Result<(), UnknownName> {
        self.check(run);
        self.all.circuit.poke_word(path, run, address, value)
    }
}
