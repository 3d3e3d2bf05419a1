//! A run in which a pixel is followed.

use super::job::{Job, Run};
use crate::engine::EngineArguments;
use crate::shell::{Exit, Failure, progress};
use crate::trace::TraceOptions;
use std::sync::atomic::AtomicBool;
use tilewright_machines::{Follower, Way};
use tilewright_scenes::Frame;

/// A pixel's way through a run, and how the run ended.
pub struct Followed {
    pub golden: Frame,
    /// The frame, if the run did not fail.
    pub frame: Option<Frame>,
    pub way: Way,
    /// The run failed, as a check of the machine itself did. The way up to there is known.
    pub failed: Option<Failure>,
}

/// Renders, and follows the pixel meanwhile. The run stops soon after `cancel` becomes true, if there is such a flag.
///
/// # Errors
/// The run was stopped, or failed before there was a way.
pub fn follow(job: &impl Job, pixel: [u32; 2], cancel: Option<&AtomicBool>) -> Result<Followed, Failure> {
    let golden = job.golden()?;
    let (follower, filters) = (Follower::new(pixel), TraceOptions::default());
    progress::phase("building");
    let run = Run { follower: Some(&follower), cancel, ..Run::new(EngineArguments::default(), &filters) };
    let (frame, failed) = match job.render(&run) {
        Ok((frame, _)) => (Some(frame), None),
        Err(failure) if is_stopped(&failure) => return Err(failure),
        Err(failure) => (None, Some(failure)),
    };
    match (follower.take(), failed) {
        (None, Some(failure)) => Err(failure),
        (way, failed) => Ok(Followed { golden, frame, way: way.unwrap_or_default(), failed }),
    }
}

/// Whether a run failed because it was interrupted.
fn is_stopped(failure: &Failure) -> bool {
    matches!(failure.exit, Exit::Interrupted | Exit::HungUp | Exit::Terminated)
}
