//! A pass over a set of runs: the base case and induction in turn, clock by clock, and then an invariant.

use crate::edges::Edges;
use crate::induction::Induction;
use crate::invariant;
use crate::known::Known;
use crate::model::{GoalKind, Model};
use crate::prepare::{Prepared, Stated};
use crate::replay::Replayer;
use crate::search::Search;
use crate::solver::{Halt, Patience, Solver};
use crate::{Outcome, Run};
use std::time::{Duration, Instant};

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
    /// It is a helper that does not hold, or it does not hold in a run that the simulator may not have.
    NoHelp,
}

impl PartialEq for Found {
    fn eq(&self, other: &Found) -> bool {
        matches!((self, other), (Found::Open, Found::Open))
    }
}

/// The state of a pass.
pub struct Pass {
    /// By goal.
    found: Vec<Found>,
    times: Vec<Duration>,
    begin: Instant,
    /// The clocks that are searched.
    clocks: u32,
    ends: Option<u32>,
}

impl Pass {
    /// A pass that has not begun. What was proved before holds.
    pub fn new(model: &Model, known: &Known, begin: Instant) -> Pass {
        let found = model.goals.iter().map(|goal| match known.outcome(goal.number) {
            Some(Outcome::Proved { depth, .. }) if goal.kind != GoalKind::Helper => {
                depth.map_or(Found::Implied, Found::Proved)
            }
            _ => Found::Open,
        });
        Pass { found: found.collect(), times: vec![Duration::ZERO; model.goals.len()], begin, clocks: 0, ends: None }
    }

    /// Searches and proves, clock by clock.
    ///
    /// # Errors
    ///
    /// There is no answer.
    pub fn run(
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
        let mut induction = Induction::new(Solver::new(replayer.model, patience)?, replayer.model, &self.found)?;
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
    ///
    /// # Errors
    ///
    /// A program fails, or the watcher asks to stop.
    pub fn find_invariant(
        &mut self,
        prepared: &Prepared,
        edges: Edges,
        model: &Model,
        patience: &Patience,
    ) -> Result<(), Halt> {
        let assertions = || (0..model.goals.len()).filter(|&goal| model.goals[goal].kind == GoalKind::Assertion);
        let open: Vec<usize> = assertions().filter(|&goal| self.found[goal] == Found::Open).collect();
        let fails = assertions().any(|goal| matches!(self.found[goal], Found::Run(_) | Found::NoHelp));
        if !open.is_empty() && !fails && invariant::is_found(prepared, edges, patience)? {
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

    /// Adds what was found, statement by statement.
    pub fn end(mut self, edges: Edges, model: &Model, known: &mut Known) {
        for number in known.open() {
            let goals = model.goals.iter().enumerate();
            let goals = goals.filter(|(_, it)| it.number == number && it.kind != GoalKind::Helper);
            let goals: Vec<usize> = goals.map(|(index, _)| index).collect();
            let (outcome, time) = self.outcome(edges, &goals);
            known.add(number, outcome, time);
        }
        known.ends_after = self.ends;
    }

    /// What is known of all these goals together: the shortest run, or else what is not settled.
    fn outcome(&mut self, edges: Edges, goals: &[usize]) -> (Outcome, Duration) {
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
        (Outcome::Proved { depth, needs_periods: edges == Edges::Exact && !goals.is_empty() }, time)
    }
}
