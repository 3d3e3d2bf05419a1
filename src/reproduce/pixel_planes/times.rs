//! The update time of random vectors: by the transaction-level model, and by the circuit for some.

use super::plan::{Plan, RENDERERS, Spec};
use crate::shell::Failure;
use tilewright_machines::pixel_planes::model::{Model, RendererTiming, Timing};
use tilewright_machines::pixel_planes::{Config, Drawing, Machine, RendererReport, Report};
use tilewright_machines::{Error, Watch};
use tilewright_report::Origin;
use tilewright_scenes::Polygons;

/// A run and its times.
pub struct Run {
    pub spec: Spec,
    /// Mean clocks of a vector, N.
    pub cycles: f64,
    /// Vectors of the busiest renderer, P_w.
    pub worst: u64,
    /// The screen's regions, R.
    pub regions: usize,
    pub model: Took,
    pub hardware: Option<Took>,
}

/// The clocks of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Took {
    /// Until the last vector is drawn.
    pub drawn: u64,
    /// Until the last region is sent.
    pub sent: u64,
    /// The share in which a renderer could have taken an instruction that had not arrived, of the clocks in which it had a region.
    pub starved: f64,
    /// Bits that the ring brought, and lines of regions, which take one clock each.
    pub bits: u64,
    pub planes: u64,
    /// Bits that the ring brought, over its capacity.
    pub load: f64,
}

/// All runs.
pub struct Times {
    pub runs: Vec<Run>,
    seed: u64,
}

impl Times {
    /// Runs; `None` if interrupted.
    pub fn all(plan: &Plan, watch: &mut Watch) -> Result<Option<Times>, Failure> {
        let specs = plan.runs();
        let mut scenes: Vec<Spec> = Vec::new();
        for spec in &specs {
            if !scenes.iter().any(|scene| scene.draws_as(spec)) {
                scenes.push(*spec);
            }
        }
        let make = |spec: &Spec| Ok::<Drawing, Failure>(Machine::new(spec.config(plan))?.drawing(&spec.scene(plan)?)?);
        let Some(drawings) = watch.each("binning", &scenes, make) else { return Ok(None) };
        let drawings = drawings.into_iter().collect::<Result<Vec<Drawing>, Failure>>()?;
        let run = |spec: &Spec| {
            let scene = scenes.iter().position(|scene| scene.draws_as(spec)).expect("there is a drawing of each");
            Run::on_model(*spec, plan, &drawings[scene])
        };
        let Some(runs) = watch.each("timing", &specs, run) else { return Ok(None) };
        let mut runs = runs.into_iter().collect::<Result<Vec<Run>, Failure>>()?;
        for run in runs.iter_mut().filter(|run| run.spec.on_hardware) {
            run.hardware = Some(on_hardware(run.spec, plan, watch)?);
        }
        Ok(Some(Times { runs, seed: plan.effort.seed }))
    }

    /// The run of the paper's example with that ring. It is the first; most others differ from it in one parameter.
    pub fn usual(&self, ring: u32) -> &Run {
        let is_it = |run: &&Run| run.spec.ring == ring && run.spec.renderers == RENDERERS;
        self.runs.iter().find(is_it).expect("there is one with each ring")
    }

    /// The runs with that ring that differ from the usual one in the number of renderers alone, by that number.
    pub fn by_renderers(&self, ring: u32) -> Vec<&Run> {
        let usual = self.usual(ring).spec;
        let is_of =
            |run: &&Run| run.spec == Spec { renderers: run.spec.renderers, on_hardware: run.spec.on_hardware, ..usual };
        self.runs.iter().filter(is_of).collect()
    }

    pub fn model(&self) -> Origin {
        Origin::model([self.seed])
    }

    pub fn rtl(&self) -> Origin {
        Origin::rtl([self.seed])
    }
}

impl Run {
    fn on_model(spec: Spec, plan: &Plan, drawing: &Drawing) -> Result<Run, Failure> {
        let timing = Model::new(&spec.config(plan)).map_err(Error::from)?.run(&drawing.steps);
        let (mut clocks, mut primitives) = (0, 0);
        for program in drawing.programs.used() {
            clocks += program.clocks;
            primitives += program.primitives;
        }
        let load = |regions: &Vec<usize>| regions.iter().map(|region| drawing.primitives[*region]).sum();
        Ok(Run {
            spec,
            cycles: clocks as f64 / primitives as f64,
            worst: timing.renderers.iter().map(|it| load(&it.regions)).max().unwrap_or_default(),
            regions: drawing.steps.len(),
            model: Took::of(&timing),
            hardware: None,
        })
    }

    /// Nanoseconds a vector until all are drawn.
    pub fn per_vector(&self, took: &Took) -> f64 {
        took.drawn as f64 * tilewright_machines::pixel_planes::PERIOD / self.spec.vectors as f64
    }
}

fn on_hardware(spec: Spec, plan: &Plan, watch: &mut Watch) -> Result<Took, Failure> {
    let (_, report) = Machine::new(spec.config(plan))?.render(&spec.scene(plan)?, [0; 3], watch)?;
    Ok(Took::of_report(&report))
}

impl Spec {
    /// Whether the two runs draw the same scene in the same regions.
    fn draws_as(&self, other: &Spec) -> bool {
        (self.side, self.vectors) == (other.side, other.vectors)
    }

    fn config(&self, plan: &Plan) -> Config {
        let &Spec { renderers, side, ring, .. } = self;
        Config { renderers, side, ring, ..plan.config() }
    }

    fn scene(&self, plan: &Plan) -> Result<Polygons, Failure> {
        Ok(plan.vectors().map_err(Error::from)?.polygons(self.vectors))
    }
}

impl Took {
    fn of_report(report: &Report) -> Took {
        let sum = |of: fn(&RendererReport) -> u64| report.renderers.iter().map(of).sum::<u64>();
        Took {
            drawn: report.drawn,
            sent: report.sent,
            starved: sum(|it| it.starved) as f64 / sum(|it| it.busy).max(1) as f64,
            bits: report.ring.bits,
            planes: report.ring.planes,
            load: report.ring.load,
        }
    }

    fn of(timing: &Timing) -> Took {
        let sum = |of: fn(&RendererTiming) -> u64| timing.renderers.iter().map(of).sum::<u64>();
        Took {
            drawn: timing.drawn,
            sent: timing.sent,
            starved: sum(|it| it.starved) as f64 / sum(|it| it.busy).max(1) as f64,
            bits: timing.ring.bits,
            planes: timing.ring.planes,
            load: timing.ring.load(),
        }
    }
}
