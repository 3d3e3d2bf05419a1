//! Waiting for edges, and for conditions at edges.

use std::future::Future;
use std::pin::Pin;
use std::task::{Context, Poll};

use tilewright_circuit::Loc;

use super::Testbench;
use crate::engine::until::Until;
use crate::testbench::condition::Condition;
use crate::testbench::running::Running;

/// A waiting process, for the message of a testbench that gives up.
pub(super) struct Waiting {
    what: What,
    /// The time at which it began, in picoseconds.
    since: u64,
    loc: Loc,
}

/// The goal of a wait, for messages.
#[derive(Clone, Copy)]
enum What {
    Edges(u64),
    Condition(Condition),
}

/// The goal of a wait.
enum Goal {
    /// This number of edges.
    Edges(u64),
    /// The edge at which the condition is true, in its two forms.
    Until(Until, Condition),
}

impl Waiting {
    /// A sentence and the line.
    pub fn text(&self, circuit: &Running) -> String {
        let what = match self.what {
            What::Edges(1) => "an edge".to_owned(),
            What::Edges(left) => format!("{left} edges"),
            What::Condition(condition) => circuit.condition_text(condition),
        };
        format!("one has waited since {} ps for {what}\n  --> {}", self.since, self.loc)
    }
}

/// A wait, begun or not.
struct Wait<'t, 's> {
    testbench: &'t Testbench<'s>,
    goal: Goal,
    /// The count of resumptions at which it began, and the time then.
    began: Option<(u64, u64)>,
    loc: Loc,
}

impl<'s> Testbench<'s> {
    /// Waits for the next edge.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// let t = sim.testbench();
    /// t.run((async {
    ///     t.step().await;
    ///     t.step().await;
    /// },));
    /// assert_eq!(t.time(), 20_000);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    #[track_caller]
    pub fn step(&self) -> impl Future<Output = ()> {
        self.begin(Goal::Edges(1), Loc::caller())
    }

    /// Waits for `edges` edges.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// let t = sim.testbench();
    /// t.run((t.wait(3), t.wait(5)));
    /// assert_eq!(t.time(), 50_000);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    #[track_caller]
    pub fn wait(&self, edges: u64) -> impl Future<Output = ()> {
        self.begin(Goal::Edges(edges), Loc::caller())
    }

    /// Waits for the first edge, from the next one on, before which a condition is true: `t.until(done)`,
    /// `t.until(count.is_at_least(5))`.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// let (enable, count, t) = (sim.i.enable, sim.o.count, sim.testbench());
    /// t.set(enable, 1);
    /// t.run((t.until(count.is_at_least(5)),));
    /// assert_eq!(t.time(), 60_000); // before the sixth edge it is 5
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// The number of the condition does not fit in its port, or a port of several bits is not compared with a number.
    #[track_caller]
    pub fn until(&self, condition: impl Into<Condition>) -> impl Future<Output = ()> {
        self.until_at(condition.into(), Loc::caller())
    }

    /// Like [`Testbench::wait`], at this source line.
    pub(super) fn wait_at(&self, edges: u64, loc: Loc) -> impl Future<Output = ()> {
        self.begin(Goal::Edges(edges), loc)
    }

    /// Like [`Testbench::until`], at this source line.
    #[track_caller]
    pub(super) fn until_at(&self, condition: Condition, loc: Loc) -> impl Future<Output = ()> {
        let until = self.shared.borrow().circuit.until(condition);
        self.begin(Goal::Until(until, condition), loc)
    }

    fn begin(&self, goal: Goal, loc: Loc) -> Wait<'_, 's> {
        Wait { testbench: self, goal, began: None, loc }
    }
}

impl Future for Wait<'_, '_> {
    type Output = ();

    fn poll(mut self: Pin<&mut Self>, _: &mut Context) -> Poll<()> {
        let testbench = self.testbench;
        let mut shared = testbench.shared.borrow_mut();
        let now = (shared.turns, shared.now());
        let (turn, since) = *self.began.get_or_insert(now);
        // A wait does not end at the edge at which it began.
        let rises = turn != shared.turns && testbench.clock.is_none_or(|clock| shared.rising.contains(&clock));
        let is_over = match &mut self.goal {
            Goal::Edges(left) => {
                *left = left.saturating_sub(rises.into());
                *left == 0
            }
            Goal::Until(until, _) => rises && until.holds(shared.circuit.engine.read(until.value)),
        };
        if is_over {
            return Poll::Ready(());
        }
        if shared.running.is_some_and(|turn| !turn.is_monitor) {
            let what = match &self.goal {
                Goal::Edges(left) => What::Edges(*left),
                Goal::Until(_, condition) => What::Condition(*condition),
            };
            shared.waiting.push(Waiting { what, since, loc: self.loc });
        }
        Poll::Pending
    }
}
