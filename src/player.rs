//! Plays a block's scenario in a simulation.

use crate::shell::{Exit, Failure, Progress, interrupt};
use std::ops::ControlFlow;
use tilewright_hdl::Scenario;
use tilewright_sim::Simulation;

/// Simulated picoseconds between two looks at the interruption flag.
const SLICE: u64 = 10_000_000;

/// The most clocks that are kept in memory; each takes about a kilobyte.
const MOST_KEPT: u64 = 200_000;

/// Checks that the scenario is short enough for `what`, which keeps all of its clocks in memory.
///
/// # Errors
/// It is too long.
pub fn check_length(sim: &Simulation, scenario: &Scenario, what: &str) -> Result<(), Failure> {
    let clocks: u64 = sim.program().clocks.iter().map(|clock| scenario.end_ps / clock.period).sum();
    if clocks <= MOST_KEPT {
        return Ok(());
    }
    let sentence = format!(
        "the scenario takes {clocks} clocks, but {what} can have {MOST_KEPT} at most: --set smaller parameters"
    );
    Err(Failure::new(Exit::BadInput, sentence))
}

/// Resets the simulation and plays the scenario, to its end or until `end` picoseconds have passed. Traces stay open.
///
/// # Errors
/// Ctrl-C; an assertion fails; a trace cannot be written.
pub fn play(sim: &mut Simulation, scenario: &Scenario, end: u64) -> Result<(), Failure> {
    let progress = Progress::new();
    let ended = sim.play_watched(scenario, SLICE, |sim, played| {
        progress.show("running", played.max(sim.time() as f64 / end as f64));
        if sim.time() >= end { ControlFlow::Break(()) } else { interrupt::go_on() }
    })?;
    if ended.is_break() && interrupt::asked() {
        let sentence = format!("the run was interrupted at {} ps of simulated time", sim.time());
        return Err(Failure::new(interrupt::exit(), sentence));
    }
    Ok(())
}
