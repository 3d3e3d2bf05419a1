//! A frame to render, on any machine.

use crate::engine::{EngineArguments, tell_fallback};
use crate::shell::output::Waveform;
use crate::shell::{Failure, interrupt};
use crate::trace::TraceOptions;
use crate::watch::watched;
use serde::Serialize;
use std::cell::RefCell;
use std::fmt::Display;
use std::sync::atomic::AtomicBool;
use tilewright_hdl::Bundle;
use tilewright_machines::{Follower, Recorder, Tracer, Watch};
use tilewright_scenes::{Frame, Size};
use tilewright_sim::{EngineKind, Simulation};

/// What is drawn, and the machine that draws it.
pub trait Job {
    /// The machine's report on a frame.
    type Report: Serialize + Display;

    /// The size of the frame.
    fn size(&self) -> Size;

    /// The software rasterizer's frame of the same packets.
    ///
    /// # Errors
    /// Ctrl-C.
    fn golden(&self) -> Result<Frame, Failure>;

    /// Builds the machine and renders.
    ///
    /// # Errors
    /// The machine cannot be built, or cannot render this; Ctrl-C; a waveform cannot be written.
    fn render(&self, run: &Run) -> Result<(Frame, Self::Report), Failure>;
}

/// How a machine is run.
pub struct Run<'a> {
    pub engine: EngineArguments,
    pub filters: &'a TraceOptions,
    pub waveform: Option<&'a Waveform>,
    /// Where the machine records what it does, if that is asked for.
    pub recorder: Option<&'a Recorder>,
    /// The pixel that is followed, if one is.
    pub follower: Option<&'a Follower>,
    /// The waveform of a unit, of a machine whose units are simulated one by one.
    pub tracer: Option<&'a Tracer>,
    /// Stops the run soon after it becomes true, in place of Ctrl-C.
    pub cancel: Option<&'a AtomicBool>,
    /// The header of the waveform, once it is attached.
    pub header: RefCell<Vec<u8>>,
}

impl<'a> Run<'a> {
    /// A run that leaves nothing but its frame.
    pub fn new(engine: EngineArguments, filters: &'a TraceOptions) -> Run<'a> {
        Run {
            engine,
            filters,
            waveform: None,
            recorder: None,
            follower: None,
            tracer: None,
            cancel: None,
            header: RefCell::default(),
        }
    }
}

impl Run<'_> {
    /// What runs the hardware.
    pub fn engine(&self) -> EngineKind {
        self.engine.kind()
    }

    /// Attaches the waveform, if one is asked for, to a machine. Its engine has to be chosen before.
    ///
    /// # Errors
    /// A filter matches nothing, or the waveform cannot be written.
    pub fn attach<I: Bundle, O: Bundle>(&self, sim: &mut Simulation<I, O>) -> Result<(), Failure> {
        tell_fallback(sim);
        if let Some(waveform) = self.waveform {
            *self.header.borrow_mut() = self.filters.attach(waveform, sim)?;
        }
        Ok(())
    }

    /// Renders with a line of progress, and stops at Ctrl-C; `picoseconds` is the simulated time of a result.
    ///
    /// # Errors
    /// Those of the run.
    pub fn watch<T>(
        &self,
        render: impl FnOnce(&mut Watch) -> Result<T, tilewright_machines::Error>,
        picoseconds: impl FnOnce(&T) -> u64,
    ) -> Result<T, Failure> {
        let ended = watched(self.cancel.unwrap_or_else(|| interrupt::flag()), render).map_err(Failure::from);
        if let Ok(done) = &ended {
            self.filters.warn_if_empty(picoseconds(done));
        }
        if let Some(waveform) = self.waveform.filter(|_| Failure::leaves_a_waveform(&ended)) {
            waveform.tell_written();
        }
        ended
    }
}
