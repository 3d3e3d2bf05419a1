//! Running several processes: each is resumed at every instant.

use std::task::{Context, Waker};

use tilewright_circuit::Loc;

use super::{Processes, Testbench};
use crate::testbench::run::done;

impl Testbench<'_> {
    /// Runs processes side by side until each has ended, except for monitors, and returns their results.
    ///
    /// All begin at once; values that they set before their first wait are in effect before the next edge. From then
    /// on, each resumes at the edges that it waits for. The instant at which the last one ends is executed.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// let (enable, count, t) = (sim.i.enable, sim.o.count, sim.testbench());
    /// let drives = async {
    ///     t.set(enable, 1);
    ///     t.wait(3).await;
    ///     t.set(enable, 0);
    /// };
    /// let ((), ()) = t.run((drives, t.wait(10)));
    /// assert_eq!(t.get_u64(count), 3);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// They have not ended within the [limit](Testbench::limit): the message lists what each of them waits for. Or a
    /// process panics, or as [`Simulation::step`](crate::Simulation::step).
    #[track_caller]
    pub fn run<P: Processes>(&self, processes: P) -> P::Output {
        let loc = Loc::caller();
        assert!(self.shared.borrow().running.is_none(), "a process calls `run`, at {loc}: give all processes to one");
        let mut members = processes.members(self);
        // Only time wakes a process, so all are resumed at each instant.
        let mut context = Context::from_waker(Waker::noop());
        let mut has_ended = P::go_on(&mut members, self, &mut context);
        self.drive_sets();
        self.settle(loc, || P::settle(&mut members, self));
        let limit = self.shared.borrow().limit;
        for instant in 0.. {
            if has_ended {
                break;
            }
            assert!(instant < limit, "{}", self.stuck(limit, loc));
            self.shared.borrow_mut().next_turn();
            has_ended = P::go_on(&mut members, self, &mut context);
            done(self.shared.borrow_mut().circuit.try_step());
            self.drive_sets();
            self.settle(loc, || P::settle(&mut members, self));
        }
        self.shared.borrow_mut().instant = None;
        P::outputs(members)
    }

    /// Sets the inputs as the processes requested.
    fn drive_sets(&self) {
        let mut shared = self.shared.borrow_mut();
        for set in std::mem::take(&mut shared.sets) {
            shared.circuit.set(set.port, set.value);
        }
    }

    /// Lets models answer within the clock, until none of them answers anything else.
    fn settle(&self, loc: Loc, mut round: impl FnMut() -> bool) {
        // Each round settles one answer more of a chain, and a run has eight processes at most.
        let settles = (0..=8).any(|_| !round());
        assert!(
            settles,
            "the answers in the run at {loc} change each other without end: they depend on each other in a loop"
        );
    }

    /// Lists what each process waits for.
    fn stuck(&self, limit: u64, loc: Loc) -> String {
        let shared = self.shared.borrow();
        let mut text = format!("the processes of the run at {loc} have not ended after {limit} instants:");
        for waiting in &shared.waiting {
            text += &format!("\n{}", waiting.text(shared.circuit));
        }
        text + "\nif they need longer, say so with `.limit(instants)`"
    }
}

impl super::Shared<'_> {
    /// Prepares for resuming the processes before the next instant.
    fn next_turn(&mut self) {
        self.turns += 1;
        self.waiting.clear();
        self.instant = self.circuit.timeline.next_time();
        // At the end of time, the following step reports the error.
        self.circuit.timeline.rising_at(self.instant.unwrap_or(0), &mut self.rising);
    }
}
