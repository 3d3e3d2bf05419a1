//! What a caller may do while a machine runs: watch its progress and stop it.

use std::sync::atomic::{AtomicBool, Ordering};

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

    pub(crate) fn cancelled(&self) -> bool {
        self.cancel.is_some_and(|flag| flag.load(Ordering::Relaxed))
    }
}
