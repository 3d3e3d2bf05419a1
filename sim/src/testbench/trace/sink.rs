//! What the formats of waveform files have in common.

use super::changes::Id;
use super::vcd_header::Variable;
use crate::testbench::error::Error;

/// The number of variables in a block: as many as a number has bits.
pub(crate) const BLOCK: usize = 64;

/// A waveform file of some format, which takes the changes of a run in the sequence of time.
pub(crate) trait Sink {
    /// The precomputed format of a variable of up to 32 bits that is not a string.
    type Short: Copy;

    /// The format of this variable.
    fn short(variable: &Variable) -> Self::Short;

    /// Creates the file.
    fn open(&mut self);

    /// Sets the time of the following changes.
    fn at(&mut self, time: u64);

    /// Begins the values of all variables at the first time.
    fn first(&mut self);

    /// Ends them.
    fn first_ends(&mut self);

    /// A variable of 1 bit.
    fn bit(&mut self, id: Id, high: bool);

    /// A variable of several bits, from its limbs, the lowest first.
    fn bits(&mut self, id: Id, limbs: &[u64]);

    /// A string variable.
    fn string(&mut self, id: Id, text: &str);

    /// The new values of those short variables that have a bit in `which`.
    fn shorts(&mut self, which: u64, all: &[Self::Short; BLOCK], limbs: &[u64; BLOCK]);

    /// Hands what is collected to the system if it is much. The last time step must be whole.
    fn flush_much(&mut self);

    /// Hands all that is collected to the system.
    fn flush(&mut self);

    /// The same at the end of the run.
    fn close(&mut self) {
        self.flush();
    }

    /// The error that has happened, once.
    fn report(&mut self) -> Result<(), Error>;
}
