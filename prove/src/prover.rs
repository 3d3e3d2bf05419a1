//! The prover: a pass over the runs of a design, or two where it has several clocks.

use crate::edges::Edges;
use crate::known::Known;
use crate::model::model;
use crate::pass::Pass;
use crate::prepare::prepare;
use crate::replay::Replayer;
use crate::solver::{Halt, Patience};
use crate::start::{Start, simulation};
use crate::{Error, Proof, Stage};
use std::time::{Duration, Instant};
use tilewright_hdl::Design;

/// The clocks that are searched if nobody says otherwise.
const DEPTH: u32 = 20;

/// Proves what designs state.
///
/// ```
/// use tilewright_prove::Prover;
/// let quick = Prover::new().depth(5).seconds(10);
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Prover {
    depth: u32,
    seconds: Option<u64>,
}

impl Default for Prover {
    fn default() -> Prover {
        Prover::new()
    }
}

impl Prover {
    /// A prover that searches 20 clocks and takes as long as it needs.
    ///
    /// ```
    /// assert_eq!(format!("{:?}", tilewright_prove::Prover::new()), "Prover { depth: 20, seconds: None }");
    /// ```
    pub fn new() -> Prover {
        Prover { depth: DEPTH, seconds: None }
    }

    /// The number of clocks to search from the start; induction is over at most as many.
    ///
    /// ```
    /// assert_eq!(format!("{:?}", tilewright_prove::Prover::new().depth(7)), "Prover { depth: 7, seconds: None }");
    /// ```
    pub fn depth(self, depth: u32) -> Prover {
        Prover { depth, ..self }
    }

    /// The most seconds that a proof may take, with the conversion by Yosys. What is open then is not settled.
    ///
    /// ```
    /// assert_eq!(format!("{:?}", tilewright_prove::Prover::new().seconds(9)), "Prover { depth: 20, seconds: Some(9) }");
    /// ```
    pub fn seconds(self, seconds: u64) -> Prover {
        Prover { seconds: Some(seconds), ..self }
    }

    /// Proves what a design states.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// use tilewright_prove::{Error, Prover};
    /// # let design = tilewright_sim::shown! { |m, i| in { x: bits(4), y: bits(4) } out { sum: bits(4) }
    /// def!(sum = i.x + i.y);
    /// m.assert((sum - i.y).eq(i.x), "a sum can be undone");
    /// #     ShownOut { sum }
    /// # };
    /// match Prover::new().prove(&design) {
    ///     Ok(proof) => assert!(proof.statements[0].outcome.is_settled()),
    ///     Err(Error::Missing(_)) => {} // Yosys or Z3 is not installed
    ///     Err(error) => panic!("{error}"),
    /// }
    /// ```
    ///
    /// # Errors
    ///
    /// A program is missing or fails, or the design is not one that can be proved.
    pub fn prove(&self, design: &Design) -> Result<Proof, Error> {
        self.prove_watched(design, &|_| (), &|| false)
    }

    /// Like [`Prover::prove`], but tells `show` the part of the clocks that is searched, from 0 to 1, and asks `stop` many
    /// times a second whether to stop.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// use tilewright_prove::{Error, Prover};
    /// # let design = tilewright_sim::shown! { |m, i| in { x: bits(4) } out { same: bits(4) }
    /// m.assert((i.x ^ i.x).eq(0), "it is zero");
    /// #     ShownOut { same: i.x }
    /// # };
    /// let stopped = Prover::new().prove_watched(&design, &|_| (), &|| true);
    /// assert!(matches!(stopped, Err(Error::Interrupted | Error::Missing(_))));
    /// ```
    ///
    /// # Errors
    ///
    /// As [`Prover::prove`]; [`Error::Interrupted`].
    pub fn prove_watched(&self, design: &Design, show: &dyn Fn(f64), stop: &dyn Fn() -> bool) -> Result<Proof, Error> {
        let begin = Instant::now();
        let prepared = prepare(design)?;
        let start = Start::of(design, &prepared.design)?;
        let mut known = Known::nothing(&prepared.stated);
        let end = self.seconds.map(|seconds| begin + Duration::from_secs(seconds));
        let passes: &[Edges] = if design.top().clocks.len() > 1 { &[Edges::Any, Edges::Exact] } else { &[Edges::One] };
        for (index, &edges) in (1_u32..).zip(passes) {
            let model = match model(&prepared, edges, &Patience { stop, end }) {
                Ok(model) => model,
                Err(Halt::Failed(error)) => return Err(error),
                Err(Halt::Late) => {
                    known.stop_in_conversion();
                    break;
                }
            };
            let replayer = Replayer { edges, design, model: &model, start: &start, sim: simulation(design)? };
            // Each pass has its share of the time that is left.
            let now = Instant::now();
            let share = |end: Instant| now + end.saturating_duration_since(now) / (passes.len() as u32 + 1 - index);
            let patience = Patience { stop, end: end.map(share) };
            let part = |done: f64| show((f64::from(index - 1) + done) / passes.len() as f64);
            let mut pass = Pass::new(&model, &known, begin);
            let run = pass.run(self.depth, &replayer, &prepared.stated, &patience, &part);
            let mut find = || pass.find_invariant(&prepared, edges, &model, &patience);
            let run = match run {
                Ok(()) => find().map_err(|halt| (halt, Stage::Invariant)),
                Err(halt) => Err((halt, Stage::Search)),
            };
            pass.end(edges, &model, &mut known);
            known.late = match run {
                Ok(()) => None,
                Err((Halt::Late, stage)) => Some(stage),
                Err((Halt::Failed(error), _)) => return Err(error),
            };
            if known.is_settled() {
                known.late = None;
                break;
            }
        }
        Ok(known.proof(prepared.stated, begin.elapsed()))
    }
}
