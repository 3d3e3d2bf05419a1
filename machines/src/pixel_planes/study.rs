//! The number of regions of a vector, counted over random vectors, beside the formulas.
//!
//! Source: PP5-HVB, PP5-HV, PP5-HV0. Counts are bins of [`Regions::of`]. They do not use the formulas beside them.

use super::formulas::Shape;
use super::outline::{Binner, Outline};
use super::regions::Regions;
use super::vectors::Vectors;
use crate::mean::{Mean, Sum};
use crate::run::Watch;
use crate::threads::all_threads;
use serde::Serialize;
use std::ops::Range;
use tilewright_rtl::parameter::ParameterError;

/// Vectors that are counted between two looks at the cancellation flag.
const PART: u64 = 20_000;

/// The vectors to count.
///
/// ```
/// use tilewright_machines::Watch;
/// use tilewright_machines::pixel_planes::Study;
///
/// let study = Study { lengths: vec![50.0], angles: vec![45.0], vectors: 2000, ..Study::paper(1) };
/// let points = study.run(&mut Watch::default())?.expect("not interrupted");
/// let counted = points[0].counted.by_box;
/// assert!((counted.mean - 1.629).abs() < 4.0 * counted.error);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Study {
    /// The screen.
    pub regions: Regions,
    /// Lengths in pixels.
    pub lengths: Vec<f64>,
    /// Angles in degrees.
    pub angles: Vec<f64>,
    /// Vectors of each length and angle, at least 1.
    pub vectors: u64,
    /// Their seed.
    pub seed: u64,
}

/// A number of regions by each [`Binner`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Bins<T> {
    /// By the bounding box (PP5-HVB).
    pub by_box: T,
    /// By whole columns (PP5-HV).
    pub by_columns: T,
    /// By the vector itself.
    pub tight: T,
}

impl<T> Bins<T> {
    fn of(mut number: impl FnMut(Binner) -> T) -> Bins<T> {
        Bins { by_box: number(Binner::Box), by_columns: number(Binner::Columns), tight: number(Binner::Tight) }
    }
}

/// Vectors of one length and angle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Point {
    /// The vectors.
    pub shape: Shape,
    /// Regions of a vector, counted.
    pub counted: Bins<Mean>,
    /// Regions of a vector by the formulas.
    pub by_formula: Bins<f64>,
}

impl Study {
    /// The screen of the paper, and its vectors of 50 pixels at 45 degrees among others. It takes a few seconds of one processor in a release
    /// build.
    pub fn paper(seed: u64) -> Study {
        Study {
            regions: Regions::paper(),
            lengths: vec![10.0, 25.0, 50.0, 100.0, 128.0, 200.0, 400.0],
            angles: (0..=6).map(|step| 15.0 * f64::from(step)).collect(),
            vectors: 200_000,
            seed,
        }
    }

    /// Counts on all processors of the computer. The points are those of the first length by angle, then those of the next. `None` if it was
    /// interrupted.
    ///
    /// # Errors
    /// Vectors do not fit on the screen, or there are none. Then nothing has been counted.
    pub fn run(&self, watch: &mut Watch) -> Result<Option<Vec<Point>>, ParameterError> {
        self.run_on(all_threads(), watch)
    }

    fn run_on(&self, threads: usize, watch: &mut Watch) -> Result<Option<Vec<Point>>, ParameterError> {
        let samples = self.samples()?;
        let parts = (0..self.vectors.div_ceil(PART)).map(|part| (part * PART)..self.vectors.min((part + 1) * PART));
        let parts: Vec<Range<u64>> = parts.collect();
        let jobs: Vec<(&Vectors, &Range<u64>)> =
            samples.iter().flat_map(|(_, vectors)| parts.iter().map(move |part| (vectors, part))).collect();
        let count = |(vectors, part): &(&Vectors, &Range<u64>)| self.count(vectors, Range::clone(part));
        let Some(sums) = watch.each_on(threads, "counting regions", &jobs, count) else { return Ok(None) };
        let points = samples.iter().zip(sums.chunks(parts.len()));
        Ok(Some(points.map(|((shape, _), sums)| self.point(*shape, sums)).collect()))
    }

    /// The vectors of each point.
    fn samples(&self) -> Result<Vec<(Shape, Vectors)>, ParameterError> {
        if self.vectors == 0 {
            return Err(ParameterError("a study of 0 vectors: it has to have at least 1".to_owned()));
        }
        let shapes =
            self.lengths.iter().flat_map(|&length| self.angles.iter().map(move |&angle| Shape { length, angle }));
        let sample = |shape: Shape| {
            let vectors = Vectors::new(self.regions, shape.length, Some(shape.angle), self.seed)?;
            Ok((shape, vectors))
        };
        shapes.map(sample).collect()
    }

    fn count(&self, vectors: &Vectors, part: Range<u64>) -> Bins<Sum> {
        let mut sums = Bins::of(|_| Sum::default());
        for index in part {
            let outline = Outline::of(&vectors.ends(index));
            sums.add(Bins::of(|binner| Sum::from(self.regions.of(&outline, binner).len() as u64)));
        }
        sums
    }

    fn point(&self, shape: Shape, parts: &[Bins<Sum>]) -> Point {
        let mut sums = Bins::of(|_| Sum::default());
        parts.iter().for_each(|part| sums.add(*part));
        let mean = |sum: Sum| sum.mean(self.vectors, 1.0);
        let side = self.regions.side();
        Point {
            shape,
            counted: Bins { by_box: mean(sums.by_box), by_columns: mean(sums.by_columns), tight: mean(sums.tight) },
            by_formula: Bins {
                by_box: shape.by_box(side),
                by_columns: shape.by_columns(side),
                tight: shape.tight(side),
            },
        }
    }
}

impl Bins<Sum> {
    fn add(&mut self, other: Bins<Sum>) {
        self.by_box.add(other.by_box);
        self.by_columns.add(other.by_columns);
        self.tight.add(other.tight);
    }
}

#[cfg(test)]
mod tests;
