//! Processes that run side by side: tuples and lists of them.

use std::future::{Future, poll_fn};
use std::pin::Pin;
use std::task::{Context, Poll};

use super::{Testbench, Turn};

/// A process: a future, such as an `async` block, or a [`monitor`].
///
/// ```
/// # use tilewright_sim::{Simulation, for_examples::Counter};
/// let mut sim = Simulation::of(&Counter)?;
/// use tilewright_sim::monitor;
///
/// let (count, t) = (sim.o.count, sim.testbench());
/// let watches = async {
///     loop {
///         t.step().await;
///         assert_eq!(t.get_u64(count), 0);
///     }
/// };
/// t.run((t.wait(10), monitor(watches))); // both are processes
/// assert_eq!(t.time(), 100_000);
/// # Ok::<(), tilewright_sim::Error>(())
/// ```
pub trait Process {
    /// The result at its end.
    type Output;
    #[doc(hidden)]
    type Future: Future;
    #[doc(hidden)]
    const IS_MONITOR: bool;

    #[doc(hidden)]
    fn future(self) -> Self::Future;

    /// The result, from that of its future if it has ended.
    #[doc(hidden)]
    fn output(gave: Option<<Self::Future as Future>::Output>) -> Self::Output;

    /// What it sets within the clock; returns whether that is something else than before.
    #[doc(hidden)]
    fn settle(_: Pin<&mut Self::Future>, _: &Testbench) -> bool {
        false
    }
}

impl<F: Future> Process for F {
    type Output = F::Output;
    type Future = F;
    const IS_MONITOR: bool = false;

    fn future(self) -> F {
        self
    }

    fn output(gave: Option<F::Output>) -> F::Output {
        gave.expect("a run goes on until each process has ended")
    }
}

/// A process that watches the others and need not end; made by [`monitor`].
///
/// ```
/// # use tilewright_sim::{Simulation, for_examples::Counter};
/// let mut sim = Simulation::of(&Counter)?;
/// use tilewright_sim::monitor;
///
/// let t = sim.testbench();
/// t.run((t.wait(3), monitor(t.wait(1000)))); // nobody waits for the monitor
/// assert_eq!(t.time(), 30_000);
/// # Ok::<(), tilewright_sim::Error>(())
/// ```
#[derive(Debug)]
pub struct Monitor<F>(F);

/// Makes a process a monitor: it watches as long as other processes run, and nobody waits for its end. See
/// [`Testbench`] for an example.
///
/// ```
/// # use tilewright_sim::{Simulation, for_examples::Counter};
/// let mut sim = Simulation::of(&Counter)?;
/// use tilewright_sim::monitor;
///
/// let (enable, count, t) = (sim.i.enable, sim.o.count, sim.testbench());
/// let never_wraps = async {
///     loop {
///         t.step().await;
///         assert!(t.get_u64(count) < 100);
///     }
/// };
/// t.set(enable, 1);
/// t.run((t.until(count.is(50)), monitor(never_wraps)));
/// # Ok::<(), tilewright_sim::Error>(())
/// ```
pub fn monitor<F: Future>(process: F) -> Monitor<F> {
    Monitor(process)
}

impl<F: Future> Process for Monitor<F> {
    type Output = ();
    type Future = F;
    const IS_MONITOR: bool = true;

    fn future(self) -> F {
        self.0
    }

    fn output(_: Option<F::Output>) {}
}

/// A running process.
#[doc(hidden)]
pub struct Member<P: Process> {
    turn: Turn,
    /// `None` after it has ended.
    future: Option<Pin<Box<P::Future>>>,
    gave: Option<<P::Future as Future>::Output>,
}

impl<P: Process> Member<P> {
    fn new(testbench: &Testbench, process: P) -> Member<P> {
        let mut shared = testbench.shared.borrow_mut();
        shared.processes += 1;
        let turn = Turn { number: shared.processes, is_monitor: P::IS_MONITOR };
        Member { turn, future: Some(Box::pin(process.future())), gave: None }
    }

    /// Resumes it; returns whether it is over, or is a monitor.
    fn go_on(&mut self, testbench: &Testbench, context: &mut Context) -> bool {
        let Some(future) = &mut self.future else { return true };
        let outer = testbench.shared.borrow().running;
        let is_monitor = self.turn.is_monitor || outer.is_some_and(|outer| outer.is_monitor);
        testbench.shared.borrow_mut().running = Some(Turn { is_monitor, ..self.turn });
        if let Poll::Ready(output) = future.as_mut().poll(context) {
            (self.future, self.gave) = (None, Some(output));
        }
        testbench.shared.borrow_mut().running = outer;
        self.future.is_none() || self.turn.is_monitor
    }

    /// What it sets within the clock; returns whether that is something else than before.
    fn settle(&mut self, testbench: &Testbench) -> bool {
        self.future.as_mut().is_some_and(|future| P::settle(future.as_mut(), testbench))
    }

    fn output(self) -> P::Output {
        P::output(self.gave)
    }
}

impl Testbench<'_> {
    /// Several processes of one kind as one, which returns the result of each: for example, a receiver for each
    /// output of a block.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// let t = sim.testbench();
    /// let waits = (1..=3).map(|edges| {
    ///     let t = &t;
    ///     async move {
    ///         t.wait(edges).await;
    ///         t.time()
    ///     }
    /// });
    /// assert_eq!(t.run((t.all(waits),)).0, [10_000, 20_000, 30_000]);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn all<F: Future>(&self, processes: impl IntoIterator<Item = F>) -> impl Future<Output = Vec<F::Output>> {
        let mut members: Vec<Member<F>> = processes.into_iter().map(|process| Member::new(self, process)).collect();
        poll_fn(move |context| {
            let going = members.iter_mut().filter_map(|member| (!member.go_on(self, context)).then_some(())).count();
            if going > 0 {
                return Poll::Pending;
            }
            Poll::Ready(std::mem::take(&mut members).into_iter().map(Member::output).collect())
        })
    }
}

/// The argument of [`Testbench::run`]: a tuple of up to eight processes.
///
/// ```
/// # use tilewright_sim::{Simulation, for_examples::Counter};
/// let mut sim = Simulation::of(&Counter)?;
/// let t = sim.testbench();
/// let ((), six) = t.run((t.wait(2), async { 6 })); // a tuple returns a tuple
/// assert_eq!(six, 6);
/// # Ok::<(), tilewright_sim::Error>(())
/// ```
#[diagnostic::on_unimplemented(
    message = "a `{Self}` is not a group of processes",
    note = "`run` takes a tuple, as `t.run((producer, consumer))`; `t.all(..)` makes one process of a list, and a single one is `(process,)`"
)]
pub trait Processes {
    /// The results.
    type Output;
    #[doc(hidden)]
    type Members;

    #[doc(hidden)]
    fn members(self, testbench: &Testbench) -> Self::Members;

    /// Resumes each; returns whether all are over or monitors.
    #[doc(hidden)]
    fn go_on(members: &mut Self::Members, testbench: &Testbench, context: &mut Context) -> bool;

    #[doc(hidden)]
    fn outputs(members: Self::Members) -> Self::Output;

    /// What each sets within the clock; returns whether something is not as before.
    #[doc(hidden)]
    fn settle(members: &mut Self::Members, testbench: &Testbench) -> bool;
}

macro_rules! tuples {
    ($(($($process:ident)+))+) => {$(
        #[allow(non_snake_case, reason = "a member has the name of its type")]
        impl<$($process: Process),+> Processes for ($($process,)+) {
            type Output = ($($process::Output,)+);
            type Members = ($(Member<$process>,)+);

            fn members(self, testbench: &Testbench) -> Self::Members {
                let ($($process,)+) = self;
                ($(Member::new(testbench, $process),)+)
            }

            fn go_on(($($process,)+): &mut Self::Members, testbench: &Testbench, context: &mut Context) -> bool {
                // All are resumed, also after one that is not over.
                [$($process.go_on(testbench, context)),+].into_iter().all(|is_over| is_over)
            }

            fn settle(($($process,)+): &mut Self::Members, testbench: &Testbench) -> bool {
                [$($process.settle(testbench)),+].into_iter().any(|is_other| is_other)
            }

            fn outputs(($($process,)+): Self::Members) -> Self::Output {
                ($($process.output(),)+)
            }
        }
    )+};
}
tuples! { (A) (A B) (A B C) (A B C D) (A B C D E) (A B C D E F) (A B C D E F G) (A B C D E F G H) }
