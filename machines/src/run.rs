//! What a caller may do while a machine runs: watch its progress and stop it.

use std::sync::atomic::{AtomicBool, Ordering};

use crate::error::Error;

/// Clocks between two reports of progress, and between two looks at the cancellation flag.
pub(crate) const PROGRESS_CLOCKS: u64 = 1024;

/// How far a frame is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// What the machine does, such as `drawing`.
    pub phase: &'static str,
    /// How much of the phase is done, from 0 to 1.
    pub fraction: f64,
}

/// Hooks into a run; [`Watch::default`] has none.
#[derive(Default)]
pub struct Watch<'a> {
    /// Called some hundreds of times in a frame, and at the end of each phase.
    pub progress: Option<&'a mut dyn FnMut(Progress)>,
    /// The run stops soon after this has become true, with [`Error::Cancelled`](crate::Error::Cancelled).
    pub cancel: Option<&'a AtomicBool>,
}

impl Watch<'_> {
    pub(crate) fn report(&mut self, phase: &'static str, fraction: f64) {
        if let Some(progress) = &mut self.progress {
            progress(Progress { phase, fraction });
        }
    }

    /// Reports, and stops the run, which is at that simulated time, if the caller wants it.
    pub(crate) fn go_on(&mut self, phase: &'static str, fraction: f64, time: u64) -> Result<(), Error> {
        self.report(phase, fraction);
        match self.cancel.is_some_and(|flag| flag.load(Ordering::Relaxed)) {
            true => Err(Error::Cancelled { phase, time }),
            false => Ok(()),
        }
    }
}
