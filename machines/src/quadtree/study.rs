//! The paper's figures by counting: means over random rectangles of windows, clocks and derived numbers.
//!
//! Source: figures 3, 5 and 6 of the paper; facts A3. A [`Point`] has formulas and counts side by side. No count comes from a formula for
//! windows: the stages' times are counted clocks, from which MPG-EQ6 to MPG-EQ12 follow by definition. Sums are integers, so that the same
//! study has the same result with any number of threads.

mod tally;

use super::formulas::Shape;
use super::rasters::Rasters;
use super::rectangles::Rectangles;
use super::stages::{Figures, Stages};
use super::windows::{Costs, Search};
use crate::mean::Mean;
use crate::run::Watch;
use crate::threads::{all_threads, on_threads};
use serde::Serialize;
use tally::Tally;
use tilewright_rtl::parameter::ParameterError;
use tilewright_scenes::Size;

/// Edges of a rectangle, ke.
const EDGES: u64 = 4;
/// Parameters of a surface, kp: depth and three colours.
const PARAMETERS: u64 = 4;
/// A rectangle's long side over its short one (MPG-L).
const RATIO: f64 = 5.0;
/// The most parts of the work on a sample.
const PARTS: u64 = 64;

/// Rectangles of one area.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Sample {
    /// Their area in pixels.
    pub area: f64,
    /// Their number, at least 1.
    pub polygons: u64,
}

impl Sample {
    /// The rectangles, on a screen of 2^m x 2^m pixels.
    pub(super) fn rectangles(&self, m: u32, seed: u64) -> Result<Rectangles, ParameterError> {
        let side = 1_u32.checked_shl(m).unwrap_or(u32::MAX);
        let screen = Size::new(side, side).map_err(|error| ParameterError(error.to_string()))?;
        match self.polygons {
            0 => Err(ParameterError(format!(
                "a sample of 0 rectangles of {} pixels: it has to have at least 1",
                self.area
            ))),
            _ => Rectangles::new(screen, self.area, RATIO, seed),
        }
    }
}

/// The counts to make: rectangles of some areas, on square matrices of some sizes.
///
/// ```
/// use tilewright_machines::{Watch, quadtree::{Sample, Study}};
///
/// let study = Study { samples: vec![Sample { area: 20.0, polygons: 50 }], ..Study::paper(1) };
/// let points = study.run(&mut Watch::default())?.expect("not interrupted");
/// assert_eq!(points.len(), 5);
/// assert!(points.iter().all(|point| point.windows[0].mean == 1.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Study {
    /// The screen is 2^m x 2^m pixels; this is m.
    pub m: u32,
    /// The matrices are 2^k x 2^k processors; these are the k.
    pub sizes: Vec<u32>,
    /// Width and height of the aperture in pixels, even.
    pub aperture: u32,
    /// The areas.
    pub samples: Vec<Sample>,
    /// The seed of the rectangles.
    pub seed: u64,
}

impl Study {
    /// The study of the paper's figures: m = 10, k = 0 to 4, an aperture of 2, areas of 1 to 10^5 pixels, three a decade.
    /// It takes half a minute of one processor in a release build.
    pub fn paper(seed: u64) -> Study {
        let decades = [1.0, 10.0, 100.0, 1e3, 1e4].into_iter().zip([20_000, 15_000, 8_000, 4_000, 1_000]);
        let of_decade = |(area, polygons)| [1.0, 2.0, 5.0].map(|times| Sample { area: times * area, polygons });
        let mut samples: Vec<Sample> = decades.flat_map(of_decade).collect();
        samples.push(Sample { area: 1e5, polygons: 500 });
        Study { m: 10, sizes: vec![0, 1, 2, 3, 4], aperture: 2, samples, seed }
    }

    /// Counts on all processors of the computer. The points are those of the first area by matrix, then those of the next. `None` if
    /// interrupted.
    ///
    /// # Errors
    /// A parameter of the matrix or of the rectangles is out of range, or a sample is empty. Then nothing has been counted.
    pub fn run(&self, watch: &mut Watch) -> Result<Option<Vec<Point>>, ParameterError> {
        self.run_on(all_threads(), watch)
    }

    fn run_on(&self, threads: usize, watch: &mut Watch) -> Result<Option<Vec<Point>>, ParameterError> {
        let work = Work { searches: self.searches()?, rectangles: self.rectangles()?, parts: self.parts() };
        let mut tallies: Vec<Vec<Tally>> = self.samples.iter().map(|_| work.nothing()).collect();
        let mut missing = work.parts.len();
        let cancel = watch.cancel;
        on_threads(
            threads,
            &work.parts,
            cancel,
            |part| work.count(part),
            |number, counted| {
                tallies[work.parts[number].sample].iter_mut().zip(&counted).for_each(|(sum, tally)| sum.add(tally));
                missing -= 1;
                watch.report("counting windows", 1.0 - missing as f64 / work.parts.len() as f64);
            },
        );
        Ok((missing == 0).then(|| self.points(&work.searches, &tallies)))
    }

    /// The searches of one processor, with which all are compared, then those of the matrices.
    fn searches(&self) -> Result<Vec<Search>, ParameterError> {
        let aperture = (self.aperture, self.aperture);
        let sizes = std::iter::once(&0).chain(&self.sizes);
        sizes.map(|&k| Search::new(Rasters { aperture, ..Rasters::square(k, self.m) })).collect()
    }

    fn rectangles(&self) -> Result<Vec<Rectangles>, ParameterError> {
        self.samples.iter().map(|sample| sample.rectangles(self.m, self.seed)).collect()
    }

    fn parts(&self) -> Vec<Part> {
        let of_sample = |(sample, Sample { polygons, .. }): (usize, &Sample)| {
            let (polygons, step) = (*polygons, polygons.div_ceil(PARTS));
            (0..polygons.div_ceil(step)).map(move |part| Part {
                sample,
                first: part * step,
                end: polygons.min((part + 1) * step),
            })
        };
        self.samples.iter().enumerate().flat_map(of_sample).collect()
    }

    fn points(&self, searches: &[Search], tallies: &[Vec<Tally>]) -> Vec<Point> {
        let of_sample = |(sample, tallies): (&Sample, &Vec<Tally>)| {
            let mono = tallies[0].stages(searches[0].matrix());
            let matrices = searches.iter().zip(tallies).skip(1);
            matrices.map(|(search, tally)| Point::new(*search.matrix(), *sample, tally, &mono)).collect::<Vec<_>>()
        };
        self.samples.iter().zip(tallies).flat_map(of_sample).collect()
    }
}

/// The data that the threads share.
struct Work {
    searches: Vec<Search>,
    /// By sample.
    rectangles: Vec<Rectangles>,
    parts: Vec<Part>,
}

impl Work {
    /// A tally of each search.
    fn nothing(&self) -> Vec<Tally> {
        self.searches.iter().map(|search| Tally::none(search.matrix().levels)).collect()
    }

    fn count(&self, part: &Part) -> Vec<Tally> {
        let mut tallies = self.nothing();
        for index in part.first..part.end {
            let packet = self.rectangles[part.sample].polygon(index);
            tallies.iter_mut().zip(&self.searches).for_each(|(tally, search)| tally.count(search, &packet));
        }
        tallies
    }
}

/// A range of a sample's rectangles.
struct Part {
    sample: usize,
    first: u64,
    end: u64,
}

/// One matrix and one area: formula and count.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Point {
    /// The matrix.
    pub matrix: Rasters,
    /// The rectangles.
    pub sample: Sample,
    /// Their mean area after snapping, in pixels.
    pub area: f64,
    /// Windows counted in a processor, by level from 0 to n.
    pub windows: Vec<Mean>,
    /// Their upper bound by MPG-EQ1, the mean over all places of an infinite raster.
    pub bounds: Vec<f64>,
    /// Covered pixels counted in a processor.
    pub fragments: Mean,
    /// Times of the levels from 1 to n, in t_e, from clocks counted with serial test units.
    pub stages: Stages,
    /// Times of the levels by MPG-EQ5.
    pub stages_by_formula: Stages,
    /// The figures from counted clocks.
    pub figures: Figures,
    /// The figures from MPG-EQ5.
    pub figures_by_formula: Figures,
}

impl Point {
    fn new(matrix: Rasters, sample: Sample, tally: &Tally, mono: &Stages) -> Point {
        let shape = Shape::rectangle(sample.area, RATIO);
        let by_formula = |matrix: Rasters| matrix.stages_of(shape, PARAMETERS as f64 / EDGES as f64);
        let (stages, stages_by_formula) = (tally.stages(&matrix), by_formula(matrix));
        Point {
            area: tally.area(),
            windows: tally.windows(&matrix),
            bounds: (0..=matrix.levels).map(|level| matrix.windows_of(shape, level)).collect(),
            fragments: tally.fragments(&matrix),
            figures: Figures::of(&matrix, &stages, mono),
            figures_by_formula: Figures::of(&matrix, &stages_by_formula, &by_formula(matrix.mono())),
            stages,
            stages_by_formula,
            matrix,
            sample,
        }
    }
}

#[cfg(test)]
mod tests;
