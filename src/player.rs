//! Plays a block's scenario in a simulation.

use crate::shell::{Exit, Failure, Progress, interrupt};
use std::sync::atomic::{AtomicBool, Ordering};
use tilewright_rtl::catalog::Scenario;
use tilewright_sim::Simulation;

/// Simulated picoseconds between two looks at the interruption flag.
const SLICE: u64 = 10_000_000;

/// The most clocks that are kept in memory: they take about a kilobyte each.
const MOST_KEPT: u64 = 200_000;

/// That the scenario is short enough for `what`, which keeps all of its clocks in memory.
///
/// # Errors
/// It is too long.
pub fn check_length(sim: &Simulation, scenario: &Scenario, what: &str) -> Result<(), Failure> {
    let clocks: u64 = sim.program().clocks.iter().map(|clock| scenario.end_ps / clock.period).sum();
    if clocks <= MOST_KEPT {
        return Ok(());
    }
    let sentence = format!("the scenario takes {clocks} clocks, {what} at most {MOST_KEPT}: --set smaller parameters");
    Err(Failure::new(Exit::BadInput, sentence))
}

/// Resets the simulation and plays the scenario to its end. Traces stay open.
///
/// # Errors
/// Ctrl-C; an assertion does not hold; a trace cannot be written.
pub fn play(sim: &mut Simulation, scenario: &Scenario) -> Result<(), Failure> {
    let interrupted = interrupt::flag();
    let progress = Progress::new();
    sim.reset();
    let start = sim.time();
    let mut run = Run { sim, interrupted, progress, start, now: start, end: start + scenario.end_ps };
    for event in &scenario.events {
        run.until(start + event.at_ps)?;
        let port = run.sim.port(&event.input).expect("a scenario's inputs are ports of its block");
        run.sim.set(port, &event.value);
    }
    run.until(run.end)
}

struct Run<'a> {
    sim: &'a mut Simulation,
    interrupted: &'a AtomicBool,
    progress: Progress,
    start: u64,
    now: u64,
    end: u64,
}

impl Run<'_> {
    fn until(&mut self, time: u64) -> Result<(), Failure> {
        while self.now < time {
            if self.interrupted.load(Ordering::Relaxed) {
                let sentence = format!("the run was interrupted at {} ps of simulated time", self.now);
                return Err(Failure::new(Exit::Interrupted, sentence));
            }
            self.now = time.min(self.now + SLICE);
            self.sim.try_run_until(self.now)?;
            self.progress.show("running", (self.now - self.start) as f64 / (self.end - self.start) as f64);
        }
        Ok(())
    }
}
