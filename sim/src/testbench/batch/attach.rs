//! The observers of a run of a batch.

use tilewright_hdl::Bundle;

use super::Batch;
use crate::testbench::attach::Probe;
use crate::testbench::error::Error;
use crate::testbench::trace::{Messages, Recorder, Trace, Wave};

impl<I: Bundle, O: Bundle> Batch<I, O> {
    /// Writes a waveform file of one run from now on; see [`Simulation::trace`](crate::Simulation::trace). Several
    /// runs need several files.
    ///
    /// ```
    /// # use tilewright_sim::{Batch, Vcd, for_examples::Counter};
    /// let mut batch = Batch::of(&Counter, 4)?;
    /// # let folder = tempfile::tempdir().unwrap();
    /// # let path = folder.path().join("run2.vcd");
    /// batch.trace(2, Vcd::to(&path).only("count"))?;
    /// batch.set_each(batch.i.enable, |run| run == 2);
    /// batch.run(5);
    /// batch.finish()?;
    /// assert!(std::fs::read_to_string(&path).unwrap().contains("101 ")); // that run counts to 5
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// The file cannot be created, a pattern matches nothing, or there is no such clock.
    ///
    /// # Panics
    ///
    /// There is no such run.
    #[track_caller]
    pub fn trace(&mut self, run: u32, trace: Trace) -> Result<(), Error> {
        self.check(run);
        self.all.circuit.trace(run, trace)
    }

    /// Records inputs and outputs of one run at every instant from now on.
    ///
    /// ```
    /// # use tilewright_sim::{Batch, for_examples::Counter};
    /// let mut batch = Batch::of(&Counter, 4)?;
    /// let recorder = batch.recording(3);
    /// batch.set_each(batch.i.enable, |run| run == 3);
    /// batch.run(5);
    /// assert_eq!(recorder.take().steps[4].outputs[0], 4); // before the fifth edge
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// Called after the first step, or there is no such run.
    #[track_caller]
    pub fn recording(&mut self, run: u32) -> Recorder {
        self.check(run);
        self.all.circuit.recording(run)
    }

    /// Collects what the displays of one run show from now on.
    ///
    /// ```
    /// use tilewright_hdl::*;
    ///
    /// # let design = tilewright_sim::shown! { |m, i| in { x: bits(8) } out { late: bits(8) }
    /// m.display(i.x.ne(0), "got {}", &[i.x]);
    /// #     ShownOut { late: m.pipe("late", i.x) }
    /// # };
    /// let mut batch = tilewright_sim::Batch::from_design(&design, 2)?;
    /// let messages = batch.messages(1);
    /// batch.set(batch.port("x")?, 1, 9);
    /// batch.run(1);
    /// assert_eq!(messages.lines(), ["got 9"]);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// There is no such run.
    #[track_caller]
    pub fn messages(&mut self, run: u32) -> Messages {
        self.check(run);
        self.all.circuit.messages(run)
    }

    /// Draws a wave of these ports and signals of one run from now on.
    ///
    /// ```
    /// # use tilewright_sim::{Batch, for_examples::Counter};
    /// let mut batch = Batch::of(&Counter, 4)?;
    /// let wave = batch.record(1, [batch.o.count]);
    /// batch.set_all(batch.i.enable, 1);
    /// batch.run(3);
    /// wave.expect(r"
    ///     clk   |___/~\_/~\_/
    ///     count | 0 | 1 | 2 |");
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
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
