//! Observers of a run: waveform files, text waves, recordings. A run without observers does not pay for them.

mod changes;
mod dump;
mod fst;
pub(crate) mod glob;
mod messages;
pub(crate) mod radix;
mod recording;
mod rows;
mod shown;
mod sink;
mod start;
mod step_file;
mod times;
mod vcd;
mod vcd_header;
mod wave;
mod waveform;
mod words;

use crate::engine::program::{Program, Triggers};
use crate::engine::{Done, Started};
use crate::testbench::error::Error;

pub(crate) use dump::Dump;
pub(crate) use fst::FstFile;
pub use messages::{Message, Messages};
pub use radix::WaveRadix;
pub use recording::Recorder;
pub(crate) use start::{Poked, Start};
pub(crate) use vcd::VcdFile;
pub(crate) use vcd_header::header;
pub(crate) use wave::{ClockLine, Draw, Source};
pub use wave::{Wave, WaveLine, WaveLines};
pub(crate) use waveform::{Format, Window};
pub use waveform::{Fst, Trace, Vcd};
pub(crate) use words::watched;

/// The view of an observer: the circuit settled before an edge.
pub(crate) struct View<'a> {
    pub program: &'a Program,
    pub engine: &'a mut Started,
    /// The last instant, in picoseconds: the start of the present values.
    pub since: u64,
    /// The coming instant.
    pub until: u64,
    /// The clocks that rise at the coming instant.
    pub rising: &'a [usize],
    /// Which resets are active, by clock.
    pub resets: &'a [bool],
    /// What may have changed since the last sample.
    pub changed: Triggers,
}

/// An observer of every instant. It reports its own errors at the next sample or at the end, because the error of an
/// assertion at the same instant takes precedence.
pub(crate) trait Observer {
    /// Samples the circuit just before an edge. An error is from earlier; the sample is then not taken.
    fn sample(&mut self, view: &mut View) -> Result<(), Error>;

    /// Executes as many edges of the only clock as it can take at once, up to `count`; none if it needs to see each
    /// of the next ones.
    fn rows(&mut self, _view: &mut View, _count: u64) -> Result<Done, Error> {
        Ok(Done { edges: 0, changed: Triggers::NONE })
    }

    /// The earliest time from `now` on whose values it needs, in picoseconds; the largest one if there is none.
    fn needs(&self, now: u64) -> u64 {
        now
    }

    /// Whether it needs no more samples, and no end.
    fn is_over(&self) -> bool {
        false
    }

    /// An assertion failed; the sample before this call shows it.
    fn failed(&mut self) {}

    /// The run ends; `view` shows the circuit after the last edge.
    fn finish(&mut self, _view: &mut View) -> Result<(), Error> {
        Ok(())
    }
}
