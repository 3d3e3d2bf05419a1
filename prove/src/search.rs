//! The base case: the first clocks from the start.

use crate::edges::Edges;
use crate::model::{Goal, GoalKind, Model};
use crate::pass::Found;
use crate::prepare::Stated;
use crate::replay::{Replayer, in_reset};
use crate::solver::{Halt, Solver};

/// Searches the first clocks, one after another.
pub struct Search<'a> {
    solver: Solver<'a>,
    replayer: &'a Replayer<'a>,
    stated: &'a [Stated],
}

impl<'a> Search<'a> {
    /// A search that has not begun.
    ///
    /// # Errors
    ///
    /// The solver does not start.
    pub fn new(mut solver: Solver<'a>, replayer: &'a Replayer<'a>, stated: &'a [Stated]) -> Result<Search<'a>, Halt> {
        solver.tell("(declare-fun quiet () Bool)\n")?;
        Ok(Search { solver, replayer, stated })
    }

    /// Searches clock `at`: finds runs for open goals that do not hold at its end. Returns whether the assumptions allow
    /// such a clock.
    ///
    /// # Errors
    ///
    /// There is no answer.
    pub fn clock(&mut self, at: u32, found: &mut [Found]) -> Result<bool, Halt> {
        self.solver.state(at)?;
        if at == 0 {
            let begin = self.solver.of("i", 0);
            self.solver.assert(&begin)?;
            for condition in self.replayer.start.conditions(self.model()) {
                self.solver.assert(&condition)?;
            }
        }
        if let Some(reset) = in_reset(self.replayer.design, &self.solver, at) {
            self.solver.assert(&format!("(=> quiet (not {reset}))"))?;
        }
        if !self.solver.is_possible(&[])? {
            return Ok(false);
        }
        while self.find(at, GoalKind::Assertion, found)? {}
        // A run ends where an assertion fails. The simulator counts no cover there.
        for goal in self.model().goals.iter().filter(|goal| goal.kind == GoalKind::Assertion) {
            let holds = holds(&self.solver, goal, at);
            self.solver.assert(&holds)?;
        }
        for kind in [GoalKind::Cover, GoalKind::Helper] {
            while self.find(at, kind, found)? {}
        }
        Ok(true)
    }

    fn model(&self) -> &'a Model {
        self.replayer.model
    }

    /// Finds a run at whose end some open goals do not hold; returns whether there is one.
    fn find(&mut self, at: u32, kind: GoalKind, found: &mut [Found]) -> Result<bool, Halt> {
        let goals = self.model().goals.iter().enumerate();
        let open: Vec<(usize, &Goal)> =
            goals.filter(|(index, goal)| goal.kind == kind && found[*index] == Found::Open).collect();
        if open.is_empty() {
            return Ok(false);
        }
        let all: Vec<String> = open.iter().map(|(_, goal)| holds(&self.solver, goal, at)).collect();
        self.solver.tell("(push 1)\n")?;
        self.solver.assert(&format!("(not (and {}))", all.join(" ")))?;
        // A run without a further reset is easier to read.
        let is_found = self.solver.is_possible(&["quiet"])? || self.solver.is_possible(&[])?;
        if is_found {
            let values = self.solver.values(&all)?;
            for ((index, goal), _) in open.iter().zip(&values).filter(|(_, holds)| !holds[0]) {
                found[*index] = match kind {
                    GoalKind::Helper => Found::NoHelp,
                    // The simulator has the edges of the periods alone.
                    _ if self.replayer.edges == Edges::Any => Found::NoHelp,
                    _ => Found::Run(Box::new(self.replayer.run(&mut self.solver, at, &self.stated[goal.number])?)),
                };
            }
        }
        self.solver.tell("(pop 1)\n")?;
        Ok(is_found)
    }
}

/// Whether a goal holds in clock `at`, as an expression.
pub fn holds(solver: &Solver, goal: &Goal, at: u32) -> String {
    let function = solver.of(&goal.function, at);
    if goal.kind == GoalKind::Cover { format!("(not {function})") } else { function }
}
