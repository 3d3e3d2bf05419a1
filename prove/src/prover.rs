//! The prover: the base case and induction in turn, clock by clock.

use crate::induction::Induction;
use crate::invariant;
use crate::model::{GoalKind, Model, model};
use crate::prepare::{Prepared, Stated, prepare};
use crate::replay::Replayer;
use crate::search::Search;
use crate::solver::{Halt, Patience, Solver};
use crate::start::{Start, simulation};
use crate::{Error, Outcome, Proof, Run, Statement};
use std::time::{Duration, Instant};
use tilewright_hdl::Design;
use tilewright_hdl::ir::Directive;

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

/// What is found of a goal.
#[derive(Default)]
pub enum Found {
    /// Nothing yet.
    #[default]
    Open,
    /// It holds for ever, by induction over this number of clocks.
    Proved(u32),
    /// It holds for ever, by an invariant.
    Implied,
    /// It does not hold at the end of this run.
    Run(Box<Run>),
    /// It is a helper that does not hold.
    NoHelp,
}

impl PartialEq for Found {
    fn eq(&self, other: &Found) -> bool {
        matches!((self, other), (Found::Open, Found::Open))
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

    /// The most seconds that the solver may take. What is open then is not settled.
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
        // The time is the solver's; it has not begun.
        let model = match model(&prepared, &Patience { stop, end: None }) {
            Ok(model) => model,
            Err(Halt::Failed(error)) => return Err(error),
            Err(Halt::Late) => unreachable!("there is no end"),
        };
        let start = Start::of(design, &prepared.design)?;
        let replayer = Replayer { design, model: &model, start: &start, sim: simulation(design)? };
        let patience = Patience { stop, end: self.seconds.map(|seconds| begin + Duration::from_secs(seconds)) };
        let mut work = Work {
            found: model.goals.iter().map(|_| Found::Open).collect(),
            times: vec![Duration::ZERO; model.goals.len()],
            begin,
            clocks: 0,
            ends: None,
        };
        let run = work.run(self.depth, &replayer, &prepared.stated, &patience, show);
        let run = run.and_then(|()| work.find_invariant(&prepared, &model, &patience));
        match run {
            Ok(()) | Err(Halt::Late) => Ok(work.proof(&model, prepared.stated)),
            Err(Halt::Failed(error)) => Err(error),
        }
    }
}

/// The state of a proof.
struct Work {
    /// By goal.
    found: Vec<Found>,
    times: Vec<Duration>,
    begin: Instant,
    /// The clocks that are searched.
    clocks: u32,
    ends: Option<u32>,
}

impl Work {
    fn run(
        &mut self,
        depth: u32,
        replayer: &Replayer,
        stated: &[Stated],
        patience: &Patience,
        show: &dyn Fn(f64),
    ) -> Result<(), Halt> {
        if self.found.is_empty() {
            return Ok(());
        }
        let mut search = Search::new(Solver::new(replayer.model, patience)?, replayer, stated)?;
        let mut induction = Induction::new(Solver::new(replayer.model, patience)?, replayer.model)?;
        for clock in 0..depth {
            show(f64::from(clock) / f64::from(depth));
            if !search.clock(clock, &mut self.found)? {
                self.ends = Some(clock);
                break;
            }
            self.clocks = clock + 1;
            self.time();
            if self.is_done(replayer.model) {
                break;
            }
            induction.step(&mut self.found)?;
            self.time();
            if self.is_done(replayer.model) {
                break;
            }
        }
        Ok(())
    }

    /// Searches an invariant for what is open, unless an assertion fails.
    fn find_invariant(&mut self, prepared: &Prepared, model: &Model, patience: &Patience) -> Result<(), Halt> {
        let assertions = || (0..model.goals.len()).filter(|&goal| model.goals[goal].kind == GoalKind::Assertion);
        let open: Vec<usize> = assertions().filter(|&goal| self.found[goal] == Found::Open).collect();
        let fails = assertions().any(|goal| matches!(self.found[goal], Found::Run(_)));
        if !open.is_empty() && !fails && invariant::is_found(prepared, patience)? {
            open.into_iter().for_each(|goal| self.found[goal] = Found::Implied);
            self.time();
        }
        Ok(())
    }

    fn is_done(&self, model: &Model) -> bool {
        let mut all = self.found.iter().zip(&model.goals);
        !all.any(|(found, goal)| *found == Found::Open && goal.kind != GoalKind::Helper)
    }

    /// Notes the time of what was just found.
    fn time(&mut self) {
        let now = self.begin.elapsed();
        let found = self.found.iter().zip(&mut self.times);
        found.filter(|(found, time)| **found == Found::Open || time.is_zero()).for_each(|(found, time)| {
            *time = if *found == Found::Open { Duration::ZERO } else { now };
        });
    }

    /// What was found, statement by statement.
    fn proof(mut self, model: &Model, stated: Vec<Stated>) -> Proof {
        let total = self.begin.elapsed();
        let mut statements = Vec::new();
        for (number, stated) in stated.into_iter().enumerate() {
            if !matches!(stated.directive, Directive::Assert | Directive::Cover) {
                continue;
            }
            let goals =
                model.goals.iter().enumerate().filter(|(_, it)| it.number == number && it.kind != GoalKind::Helper);
            let goals: Vec<usize> = goals.map(|(index, _)| index).collect();
            let (outcome, time) = self.outcome(&goals);
            let time = if outcome.is_settled() { time } else { total };
            let Stated { directive, message, module, loc } = stated;
            statements.push(Statement { directive, message, module, loc, outcome, time });
        }
        Proof { statements, ends_after: self.ends }
    }

    /// What is known of all these goals together: the shortest run, or else what is not settled.
    fn outcome(&mut self, goals: &[usize]) -> (Outcome, Duration) {
        let clock = |goal: &&usize| match &self.found[**goal] {
            Found::Run(run) => Some(run.clock),
            _ => None,
        };
        let first = goals.iter().filter(|goal| clock(goal).is_some()).min_by_key(|goal| clock(goal));
        if let Some(&goal) = first
            && let Found::Run(run) = std::mem::take(&mut self.found[goal])
        {
            return (Outcome::Fails(*run), self.times[goal]);
        }
        let (mut depth, mut time) = (Some(0), Duration::ZERO);
        for &goal in goals {
            match self.found[goal] {
                Found::Proved(clocks) => depth = depth.map(|depth: u32| depth.max(clocks)),
                Found::Implied => depth = None,
                _ => return (Outcome::Holds { clocks: self.clocks }, Duration::ZERO),
            }
            time = time.max(self.times[goal]);
        }
        (Outcome::Proved { depth }, time)
    }
}
