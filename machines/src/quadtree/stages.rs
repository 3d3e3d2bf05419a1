//! Performance, load and efficiency of stacks and of pipelines, from the time of a polygon on each level.
//!
//! Source: MPG-EQ6 to MPG-EQ12. They are true for all times, by formula or counted. The unit of time is t_e, the test of one subwindow.

use super::formulas::MAX_PERFORMANCE;
use super::rasters::Rasters;
use serde::Serialize;

/// The mean time of a polygon on each level, from level 1 on, in t_e: t_i.
///
/// ```
/// use tilewright_machines::quadtree::Stages;
///
/// let stages = Stages::new(vec![4.0, 5.0, 6.0]);
/// assert_eq!(stages.total(), 15.0);
/// assert_eq!(stages.slowest(), Some((3, 6.0)));
/// assert_eq!(stages.load(), 15.0 / 18.0);
/// ```
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Stages {
    times: Vec<f64>,
}

impl Stages {
    /// The levels' times, from level 1 on.
    pub fn new(times: Vec<f64>) -> Stages {
        Stages { times }
    }

    /// The levels' times, from level 1 on.
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// The whole work on a polygon, T (MPG-EQ6).
    pub fn total(&self) -> f64 {
        self.times.iter().sum()
    }

    /// The slowest level, the first of equals, and its time; `None` if there are no levels.
    pub fn slowest(&self) -> Option<(u32, f64)> {
        (1..).zip(self.times.iter().copied()).reduce(|most, this| if this.1 > most.1 { this } else { most })
    }

    /// Polygons per t_e of a processor with a stack, P_s = 1/T (MPG-EQ8).
    pub fn stack_performance(&self) -> f64 {
        1.0 / self.total()
    }

    /// Polygons per t_e of a processor that is a pipeline with a stage a level, P_p: its slowest stage limits it (MPG-EQ9).
    pub fn pipeline_performance(&self) -> f64 {
        1.0 / self.slowest().map_or(0.0, |(_, time)| time)
    }

    /// The mean load of a pipeline's stages, R_p: their mean time over the longest one (MPG-EQ10).
    pub fn load(&self) -> f64 {
        self.total() * self.pipeline_performance() / self.times.len() as f64
    }

    /// Efficiency of a matrix of `processors` with stacks, Q_a = Q_s, compared with one processor (MPG-EQ7, MPG-EQ8).
    pub fn stack_efficiency(&self, mono: &Stages, processors: u64) -> f64 {
        mono.total() / (processors as f64 * self.total())
    }

    /// Efficiency of a matrix of `processors` with pipelines, Q_p, compared with one processor with a stack (MPG-EQ11).
    pub fn pipeline_efficiency(&self, mono: &Stages, processors: u64) -> f64 {
        self.pipeline_performance() / (self.times.len() as f64 * processors as f64 * mono.stack_performance())
    }
}

/// The ordinates of the paper's figures 5 and 6.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Figures {
    /// Performance of the matrix of stacks over P_max (figure 5, a).
    pub p_s: f64,
    /// Efficiency of the algorithm, and of the matrix of stacks (figure 5, b).
    pub q_a: f64,
    /// Performance of the matrix of pipelines over P_max (figure 6, a).
    pub p_p: f64,
    /// Load of the pipelines (figure 6, b, solid).
    pub r_p: f64,
    /// Efficiency of the matrix of pipelines (figure 6, b, dashed).
    pub q_p: f64,
}

impl Figures {
    /// The ordinates of a matrix whose processors take the times `stages`; one processor for all pixels takes those of `mono`.
    ///
    /// ```
    /// use tilewright_machines::quadtree::{Figures, Rasters, Shape};
    ///
    /// let matrix = Rasters::square(4, 10);
    /// let of = |matrix: Rasters| matrix.stages_of(Shape::paper(100.0), 1.0);
    /// let figures = Figures::of(&matrix, &of(matrix), &of(matrix.mono()));
    /// assert!((figures.q_a - 0.083).abs() < 0.001);
    /// ```
    pub fn of(matrix: &Rasters, stages: &Stages, mono: &Stages) -> Figures {
        let processors = matrix.processors();
        Figures {
            p_s: stages.stack_performance() / MAX_PERFORMANCE,
            q_a: stages.stack_efficiency(mono, processors),
            p_p: stages.pipeline_performance() / MAX_PERFORMANCE,
            r_p: stages.load(),
            q_p: stages.pipeline_efficiency(mono, processors),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn times() -> impl Strategy<Value = Vec<f64>> {
        proptest::collection::vec(0.01..1e4_f64, 1..12)
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        /// MPG-EQ10 has two forms, MPG-EQ12 is Q_p = Q_a R_p, and Q_s of MPG-EQ8 is Q_a of MPG-EQ7, for all times.
        #[test]
        fn the_papers_identities_hold_of_any_times(stages in times(), mono in times(), processors in 1..500_u64) {
            let (n, pq) = (stages.len() as f64, processors as f64);
            let (stages, mono) = (Stages::new(stages), Stages::new(mono));
            let is_near = |one: f64, other: f64| (one / other - 1.0).abs() < 1e-12;
            let by_performance = stages.pipeline_performance() / (n * stages.stack_performance());
            prop_assert!(is_near(stages.load(), by_performance));
            let q_a = stages.stack_efficiency(&mono, processors);
            prop_assert!(is_near(q_a, stages.stack_performance() / (pq * mono.stack_performance())));
            prop_assert!(is_near(stages.pipeline_efficiency(&mono, processors), q_a * stages.load()));
            prop_assert!(stages.load() <= 1.0 + 1e-12 && stages.load() >= 1.0 / n - 1e-12);
        }
    }

    #[test]
    fn of_equally_slow_levels_the_first_counts() {
        assert_eq!(Stages::new(vec![1.0, 3.0, 3.0, 2.0]).slowest(), Some((2, 3.0)));
        assert_eq!(Stages::new(Vec::new()).slowest(), None);
    }
}
