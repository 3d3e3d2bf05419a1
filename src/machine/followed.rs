//! A run in which a pixel is followed.

use super::job::{Job, Run};
use crate::engine::EngineArguments;
use crate::shell::{Exit, Failure, progress};
use crate::trace::TraceOptions;
use std::ops::Range;
use std::sync::atomic::AtomicBool;
use tilewright_machines::{Follower, Step, Tracer, Way};
use tilewright_scenes::{Frame, Size};

/// Clocks of a waveform on each side of a step.
const CLOCKS: u64 = 20;

/// A pixel's way through a run, and how the run ended.
pub struct Followed {
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
        (way, failed) => Ok(Followed { frame, way: way.unwrap_or_default(), failed }),
    }
}

/// Renders with the waveform of a unit that is simulated by itself. The pixel is followed meanwhile, as a machine with a fault may not end
/// otherwise.
///
/// # Errors
/// Those of the run.
pub fn render_traced(
    job: &impl Job,
    tracer: &Tracer,
    pixel: [u32; 2],
    cancel: Option<&AtomicBool>,
) -> Result<(), Failure> {
    let (follower, filters) = (Follower::new(pixel), TraceOptions::default());
    let (tracer, follower) = (Some(tracer), Some(&follower));
    job.render(&Run { tracer, follower, cancel, ..Run::new(EngineArguments::default(), &filters) }).map(|_| ())
}

/// Whether a run failed because it was interrupted.
fn is_stopped(failure: &Failure) -> bool {
    matches!(failure.exit, Exit::Interrupted | Exit::HungUp | Exit::Terminated)
}

/// Checks that a picture has a pixel.
///
/// # Errors
/// It is outside.
pub fn check_pixel(size: Size, [x, y]: [u32; 2]) -> Result<(), Failure> {
    if x < size.width() && y < size.height() {
        return Ok(());
    }
    let (right, bottom) = (size.width() - 1, size.height() - 1);
    let sentence = format!("pixel {x},{y} is outside of a picture of {size}: give one from 0,0 to {right},{bottom}");
    Err(Failure::new(Exit::BadInput, sentence))
}

/// The picoseconds of the clocks around a step, in the simulation that it is of.
pub fn times_around(step: &Step) -> Range<u64> {
    let span = CLOCKS * (step.time / step.cycle.max(1)).max(1);
    let time = step.apart.as_ref().map_or(step.time, |apart| apart.time);
    time.saturating_sub(span)..time + span
}

/// The unit and the name of a step's net, if it has one: the instances below the top that lead to the unit.
pub fn unit_and_name(step: &Step) -> Option<(Vec<String>, &str)> {
    let net = step.net.as_deref()?;
    let (unit, name) = net.rsplit_once('.').unwrap_or(("", net));
    Some((unit.split('.').filter(|part| !part.is_empty()).map(str::to_owned).collect(), name))
}

/// The pattern of all signals in a unit; of the top, those of its own alone.
pub fn signals_of(unit: &[String]) -> String {
    if unit.is_empty() { "*".to_owned() } else { format!("{}.**", unit.join(".")) }
}
