//! The paper's figures from running machines: random rectangles on the transaction-level model, and the same rectangles on the hardware.
//!
//! Source: figures 3, 5 and 6 of the paper; facts A3. All numbers are counters after a run. Windows are a unit's results, and times are its busy
//! clocks, from which MPG-EQ6 to MPG-EQ12 follow by definition ([`Stages`](crate::quadtree::Stages)).

use super::record::{Packets, Run};
use super::simulated::Simulated;
use super::square::{BROADCAST, EDGES, square};
use super::{Model, rasters_of};
use crate::error::Error;
use crate::quadtree::formulas::MAX_PERFORMANCE;
use crate::quadtree::rasters::Rasters;
use crate::quadtree::stages::Figures;
use crate::quadtree::study::Sample;
use crate::quadtree::windows::{Costs, Search, Windows};
use crate::run::Watch;
use crate::threads::{all_threads, on_threads};
use serde::Serialize;
use std::sync::atomic::AtomicBool;
use tilewright_rtl::parameter::ParameterError;
use tilewright_rtl::quadtree::coverage_test::Test;
use tilewright_rtl::quadtree::generator::QuadtreeGenerator;
use tilewright_rtl::quadtree::processor::Queues;
use tilewright_scenes::Polygon;

/// The forms whose runs make a point, in the sequence in which they are stored.
const FORMS: [&str; 2] = ["stack", "pipe"];
/// Parameters of a surface, kp: depth and three colours.
const PARAMETERS: u64 = 4;

/// Rectangles of one area, and the programs on which they run.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Trial {
    /// The rectangles.
    pub sample: Sample,
    /// Whether the hardware also gets them; the model always does.
    pub on_hardware: bool,
}

/// What to run: rectangles of some areas, on matrices of stacks and of pipes. The test units are serial, and a packet is offered in each
/// clock.
///
/// ```
/// use tilewright_machines::{Watch, quadtree::{Sample, model::{Trial, Trials}}};
///
/// let trial = Trial { sample: Sample { area: 20.0, polygons: 4 }, on_hardware: true };
/// let trials = Trials { m: 6, largest: 1, trials: vec![trial], ..Trials::paper(1) };
/// let outcomes = trials.run(&mut Watch::default())?.expect("not interrupted");
/// assert_eq!(outcomes.len(), 2, "k = 0 and 1");
/// for outcome in outcomes {
///     let hardware = outcome.hardware.expect("it ran");
///     assert_eq!((hardware.differs_from_model, hardware.differs_from_count), (0, 0));
///     assert_eq!(hardware.measured, outcome.model);
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Trials {
    /// The screen is 2^m x 2^m pixels; this is m.
    pub m: u32,
    /// The matrices are 2^k x 2^k processors, for all k from 0 to this.
    pub largest: u32,
    /// Width and height of the aperture in pixels, even.
    pub aperture: u32,
    /// The sizes of the queues.
    pub queues: Queues,
    /// The areas.
    pub trials: Vec<Trial>,
    /// The seed of the rectangles.
    pub seed: u64,
}

impl Trials {
    /// The paper's matrices, with packet queues of 16: areas from 1 to 10^5 pixels on the model, three a decade, and one a decade on the
    /// hardware. Two minutes of one processor, in a release build.
    pub fn paper(seed: u64) -> Trials {
        let decades = [1.0, 10.0, 100.0, 1e3, 1e4].into_iter().zip([1000, 500, 300, 100, 20]);
        let trial = |area, polygons, on_hardware| Trial { sample: Sample { area, polygons }, on_hardware };
        let of_decade = |(area, polygons)| [1.0, 2.0, 5.0].map(|times| trial(times * area, polygons, times == 1.0));
        let mut trials: Vec<Trial> = decades.flat_map(of_decade).collect();
        trials.push(trial(1e5, 5, true));
        let queues = Queues { broadcast: BROADCAST, packets: 16, windows: 4 };
        Trials { m: 10, largest: 4, aperture: 2, queues, trials, seed }
    }

    /// Runs everything on all processors of the computer. The outcomes are those of the first area by matrix, then those of the next. `None` if
    /// interrupted.
    ///
    /// # Errors
    /// A parameter of the generator or of the rectangles is out of range, or a sample is empty; then nothing has been run. Or an assertion of the
    /// hardware failed.
    pub fn run(&self, watch: &mut Watch) -> Result<Option<Vec<Outcome>>, Error> {
        self.run_on(all_threads(), watch)
    }

    fn run_on(&self, threads: usize, watch: &mut Watch) -> Result<Option<Vec<Outcome>>, Error> {
        let jobs = self.jobs()?;
        // The last ones have large areas and take longest. They come first, so that no thread runs one alone at the end.
        let order: Vec<usize> = (0..jobs.len()).rev().collect();
        let mut results: Vec<Option<Result<Both, Error>>> = jobs.iter().map(|_| None).collect();
        let (cancel, mut done) = (watch.cancel, 0);
        on_threads(
            threads,
            &order,
            cancel,
            |number| jobs[*number].run(cancel),
            |place, result| {
                results[order[place]] = Some(result);
                done += 1;
                watch.report("simulating", done as f64 / jobs.len() as f64);
            },
        );
        let runs = results.into_iter().map(|it| it.unwrap_or(Err(Error::Cancelled { phase: "simulating", time: 0 })));
        match runs.collect::<Result<Vec<Both>, Error>>() {
            Ok(runs) => Ok(Some(self.outcomes(&runs))),
            Err(Error::Cancelled { .. }) => Ok(None),
            Err(error) => Err(error),
        }
    }

    /// By area, then matrix, then form.
    fn jobs(&self) -> Result<Vec<Job>, ParameterError> {
        let mut jobs = Vec::new();
        for Trial { sample, on_hardware } in &self.trials {
            let rectangles = sample.rectangles(self.m, self.seed)?;
            for k in 0..=self.largest {
                for form in FORMS {
                    let generator = square((self.m, k), self.aperture, form, self.queues)?;
                    let model = Model::new(&generator)?;
                    let polygons = (0..sample.polygons).map(|index| rectangles.polygon(index)).collect();
                    jobs.push(Job { generator, model, polygons, on_hardware: *on_hardware });
                }
            }
        }
        Ok(jobs)
    }

    fn outcomes(&self, runs: &[Both]) -> Vec<Outcome> {
        let of_sizes = runs.chunks_exact(FORMS.len() * (self.largest as usize + 1));
        let of_trial = |(trial, runs): (&Trial, &[Both])| {
            let of_size = |forms: &[Both]| Outcome::new(trial.sample, forms, &runs[0]);
            runs.chunks_exact(FORMS.len()).map(of_size).collect::<Vec<_>>()
        };
        self.trials.iter().zip(of_sizes).flat_map(of_trial).collect()
    }
}

/// One matrix, form and area.
struct Job {
    generator: QuadtreeGenerator,
    model: Model,
    polygons: Vec<Polygon>,
    on_hardware: bool,
}

/// A run of the model, and of the hardware.
struct Both {
    matrix: Rasters,
    model: Run,
    hardware: Option<Checked>,
}

/// A run of the hardware, with the numbers of differences from the model and from the count.
struct Checked {
    run: Run,
    differs_from_model: u64,
    differs_from_count: u64,
}

impl Job {
    fn run(&self, cancel: Option<&AtomicBool>) -> Result<Both, Error> {
        let mut watch = Watch { progress: None, cancel };
        let packets = Packets::at_once(&self.polygons);
        let cancelled = Error::Cancelled { phase: "simulating", time: 0 };
        let model = self.model.run(packets, &mut watch).ok_or(cancelled)?;
        let hardware = match self.on_hardware {
            true => Some(self.checked(Simulated::new(&self.generator)?.run(packets, &mut watch)?, &model)),
            false => None,
        };
        Ok(Both { matrix: rasters_of(&self.generator.format()), model, hardware })
    }

    fn checked(&self, run: Run, model: &Run) -> Checked {
        let differs_from_model = run.differences(model);
        let differs_from_count = differences_from_count(&run, &self.model.search, &self.polygons);
        Checked { run, differs_from_model, differs_from_count }
    }
}

/// The number of a run's differences from the plain count: in the windows of each level, the busy clocks of each level, and the drawn pixels of
/// each video processor.
fn differences_from_count(run: &Run, search: &Search, polygons: &[Polygon]) -> u64 {
    let costs = Costs::new(Test::Serial, EDGES.into(), PARAMETERS);
    let of_processor = |(place, processor): ((u32, u32), &super::Processor)| {
        let mut counted = Windows::none(search.matrix().levels);
        polygons.iter().for_each(|polygon| counted += &search.windows(polygon, place));
        let windows = processor.units.iter().zip(&counted.passed).filter(|(unit, passed)| unit.results != **passed);
        let busy = processor.units[1..].iter().zip(counted.busy(costs)).filter(|(unit, busy)| unit.busy != *busy);
        let pixels = u64::from(processor.fragments != counted.fragments);
        (windows.count() + busy.count()) as u64 + pixels
    };
    search.processors().zip(&run.processors).map(of_processor).sum()
}

/// The runs of one matrix and one area.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Outcome {
    /// The matrix.
    pub matrix: Rasters,
    /// The rectangles.
    pub sample: Sample,
    /// The results from the transaction-level model's counters.
    pub model: Measured,
    /// Those from the hardware's counters, if it ran.
    pub hardware: Option<OnHardware>,
}

/// The results from the hardware's counters.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct OnHardware {
    /// The results.
    pub measured: Measured,
    /// The number of compared values: all counters, and the clock in which each packet was taken.
    pub numbers: u64,
    /// The number of those that differ from the model.
    pub differs_from_model: u64,
    /// The number of windows, busy clocks and pixels of a video processor that differ from the plain count of [`Search`].
    pub differs_from_count: u64,
}

/// The results from counters of matrices of stacks and of pipes.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Measured {
    /// Mean windows of a polygon in a processor, by level from 0 to n.
    pub windows: Vec<f64>,
    /// The figures from the busy clocks of the levels: p_s and Q_a from stacks, and p_p, R_p and Q_p from pipes.
    pub figures: Figures,
    /// Polygons per t_e of a running matrix of stacks, with its waits, over P_max.
    pub stacks_ran: f64,
    /// The same for pipes.
    pub pipes_ran: f64,
}

impl Outcome {
    /// The results of the runs of each form; `mono` is the run of one processor with a stack.
    fn new(sample: Sample, forms: &[Both], mono: &Both) -> Outcome {
        let matrix = forms[0].matrix;
        let checked = || forms.iter().map(|both| both.hardware.as_ref()).collect::<Option<Vec<&Checked>>>();
        let hardware = checked().zip(mono.hardware.as_ref()).map(|(forms, mono)| OnHardware {
            measured: Measured::new(&matrix, [&forms[0].run, &forms[1].run], &mono.run),
            numbers: forms.iter().map(|it| it.run.numbers().count() as u64).sum(),
            differs_from_model: forms.iter().map(|it| it.differs_from_model).sum(),
            differs_from_count: forms.iter().map(|it| it.differs_from_count).sum(),
        });
        let model = Measured::new(&matrix, [&forms[0].model, &forms[1].model], &mono.model);
        Outcome { matrix, sample, model, hardware }
    }
}

impl Measured {
    fn new(matrix: &Rasters, [stacks, pipes]: [&Run; 2], mono: &Run) -> Measured {
        let mono = mono.stages(EDGES);
        let [of_stacks, of_pipes] = [stacks, pipes].map(|run| Figures::of(matrix, &run.stages(EDGES), &mono));
        let ran = |run: &Run| run.rate() * f64::from(EDGES) / MAX_PERFORMANCE;
        Measured {
            windows: pipes.windows(),
            figures: Figures { p_s: of_stacks.p_s, q_a: of_stacks.q_a, ..of_pipes },
            stacks_ran: ran(stacks),
            pipes_ran: ran(pipes),
        }
    }
}

#[cfg(test)]
mod tests;
