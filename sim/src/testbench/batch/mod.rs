//! Many runs of one circuit side by side.

mod attach;
mod peek;
mod ports;
mod run;

use std::fmt;

use tilewright_circuit::{Bits, DefaultClock, Design};
use tilewright_hdl::{Block, Bundle, DEFAULT_PERIOD};

use crate::engine::EngineKind;
use crate::engine::Passes;
use crate::engine::program::{self, Program};
use crate::testbench::error::{Error, UnknownName};
use crate::testbench::port::Port;
use crate::testbench::simulation::{Simulation, Typed, typed};

/// Several runs of one circuit at once, each with its own inputs and start. They behave like that many
/// [`Simulation`](crate::Simulation)s, but are steps of one program: the compiled engine places the runs side by side
/// in vectors. A circuit without arrays gains from about 4 runs on, in proportion to the lanes of a vector. Beyond
/// that, the time grows with the number of runs.
///
/// ```
/// # use tilewright_hdl::{Block, Module, Width, bit, bundle, def};
/// # bundle! {
/// #     /// The event.
/// #     pub struct CounterIn<T> { pub enable: T }
/// #     /// The number of events.
/// #     pub struct CounterOut<T> { pub count: T }
/// # }
/// # #[derive(Debug, Clone, PartialEq, Eq, Hash)]
/// # struct Counter { width: u32 }
/// # impl Block for Counter {
/// #     type In = CounterIn;
/// #     type Out = CounterOut;
/// #     fn inputs(&self) -> CounterIn<Width> { CounterIn { enable: bit() } }
/// #     fn build(&self, m: Module, i: CounterIn) -> CounterOut {
/// #         def!(count = m.reg(self.width).reset(0));
/// #         count.enable(i.enable).next(count + 1);
/// #         CounterOut { count: *count }
/// #     }
/// # }
/// use tilewright_sim::Batch;
///
/// # fn main() -> Result<(), tilewright_sim::Error> {
/// let mut batch = Batch::of(&Counter { width: 4 }, 16)?;
/// for cycle in 0..10 {
///     // Run 3 counts every third cycle.
///     batch.set_each(batch.i.enable, |run| run > 0 && cycle % run == 0);
///     batch.step();
/// }
/// assert_eq!(batch.get(batch.o.count, 3), 4);
/// let counts = batch.get_each(batch.o.count);
/// assert_eq!(counts[1], 10);
/// # Ok(())
/// # }
/// ```
///
/// Time is common to all runs: they are stepped and reset together. A failing assertion in one run stops all of them,
/// and [`Violation::run`](crate::Violation::run) names the run. A trace, wave or recording is of one run, and is
/// identical to that of a [`Simulation`](crate::Simulation) of that run alone.
pub struct Batch<I: Bundle = (), O: Bundle = ()> {
    /// The input ports.
    pub i: I::Of<Port>,
    /// The output ports.
    pub o: O::Of<Port>,
    all: Simulation<I, O>,
    inputs: Vec<Input>,
}

/// An input as it was set, in all runs.
struct Input {
    limbs: Vec<u64>,
    /// The number of limbs of a run.
    size: usize,
    /// The engine does not have it yet.
    waits: bool,
}

impl Input {
    fn set(&mut self, run: u32, bits: &Bits) {
        let start = run as usize * self.size;
        self.limbs[start..start + self.size].copy_from_slice(bits.limbs());
        self.waits = true;
    }
}

impl Batch {
    /// Elaborates and compiles a block for `runs` runs. Its default clock has a period of 10 ns.
    ///
    /// ```
    /// # use tilewright_sim::{Batch, for_examples::Counter};
    /// let batch = Batch::of(&Counter, 4)?;
    /// # let mut batch = batch;
    /// assert_eq!(batch.runs(), 4);
    /// assert!(Batch::of(&Counter, 0).is_err());
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`Error::Description`] lists every mistake in the description; [`Error::Runs`] if there are no runs or too many.
    #[track_caller]
    pub fn of<B: Block>(block: &B, runs: u32) -> Result<Batch<B::In, B::Out>, Error> {
        Batch::at(block, DEFAULT_PERIOD, runs)
    }

    /// Like [`Batch::of`], with another period of the default clock.
    ///
    /// ```
    /// # use tilewright_sim::{Batch, for_examples::Counter};
    /// use tilewright_hdl::Period;
    ///
    /// let mut batch = Batch::at(&Counter, Period::ns(4), 4)?;
    /// batch.run(10);
    /// assert_eq!(batch.time(), 40_000);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// As [`Batch::of`].
    #[track_caller]
    pub fn at<B: Block>(block: &B, clock: impl Into<DefaultClock>, runs: u32) -> Result<Batch<B::In, B::Out>, Error> {
        let Typed { design, i, o } = typed(block, clock)?;
        Batch::new(&design, runs, i, o)
    }

    /// Compiles a design for `runs` runs; find its ports with [`Batch::port`].
    ///
    /// ```
    /// # use tilewright_sim::{Batch, for_examples::Counter};
    /// let design = tilewright_hdl::elaborate(&Counter)?;
    /// let mut batch = Batch::from_design(&design, 4)?;
    /// let (enable, count) = (batch.port("enable")?, batch.port("count")?);
    /// batch.set(enable, 2, 1);
    /// batch.run(10);
    /// assert_eq!(batch.get_each(count).iter().map(|count| count.to_u64().unwrap()).collect::<Vec<_>>(), [0, 0, 10, 0]);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`Error::Runs`] if there are no runs or too many.
    pub fn from_design(design: &Design, runs: u32) -> Result<Batch, Error> {
        Batch::new(design, runs, (), ())
    }
}

impl<I: Bundle, O: Bundle> Batch<I, O> {
    fn new(design: &Design, runs: u32, i: I::Of<Port>, o: O::Of<Port>) -> Result<Batch<I, O>, Error> {
        let most = program::most_lanes(design);
        if !(1..=most).contains(&runs) {
            return Err(Error::Runs { runs, most });
        }
        let all = Simulation::new(design, runs, same::<I>(&i), same::<O>(&o), &Passes::default())?;
        let inputs = all.circuit.program.inputs.iter().map(|port| {
            let value = all.circuit.program.value(port.value);
            Input { limbs: vec![0; value.range().len()], size: value.limbs(), waits: false }
        });
        Ok(Batch { i, o, inputs: inputs.collect(), all })
    }

    /// The same circuit at time 0, with a seed for each run as in [`Simulation::seeded`](crate::Simulation::seeded).
    /// `seeded(|run| run.into())` starts all runs differently; the first starts from zeros. Inputs become zero.
    ///
    /// ```
    /// # use tilewright_sim::{Batch, for_examples::Counter};
    /// let mut batch = Batch::of(&Counter, 4)?.seeded(|run| run.into());
    /// assert!(batch.peek("late", 0)?.is_zero());
    /// assert_ne!(batch.peek("late", 1)?, batch.peek("late", 2)?);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// Called after the first step, or with a trace attached.
    #[track_caller]
    pub fn seeded(mut self, seed: impl FnMut(u32) -> u64) -> Self {
        self.all.circuit.seed((0..self.runs()).map(seed).collect());
        self.cleared()
    }

    /// The same circuit at time 0 on this engine; inputs become zero.
    ///
    /// ```
    /// # use tilewright_sim::{Batch, EngineKind, for_examples::Counter};
    /// let batch = Batch::of(&Counter, 4)?.on(EngineKind::Reference);
    /// # let mut batch = batch;
    /// assert_eq!(batch.engine(), EngineKind::Reference);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// Called after the first step, or with a trace attached.
    #[track_caller]
    pub fn on(mut self, kind: EngineKind) -> Self {
        self.all = self.all.on(kind);
        self.cleared()
    }

    /// With inputs of zero.
    fn cleared(mut self) -> Self {
        for input in &mut self.inputs {
            input.limbs.fill(0);
            input.waits = false;
        }
        self
    }

    /// The number of runs.
    ///
    /// ```
    /// # use tilewright_sim::{Batch, for_examples::Counter};
    /// let mut batch = Batch::of(&Counter, 4)?;
    /// let last = batch.runs() - 1;
    /// batch.set(batch.i.enable, last, 1);
    /// batch.step();
    /// assert_eq!(batch.get(batch.o.count, last), 1);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn runs(&self) -> u32 {
        self.all.circuit.program.lanes()
    }

    /// The engine that runs; see [`Simulation::engine`](crate::Simulation::engine).
    ///
    /// ```
    /// # use tilewright_sim::{Batch, EngineKind, for_examples::Counter};
    /// let batch = Batch::of(&Counter, 4)?.on(EngineKind::Interpreter);
    /// # let mut batch = batch;
    /// assert_eq!(batch.engine(), EngineKind::Interpreter);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn engine(&self) -> EngineKind {
        self.all.engine()
    }

    /// The compiled circuit: an array of top modules, one for each run.
    ///
    /// ```
    /// # use tilewright_sim::{Batch, for_examples::Counter};
    /// let mut batch = Batch::of(&Counter, 4)?;
    /// assert_eq!(batch.program().clocks.len(), 1); // one for all runs
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn program(&self) -> &Program {
        self.all.program()
    }

    /// The port with this Verilog name or bundle path.
    ///
    /// ```
    /// # use tilewright_sim::{Batch, for_examples::Counter};
    /// let mut batch = Batch::of(&Counter, 4)?;
    /// assert_eq!(batch.port("count")?, batch.o.count);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// There is no such port.
    pub fn port(&self, name: &str) -> Result<Port, UnknownName> {
        self.all.port(name)
    }

    /// All runs, with their inputs as set.
    pub(super) fn ready(&mut self) -> &mut Simulation<I, O> {
        for (index, input) in (0..).zip(&mut self.inputs) {
            if std::mem::take(&mut input.waits) {
                self.all.circuit.write(Port { index }, &input.limbs);
            }
        }
        &mut self.all
    }

    #[track_caller]
    fn check(&self, run: u32) {
        assert!(run < self.runs(), "there is no run {run}: the batch has {}, from 0", self.runs());
    }
}

/// A copy of a bundle of ports.
fn same<T: Bundle>(ports: &T::Of<Port>) -> T::Of<Port> {
    T::convert(ports, &mut |_, port: &Port| *port)
}

impl<I: Bundle, O: Bundle> fmt::Debug for Batch<I, O> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let top = &self.all.circuit.program.hierarchy.scopes[0].name;
        let mut text = f.debug_struct("Batch");
        text.field("top", top).field("runs", &self.runs()).field("time", &self.all.time()).finish_non_exhaustive()
    }
}
