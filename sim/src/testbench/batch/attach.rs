//! What can watch a run of a batch.

use tilewright_hdl::Bundle;

use super::Batch;
use crate::testbench::attach::Probe;
use crate::testbench::error::Error;
use crate::testbench::trace::{Recorder, Vcd, Wave};

impl<I: Bundle, O: Bundle> Batch<I, O> {
    /// Writes a waveform file of one run from here on; see [`Simulation::trace`](crate::Simulation::trace). Several
    /// runs are several files.
    ///
    /// # Errors
    ///
    /// The file cannot be created, a pattern matches nothing, or there is no such clock.
    ///
    /// # Panics
    ///
    /// There is no such run.
    #[track_caller]
    pub fn trace(&mut self, run: u32, vcd: Vcd) -> Result<(), Error> {
        self.check(run);
        self.all.circuit.trace(run, vcd)
    }

    /// Records inputs and outputs of one run at every instant from here on.
    ///
    /// # Panics
    ///
    /// After the first step, if the run has a seed, or if there is no such run.
    #[track_caller]
    pub fn recording(&mut self, run: u32) -> Recorder {
        self.check(run);
        self.all.circuit.recording(run)
    }

    /// Draws a wave of these ports and signals of one run from here on.
    ///
    /// # Panics
    ///
    /// There is no such name, or no such run.
    #[track_caller]
    pub fn record(&mut self, run: u32, what: impl IntoIterator<Item = impl Into<Probe>>) -> Wave {
        self.check(run);
        self.all.circuit.record(run, what)
    }
}
