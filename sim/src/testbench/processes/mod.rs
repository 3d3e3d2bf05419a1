//! Processes side by side: the drivers, receivers and monitors of a test, each written as plain sequential code.
//!
//! A process is an `async` block that waits for edges with `.await`. At an instant, every process that waits for it
//! resumes. It sees all values settled before the edge, and sets its inputs for after the edge, as a register does.
//! So the sequence in which processes resume does not matter.

mod answer;
mod group;
mod pauses;
mod run;
mod streams;
mod wait;

pub use answer::Answer;
pub use group::{Monitor, Process, Processes, monitor};
pub use pauses::Pauses;

use std::cell::RefCell;
use std::rc::Rc;

use tilewright_circuit::{Bits, Loc};
use tilewright_hdl::Bundle;

use crate::testbench::port::{IntoValue, Port};
use crate::testbench::running::Running;
use crate::testbench::simulation::Simulation;
use wait::Waiting;

/// A simulation driven by several processes, made by [`Simulation::testbench`].
///
/// ```
/// # use tilewright_hdl::*;
/// # use tilewright_sim::{Pauses, Simulation, monitor};
/// # block! {
/// #     /// Adds one to each word.
/// #     struct Increment;
/// #     in IncrementIn { words: stream(8) }
/// #     out IncrementOut { sums: stream(8) }
/// # }
/// # impl Increment {
/// #     fn build(&self, m: Module, i: IncrementIn) -> IncrementOut {
/// #         def!(full = m.reg(bit()).reset(0));
/// #         def!(sum = m.reg(8));
/// #         let (sums, sent) = m.offer(full, *sum);
/// #         let words = i.words.take_when(!full | sent);
/// #         sum.when(words.taken, *words + 1);
/// #         full.when(words.taken, 1).when(sent, 0);
/// #         IncrementOut { sums }
/// #     }
/// # }
/// let mut sim = Simulation::of(&Increment)?;
/// sim.reset();
/// let (words, sums) = (sim.i.words, sim.o.sums);
/// let t = sim.testbench();
/// let producer = async {
///     for word in 1..=9 {
///         t.send(words, word).await;
///     }
/// };
/// let consumer = async {
///     let mut seen = Vec::new();
///     while seen.len() < 9 {
///         t.wait(2).await; // it is slow
///         seen.push(t.receive(sums).await);
///     }
///     seen
/// };
/// let checker = async {
///     loop {
///         t.step().await;
///         assert_ne!(t.get_u64(sums.payload), 1, "at {} ps", t.time());
///     }
/// };
/// let ((), seen, ()) = t.run((producer, consumer, monitor(checker)));
/// assert_eq!(seen, [2, 3, 4, 5, 6, 7, 8, 9, 10]);
///
/// // The same with built-in processes: random pauses from a seed, and the expected words.
/// t.run((
///     t.send_all(words, 1..=9, Pauses::percent(30, 1)),
///     t.expect_all(sums, 2..=10, Pauses::percent(50, 2)),
///     monitor(t.holds(sums)),
/// ));
/// # Ok::<(), tilewright_sim::Error>(())
/// ```
#[derive(Clone)]
pub struct Testbench<'s> {
    shared: Rc<RefCell<Shared<'s>>>,
    /// The clock whose edges are waited for; `None` means those of every clock.
    clock: Option<usize>,
}

/// The state that all processes share.
struct Shared<'s> {
    circuit: &'s mut Running,
    /// The number of instants within which all must end.
    limit: u64,
    /// The number of times that all processes have been resumed: at the start, and at each instant since.
    turns: u64,
    /// The instant at which processes resume, except at the start: its time, and the clocks that rise.
    instant: Option<u64>,
    rising: Vec<usize>,
    /// The process that is running.
    running: Option<Turn>,
    /// The number of processes so far.
    processes: u32,
    /// The inputs after the edge.
    sets: Vec<Set>,
    /// The waits of the processes that have been resumed.
    waiting: Vec<Waiting>,
}

/// A process that is running.
#[derive(Clone, Copy)]
struct Turn {
    number: u32,
    /// Nobody waits for its end.
    is_monitor: bool,
}

/// A new value of an input.
struct Set {
    port: Port,
    value: Bits,
    process: u32,
    loc: Loc,
}

impl<I: Bundle, O: Bundle> Simulation<I, O> {
    /// The simulation for several processes, such as a driver, a receiver and a monitor; see [`Testbench`].
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// let (enable, count, t) = (sim.i.enable, sim.o.count, sim.testbench());
    /// t.run((async {
    ///     t.set(enable, 1);
    ///     t.wait(5).await;
    ///     assert_eq!(t.get_u64(count), 4); // just before the fifth edge
    /// },));
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn testbench(&mut self) -> Testbench<'_> {
        let shared = Shared {
            circuit: &mut self.circuit,
            limit: 100_000,
            turns: 0,
            instant: None,
            rising: Vec::new(),
            running: None,
            processes: 0,
            sets: Vec::new(),
            waiting: Vec::new(),
        };
        Testbench { shared: Rc::new(RefCell::new(shared)), clock: None }
    }
}

impl<'s> Testbench<'s> {
    /// The same testbench, stepping by the edges of one clock, given directly or by name. Otherwise it steps by those
    /// of every clock.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// let t = sim.testbench();
    /// t.run((t.on("clk").wait(3),));
    /// assert_eq!(t.time(), 30_000);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// There is no such clock.
    #[track_caller]
    pub fn on(&self, clock: impl AsRef<str>) -> Testbench<'s> {
        match self.shared.borrow().circuit.clock(clock.as_ref()) {
            Ok(clock) => Testbench { shared: self.shared.clone(), clock: Some(clock) },
            Err(unknown) => panic!("{unknown}"),
        }
    }

    /// Sets the number of instants after which the testbench gives up; the default is 100,000.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// let t = sim.testbench();
    /// t.limit(10);
    /// t.run((t.wait(10),)); // one more would panic, with a message that says what waits
    /// assert_eq!(t.time(), 100_000);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn limit(&self, instants: u64) {
        self.shared.borrow_mut().limit = instants;
    }

    /// Sets an input. Within a process, it changes after the edge, when every process has been resumed; elsewhere it
    /// changes immediately.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// let (enable, count, t) = (sim.i.enable, sim.o.count, sim.testbench());
    /// t.run((async {
    ///     t.step().await;
    ///     t.set(enable, 1); // after the first edge
    ///     t.wait(2).await;
    ///     assert_eq!(t.get_u64(count), 1);
    /// },));
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// The value does not fit, the port is an output, or another process sets it at this edge.
    #[track_caller]
    pub fn set(&self, port: Port, value: impl IntoValue) {
        self.set_at(port, value, Loc::caller());
    }

    /// The settled value of a port before the edge.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// let (count, t) = (sim.o.count, sim.testbench());
    /// assert_eq!(t.get(count).to_string(), "8'h00");
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    #[track_caller]
    pub fn get(&self, port: Port) -> Bits {
        self.shared.borrow_mut().circuit.get(port, 0)
    }

    /// Like [`Testbench::get`], for a port of up to 64 bits.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// let (enable, square, t) = (sim.i.enable, sim.o.square, sim.testbench());
    /// t.set(enable, 1);
    /// t.run((t.wait(4),));
    /// assert_eq!(t.get_u64(square), 16);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// The port is wider.
    #[track_caller]
    pub fn get_u64(&self, port: Port) -> u64 {
        self.shared.borrow_mut().circuit.narrow(port, 0)
    }

    /// The time in picoseconds of the edge at which the process resumes; outside of processes, the time of the last
    /// instant.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// let t = sim.testbench();
    /// t.run((async {
    ///     t.step().await;
    ///     assert_eq!(t.time(), 10_000);
    /// },));
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn time(&self) -> u64 {
        self.shared.borrow().now()
    }

    /// Runs `look` as if an input had this value at this moment, and then restores the input. It shows which outputs
    /// follow the input within the clock.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// let (enable, count, t) = (sim.i.enable, sim.o.count, sim.testbench());
    /// let now = t.get_u64(count);
    /// assert_eq!(t.suppose(enable, 1, || t.get_u64(count)), now); // the output comes from a register
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// The value does not fit, or the port is an output.
    #[track_caller]
    pub fn suppose<R>(&self, port: Port, value: impl IntoValue, look: impl FnOnce() -> R) -> R {
        let before = self.get(port);
        self.shared.borrow_mut().circuit.set(port, value);
        let seen = look();
        self.shared.borrow_mut().circuit.set(port, before);
        seen
    }

    #[track_caller]
    fn set_at(&self, port: Port, value: impl IntoValue, loc: Loc) {
        let mut shared = self.shared.borrow_mut();
        let Some(Turn { number: process, .. }) = shared.running else { return shared.circuit.set(port, value) };
        let set = Set { port, value: shared.circuit.fitting(port, value), process, loc };
        let Some(before) = shared.sets.iter().position(|set| set.port == port) else { return shared.sets.push(set) };
        let first = &shared.sets[before];
        assert!(
            first.process == process,
            "input `{}` is set by two processes at one edge, at {} and at {loc}: leave it to one of them",
            shared.circuit.declared(port).name,
            first.loc,
        );
        shared.sets[before] = set;
    }
}

impl Shared<'_> {
    /// The time at which processes resume.
    fn now(&self) -> u64 {
        self.instant.unwrap_or(self.circuit.timeline.time())
    }
}

impl std::fmt::Debug for Testbench<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.debug_struct("Testbench").field("time", &self.time()).finish_non_exhaustive()
    }
}
