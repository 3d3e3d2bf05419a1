//! Our own simulator as a contender.

use crate::RESET_CYCLES;
use crate::contender::{Contender, Run};
use crate::error::Error;
use crate::subject::Subject;
use std::time::{Duration, Instant};
use tilewright_sim::{Batch, EngineKind, Simulation};

/// The engines available on this computer. The first one is the reference for comparisons.
pub fn engines() -> impl Iterator<Item = EngineKind> {
    [EngineKind::Compiled, EngineKind::Interpreter].into_iter().filter(|kind| kind.refused().is_none())
}

fn name(kind: EngineKind) -> &'static str {
    match kind {
        EngineKind::Compiled => "compiled engine",
        EngineKind::Interpreter => "interpreter",
        EngineKind::Tiered => "two tiers",
        EngineKind::Reference => "reference engine",
        EngineKind::Both => "both engines",
    }
}

/// The engine of a first cycle: by default a run begins on the interpreter, and code is made later.
fn first_tier(engine: EngineKind) -> EngineKind {
    if engine == EngineKind::Compiled { EngineKind::Tiered } else { engine }
}

/// A subject on an engine. Every run elaborates it anew, because the time to the first cycle includes that.
#[derive(Debug, Clone, Copy)]
pub struct OnEngine {
    /// The engine.
    pub engine: EngineKind,
    /// The subject.
    pub subject: Subject,
}

impl Contender for OnEngine {
    fn name(&self) -> &str {
        name(self.engine)
    }

    fn build_time(&self) -> Option<Duration> {
        None
    }

    fn run(&self, cycles: u64) -> Result<Run, Error> {
        let started = Instant::now();
        let design = self.subject.design().map_err(tilewright_sim::Error::from)?;
        let mut first = Simulation::from_design(&design)?.on(first_tier(self.engine));
        reset(&mut first)?;
        first.try_step()?;
        let first_cycle = started.elapsed();

        let mut sim = first.another().on(self.engine);
        reset(&mut sim)?;
        sim.try_step()?;
        let ready = Instant::now();
        sim.try_run(cycles - 1)?;
        let others = ready.elapsed();
        let checksum = sim.port("csum").expect("every design has a checksum");
        Ok(Run { checksums: vec![sim.get_u64(checksum) as u32], first_cycle, others })
    }
}

/// A subject with several stimuli at once on the compiled engine.
#[derive(Debug, Clone)]
pub struct AtOnce {
    name: String,
    subject: Subject,
}

impl AtOnce {
    /// The subject with its stimuli.
    pub fn new(subject: Subject) -> AtOnce {
        let engine = name(engines().next().expect("the interpreter runs everywhere"));
        AtOnce { name: format!("{engine}, {} at once", subject.stimuli()), subject }
    }
}

impl Contender for AtOnce {
    fn name(&self) -> &str {
        &self.name
    }

    fn build_time(&self) -> Option<Duration> {
        None
    }

    fn stimuli(&self) -> u32 {
        self.subject.stimuli()
    }

    fn run(&self, cycles: u64) -> Result<Run, Error> {
        let started = Instant::now();
        let design = self.subject.design().map_err(tilewright_sim::Error::from)?;
        let mut batch = Batch::from_design(&design, self.stimuli())?.on(EngineKind::Compiled);
        let port = |name| batch.port(name).expect("every design with stimuli has it");
        let (rst, csum) = (port("rst"), port("csum"));
        batch.set_all(rst, 1);
        (0..RESET_CYCLES).try_for_each(|_| batch.try_reset())?;
        batch.set_each(rst, |stimulus| stimulus > 0);
        batch.try_step()?;

        let ready = Instant::now();
        let staggered = cycles.min(self.stimuli().into());
        for cycle in 1..staggered {
            batch.set_each(rst, |stimulus| u64::from(stimulus) > cycle);
            batch.try_step()?;
        }
        batch.try_run(cycles - staggered)?;
        let others = ready.elapsed();
        let checksums = batch.get_each(csum).iter().map(|bits| bits.to_u64().unwrap_or_default() as u32).collect();
        Ok(Run { checksums, first_cycle: ready - started, others })
    }
}

/// The final checksum of each stimulus of a subject after `cycles` cycles of the first, run alone.
///
/// # Errors
///
/// It cannot be run.
pub fn alone(subject: Subject, cycles: u64) -> Result<Vec<u32>, Error> {
    let mut sim = Simulation::from_design(&subject.design().map_err(tilewright_sim::Error::from)?)?;
    reset(&mut sim)?;
    let csum = sim.port("csum").expect("every design has a checksum");
    let later = cycles.saturating_sub(u64::from(subject.stimuli()) - 1);
    sim.try_run(later)?;
    let mut checksums = vec![sim.get_u64(csum) as u32];
    for _ in later..cycles {
        sim.try_step()?;
        checksums.push(sim.get_u64(csum) as u32);
    }
    // A stimulus whose reset has not ended yet is at the begin of its run.
    checksums.reverse();
    checksums.resize(subject.stimuli() as usize, *checksums.last().expect("there is one"));
    Ok(checksums)
}

/// Sets every reset, and the input `rst` of a design that has one, high for [`RESET_CYCLES`] of every clock.
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
