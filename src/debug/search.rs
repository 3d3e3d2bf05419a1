//! The run to a condition, forward or back.

use super::condition::Condition;
use super::instants::Instants;
use tilewright_sim::{Error, Simulation};

/// The instants that are run at once on the way back: first few, because the last time is often close.
const FIRST: usize = 64;
const MOST: usize = 65_536;

/// The instants between two questions whether to stop.
const PATIENCE: usize = 1024;

/// How a search ended.
#[derive(Debug, PartialEq, Eq)]
pub enum Found {
    /// At this time.
    At(u64),
    Nowhere,
    /// The user stopped it.
    Stopped,
}

/// What a search asks now and then: whether to stop.
pub type Stop<'a> = &'a mut dyn FnMut() -> bool;

/// The first instant after `now` at which the condition is true.
///
/// # Errors
/// The simulation cannot go there.
pub fn forward(
    sim: &mut Simulation,
    instants: &Instants,
    condition: &Condition,
    now: u64,
    stop: Stop,
) -> Result<Found, Error> {
    let mut time = instants.after(now);
    for count in 1_usize.. {
        if time > instants.end {
            break;
        }
        if holds(sim, condition, time)? {
            return Ok(Found::At(time));
        }
        if count.is_multiple_of(PATIENCE) && stop() {
            return Ok(Found::Stopped);
        }
        time = instants.after(time);
    }
    Ok(Found::Nowhere)
}

/// The last instant before `now` at which the condition is true.
///
/// # Errors
/// The simulation cannot go there.
pub fn back(
    sim: &mut Simulation,
    instants: &Instants,
    condition: &Condition,
    now: u64,
    stop: Stop,
) -> Result<Found, Error> {
    let (mut end, mut count) = (now, FIRST);
    while end > 0 {
        let start = instants.back(end, count);
        let mut last = None;
        for time in instants.from(start, count).into_iter().take_while(|time| *time < end) {
            if holds(sim, condition, time)? {
                last = Some(time);
            }
        }
        if let Some(time) = last {
            return Ok(Found::At(time));
        }
        if stop() {
            return Ok(Found::Stopped);
        }
        (end, count) = (start, (4 * count).min(MOST));
    }
    Ok(Found::Nowhere)
}

fn holds(sim: &mut Simulation, condition: &Condition, time: u64) -> Result<bool, Error> {
    sim.go_to(time)?;
    Ok(condition.holds(&sim.peek(&condition.net)?))
}
