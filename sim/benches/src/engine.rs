//! Our own simulator as a contender.

use crate::RESET_CYCLES;
use crate::contender::{Contender, Run};
use crate::error::Error;
use crate::subject::Subject;
use std::time::{Duration, Instant};
use tilewright_hdl::Design;
use tilewright_sim::{EngineKind, Simulation};

/// An engine of the simulator.
#[derive(Debug, Clone, Copy)]
pub struct Engine {
    /// Its name.
    pub name: &'static str,
    /// Makes a simulation that runs on it.
    pub start: fn(&Design) -> Result<Simulation, tilewright_sim::Error>,
}

/// Every engine. The first one is what others are compared with.
pub const ENGINES: &[Engine] = &[
    Engine { name: "compiled engine", start: |design| Ok(Simulation::from_design(design)?.on(EngineKind::Compiled)) },
    Engine { name: "reference engine", start: |design| Ok(Simulation::from_design(design)?.on(EngineKind::Reference)) },
];

/// A subject on an engine. Every run elaborates it anew, as the time to the first cycle has that in it.
#[derive(Debug, Clone, Copy)]
pub struct OnEngine {
    /// The engine.
    pub engine: Engine,
    /// The subject.
    pub subject: Subject,
}

impl Contender for OnEngine {
    fn name(&self) -> &str {
        self.engine.name
    }

    fn build_time(&self) -> Option<Duration> {
        None
    }

    fn run(&self, cycles: u64) -> Result<Run, Error> {
        let started = Instant::now();
        let mut sim = (self.engine.start)(&self.subject.design().map_err(tilewright_sim::Error::from)?)?;
        reset(&mut sim)?;
        sim.try_step()?;

        let ready = Instant::now();
        sim.try_run(cycles - 1)?;
        let others = ready.elapsed();
        let checksum = sim.port("csum").expect("every design has a checksum");
        Ok(Run { checksum: sim.get_u64(checksum) as u32, first_cycle: ready - started, others })
    }
}

/// Holds every reset, and the input `rst` of a design that has one, high for [`RESET_CYCLES`] of every clock.
///
/// # Errors
///
/// As [`Simulation::try_step`].
pub fn reset(sim: &mut Simulation) -> Result<(), tilewright_sim::Error> {
    let rst = sim.port("rst").ok();
    rst.into_iter().for_each(|rst| sim.set(rst, 1));
    (0..RESET_CYCLES).try_for_each(|_| sim.try_reset())?;
    rst.into_iter().for_each(|rst| sim.set(rst, 0));
    Ok(())
}
