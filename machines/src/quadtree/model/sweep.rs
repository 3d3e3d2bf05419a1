//! The cost of coupling video processors by the broadcast, by the depth of their queues, and the performance of running matrices.
//!
//! Source: MPG-LIM, the paper's assumption that processors work equally long and are coupled loosely by FIFOs; MPG-EQ8 to MPG-EQ10. No number
//! here comes from a formula for windows or for clocks: [`Model`] counts. Sums are integers, so that the same sweep has the same result with
//! any number of threads.

use super::Model;
use super::record::{Packets, Run};
use super::square::{BROADCAST, EDGES, square};
use crate::quadtree::formulas::MAX_PERFORMANCE;
use crate::quadtree::rasters::Rasters;
use crate::quadtree::study::Sample;
use crate::run::Watch;
use crate::threads::all_threads;
use serde::Serialize;
use std::sync::atomic::AtomicBool;
use tilewright_rtl::parameter::ParameterError;
use tilewright_rtl::quadtree::processor::Queues;
use tilewright_scenes::Polygon;

/// Runs of the model: rectangles of some areas, on square matrices of some sizes, with queues of some depths. The test units are serial,
/// and a packet is offered in each clock.
///
/// ```
/// use tilewright_machines::{Watch, quadtree::{Sample, model::Sweep}};
///
/// let samples = vec![Sample { area: 20.0, polygons: 100 }];
/// let sweep = Sweep { sizes: vec![2], packets: vec![1, 64], samples, ..Sweep::paper(1) };
/// let points = sweep.run(&mut Watch::default())?.expect("not interrupted");
/// assert_eq!(points.len(), 2, "of pipes, and of stacks");
/// for point in points {
///     let [shallow, deep] = &point.by_depth[..] else { panic!("two depths") };
///     assert!(shallow.clocks >= deep.clocks && deep.clocks >= point.slowest_alone);
///     assert!(shallow.waits > deep.waits);
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Sweep {
    /// The screen is 2^m x 2^m pixels; this is m.
    pub m: u32,
    /// The matrices are 2^k x 2^k processors; these are the k.
    pub sizes: Vec<u32>,
    /// Width and height of the aperture in pixels, even.
    pub aperture: u32,
    /// The forms of raster processors, as in [`Form::parse`](tilewright_rtl::quadtree::raster::Form::parse).
    pub forms: Vec<String>,
    /// Depths of the packet queue before each video processor.
    pub packets: Vec<u32>,
    /// Depths of the window queue before each unit of a pipe or tree.
    pub windows: Vec<u32>,
    /// The areas.
    pub samples: Vec<Sample>,
    /// The seed of the rectangles.
    pub seed: u64,
}

impl Sweep {
    /// The paper's matrices, of pipes and of stacks, with packet queues of 1 to 64 packets, for areas from 1 to 10,000 pixels.
    pub fn paper(seed: u64) -> Sweep {
        let samples = [(1.0, 2000), (10.0, 2000), (100.0, 1000), (1000.0, 500), (10_000.0, 200)];
        Sweep {
            m: 10,
            sizes: vec![0, 1, 2, 3, 4],
            aperture: 2,
            forms: vec!["pipe".to_owned(), "stack".to_owned()],
            packets: vec![1, 2, 4, 8, 16, 32, 64],
            windows: vec![4],
            samples: samples.map(|(area, polygons)| Sample { area, polygons }).to_vec(),
            seed,
        }
    }

    /// Counts on all processors of the computer. The points are sorted by area, then size, form and depth of the window queue. `None` if
    /// interrupted.
    ///
    /// # Errors
    /// A parameter of the generator or of the rectangles is out of range, a sample is empty, or there is no depth of packet queues. Then
    /// nothing has been counted.
    pub fn run(&self, watch: &mut Watch) -> Result<Option<Vec<SweepPoint>>, ParameterError> {
        self.run_on(all_threads(), watch)
    }

    fn run_on(&self, threads: usize, watch: &mut Watch) -> Result<Option<Vec<SweepPoint>>, ParameterError> {
        let jobs = self.jobs()?;
        let cancel = watch.cancel;
        let points = watch.each_on(threads, "counting clocks", &jobs, |job| job.run(self, cancel));
        Ok(points.and_then(|points| points.into_iter().collect()))
    }

    fn jobs(&self) -> Result<Vec<Job>, ParameterError> {
        if self.packets.is_empty() {
            return Err(ParameterError(
                "a sweep over no depths of packet queues: it has to have at least one".to_owned(),
            ));
        }
        let mut jobs = Vec::new();
        for sample in &self.samples {
            sample.rectangles(self.m, self.seed)?;
            for &k in &self.sizes {
                for form in &self.forms {
                    for &windows in &self.windows {
                        let model =
                            |&packets: &u32| self.model(k, form, Queues { broadcast: BROADCAST, packets, windows });
                        let models = self.packets.iter().map(model).collect::<Result<_, _>>()?;
                        jobs.push(Job { sample: *sample, form: form.clone(), models });
                    }
                }
            }
        }
        Ok(jobs)
    }

    fn model(&self, k: u32, form: &str, queues: Queues) -> Result<Model, ParameterError> {
        Model::new(&square((self.m, k), self.aperture, form, queues)?)
    }
}

/// Runs of one matrix with different packet queues.
struct Job {
    sample: Sample,
    form: String,
    models: Vec<Model>,
}

impl Job {
    fn run(&self, sweep: &Sweep, cancel: Option<&AtomicBool>) -> Option<SweepPoint> {
        let mut watch = Watch { progress: None, cancel };
        let rectangles = self.sample.rectangles(sweep.m, sweep.seed).ok()?;
        let polygons: Vec<Polygon> = (0..self.sample.polygons).map(|index| rectangles.polygon(index)).collect();
        let packets = Packets::at_once(&polygons);
        let first = self.models.first()?;
        let alone = first.uncoupled(packets, &mut watch)?;
        let by_depth = self.models.iter().map(|model| {
            let run = model.run(packets, &mut watch)?;
            Some(Coupling::new(model.queues.packets, &run, &alone))
        });
        Some(SweepPoint {
            matrix: *first.search.matrix(),
            form: self.form.clone(),
            windows: first.queues.windows,
            sample: self.sample,
            mean_alone: mean(&alone),
            slowest_alone: slowest(&alone),
            by_depth: by_depth.collect::<Option<_>>()?,
        })
    }
}

/// One matrix and one area.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SweepPoint {
    /// The matrix.
    pub matrix: Rasters,
    /// The form of the raster processors.
    pub form: String,
    /// Size of the window queue before each of their units, if there is one.
    pub windows: u32,
    /// The rectangles.
    pub sample: Sample,
    /// Mean clocks until a video processor is idle that never waits for another. The matrix would take them if all had equal work at all
    /// times.
    pub mean_alone: f64,
    /// The clocks of the slowest one, which the matrix takes with unlimited queues.
    pub slowest_alone: u64,
    /// The matrix, by depth of the packet queues.
    pub by_depth: Vec<Coupling>,
}

/// A run of a matrix.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Coupling {
    /// Size of the packet queue before each video processor.
    pub packets: u32,
    /// Clocks until the matrix is idle.
    pub clocks: u64,
    /// Of these, clocks in which a packet of the broadcast waits for space in all queues.
    pub waits: u64,
    /// The share of the clocks by which it takes longer than the mean of its processors alone, which the paper's assumption leaves out.
    pub loss: f64,
    /// The share by which it takes longer than the slowest of its processors alone, which deeper queues would win back.
    pub loss_by_depth: f64,
    /// Polygons per t_e over P_max: p_p for a matrix of pipes, p_s for one of stacks (figures 5 and 6).
    pub performance: f64,
    /// The share of busy clocks, for the set-up and for each level.
    pub load: Vec<f64>,
    /// The share of clocks in which a window waits to be taken, for the set-up and for each level.
    pub stalled: Vec<f64>,
}

impl Coupling {
    /// The numbers of a run of serial units with such packet queues. `alone` has the clocks of processors that never wait for another, as in
    /// [`Model::uncoupled`].
    pub fn new(packets: u32, run: &Run, alone: &[u64]) -> Coupling {
        let loss = |ideal: f64| 1.0 - ideal / run.clocks as f64;
        Coupling {
            packets,
            clocks: run.clocks,
            waits: run.broadcast.stalled,
            loss: loss(mean(alone)),
            loss_by_depth: loss(slowest(alone) as f64),
            performance: run.rate() * f64::from(EDGES) / MAX_PERFORMANCE,
            load: run.load(),
            stalled: run.stalled(),
        }
    }
}

fn mean(clocks: &[u64]) -> f64 {
    clocks.iter().sum::<u64>() as f64 / clocks.len() as f64
}

fn slowest(clocks: &[u64]) -> u64 {
    clocks.iter().copied().max().unwrap_or(0)
}

#[cfg(test)]
mod tests;
