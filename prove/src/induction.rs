//! Induction: goals that held for some clocks, whatever came before, hold in the next one.

use crate::model::Model;
use crate::pass::Found;
use crate::search::holds;
use crate::solver::{Halt, Solver};

/// Induction over more and more clocks.
pub struct Induction<'a> {
    solver: Solver<'a>,
    model: &'a Model,
    /// The goals that are proved, which hold in every clock.
    proved: Vec<usize>,
    /// The clocks so far.
    clocks: u32,
}

impl<'a> Induction<'a> {
    /// An induction that has not begun. The goals that are already proved hold in all clocks.
    ///
    /// # Errors
    ///
    /// The solver does not start.
    pub fn new(solver: Solver<'a>, model: &'a Model, found: &[Found]) -> Result<Induction<'a>, Halt> {
        let is_proved = |goal: &usize| matches!(found[*goal], Found::Proved(_) | Found::Implied);
        let proved = (0..found.len()).filter(is_proved).collect();
        let mut induction = Induction { solver, model, proved, clocks: 0 };
        induction.clock()?;
        Ok(induction)
    }

    /// Adds a clock.
    fn clock(&mut self) -> Result<(), Halt> {
        self.solver.state(self.clocks)?;
        self.clocks += 1;
        for goal in self.proved.clone() {
            self.assume(goal, self.clocks - 1)?;
        }
        Ok(())
    }

    fn assume(&mut self, goal: usize, at: u32) -> Result<(), Halt> {
        let holds = holds(&self.solver, &self.model.goals[goal], at);
        self.solver.assert(&holds)
    }

    /// Induction over one clock more: marks the open goals that it proves. All open goals hold in as many clocks from
    /// the start.
    ///
    /// # Errors
    ///
    /// There is no answer.
    pub fn step(&mut self, found: &mut [Found]) -> Result<(), Halt> {
        self.clock()?;
        let last = self.clocks - 1;
        let mut open: Vec<usize> = (0..found.len()).filter(|&index| found[index] == Found::Open).collect();
        while !open.is_empty() {
            let broken = self.broken(&open, last)?;
            if broken.is_empty() {
                break;
            }
            open.retain(|goal| !broken.contains(goal));
        }
        for goal in open {
            found[goal] = Found::Proved(last);
            self.proved.push(goal);
            for at in 0..=last {
                self.assume(goal, at)?;
            }
        }
        Ok(())
    }

    /// Goals that need not hold in the last clock although all of these held before.
    fn broken(&mut self, goals: &[usize], last: u32) -> Result<Vec<usize>, Halt> {
        self.solver.tell("(push 1)\n")?;
        for at in 0..last {
            for goal in goals {
                self.assume(*goal, at)?;
            }
        }
        let all: Vec<String> = goals.iter().map(|goal| holds(&self.solver, &self.model.goals[*goal], last)).collect();
        self.solver.assert(&format!("(not (and {}))", all.join(" ")))?;
        let values = if self.solver.is_possible(&[])? { self.solver.values(&all)? } else { Vec::new() };
        self.solver.tell("(pop 1)\n")?;
        Ok(goals.iter().zip(values).filter(|(_, holds)| !holds[0]).map(|(goal, _)| *goal).collect())
    }
}
