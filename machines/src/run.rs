//! Progress and cancellation of a running machine.

use std::sync::atomic::{AtomicBool, Ordering};

use crate::error::Error;

/// Clocks between two reports of progress, and between two checks of the cancellation flag.
pub(crate) const PROGRESS_CLOCKS: u64 = 1024;

/// The progress of a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// The machine's activity, such as `drawing`.
    pub phase: &'static str,
    /// The part of the phase that is done, from 0 to 1.
    pub fraction: f64,
}

/// Hooks into a run; [`Watch::default`] has none.
#[derive(Default)]
pub struct Watch<'a> {
    /// Called some hundred times in a frame, and at the end of each phase.
    pub progress: Option<&'a mut dyn FnMut(Progress)>,
    /// The run stops with [`Error::Cancelled`](crate::Error::Cancelled) soon after this becomes true.
    pub cancel: Option<&'a AtomicBool>,
}

impl Watch<'_> {
    pub(crate) fn report(&mut self, phase: &'static str, fraction: f64) {
        if let Some(progress) = &mut self.progress {
            progress(Progress { phase, fraction });
        }
    }

    /// Reports the progress of a run at that simulated time, and stops it if the caller asks for it.
    pub(crate) fn go_on(&mut self, phase: &'static str, fraction: f64, time: u64) -> Result<(), Error> {
        self.report(phase, fraction);
        match self.cancel.is_some_and(|flag| flag.load(Ordering::Relaxed)) {
            true => Err(Error::Cancelled { phase, time }),
            false => Ok(()),
        }
    }
}
