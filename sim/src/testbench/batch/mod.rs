//! Many runs of one circuit side by side.

mod attach;
mod run;

use std::fmt;

use tilewright_hdl::{Bits, Block, Bundle, DEFAULT_PERIOD, Design, Leaf, Period};

use crate::engine::EngineKind;
use crate::engine::Passes;
use crate::engine::program::{self, Program};
use crate::testbench::error::{Error, UnknownName};
use crate::testbench::port::{IntoValue, Port};
use crate::testbench::simulation::{Simulation, Typed, in_step, typed};

/// So many runs of one circuit at a time, each with inputs and a start of its own, as many
/// [`Simulation`](crate::Simulation)s would be, but that they are steps of one program: the compiled engine has the
/// runs beside each other in vectors. A circuit without arrays gains by that from about 4 runs on, in proportion to
/// how many lanes a vector holds; more runs take as much longer as there are more.
///
/// ```
/// # use tilewright_hdl::{Block, Module, Width, bit, bundle};
/// # bundle! {
/// #     /// What is counted.
/// #     pub struct CounterIn<T> { pub enable: T }
/// #     /// How many there were.
/// #     pub struct CounterOut<T> { pub count: T }
/// # }
/// # #[derive(Debug, Clone, PartialEq, Eq, Hash)]
/// # struct Counter { width: u32 }
/// # impl Block for Counter {
/// #     type In = CounterIn;
/// #     type Out = CounterOut;
/// #     fn inputs(&self) -> CounterIn<Width> { CounterIn { enable: bit() } }
/// #     fn build(&self, m: Module, i: CounterIn) -> CounterOut {
/// #         let count = m.reg("count", self.width).reset(0);
/// #         count.enable(i.enable).next(count + 1);
/// #         CounterOut { count: count.value() }
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
/// Time is the same for all runs: they are stepped and reset together. An assertion that fails in one of them stops all,
/// and [`Violation::run`](crate::Violation::run) says which; the others cannot go on without it. A trace, a wave or a
/// recording is of one run, and is what a [`Simulation`](crate::Simulation) of that run alone would give.
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
    /// How many limbs a run has.
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
    /// Elaborates and compiles a block for so many runs; its default clock has a period of 10 ns.
    ///
    /// # Errors
    ///
    /// [`Error::Description`] lists every mistake in the description; [`Error::Runs`] if there are no runs or too many.
    #[track_caller]
    pub fn of<B: Block>(block: &B, runs: u32) -> Result<Batch<B::In, B::Out>, Error> {
        Batch::at(block, DEFAULT_PERIOD, runs)
    }

    /// As [`Batch::of`], with another period of the default clock.
    ///
    /// # Errors
    ///
    /// As [`Batch::of`].
    #[track_caller]
    pub fn at<B: Block>(block: &B, period: Period, runs: u32) -> Result<Batch<B::In, B::Out>, Error> {
        let Typed { design, i, o } = typed(block, period)?;
        Batch::new(&design, runs, i, o)
    }

    /// Compiles a design for so many runs; ports are found by [`Batch::port`].
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

    /// The same circuit at time 0, with a seed for each run as in [`Simulation::seeded`](crate::Simulation::seeded):
    /// `seeded(|run| run.into())` starts all of them differently, but the first from zeros. Inputs become zero.
    ///
    /// # Panics
    ///
    /// After the first step, or with a trace attached.
    #[track_caller]
    pub fn seeded(mut self, seed: impl FnMut(u32) -> u64) -> Self {
        self.all.circuit.seed((0..self.runs()).map(seed).collect());
        self.cleared()
    }

    /// The same circuit at time 0 on this engine; inputs become zero.
    ///
    /// # Panics
    ///
    /// After the first step, or with a trace attached.
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

    /// How many runs there are.
    pub fn runs(&self) -> u32 {
        self.all.circuit.program.lanes()
    }

    /// The engine that runs; see [`Simulation::engine`](crate::Simulation::engine).
    pub fn engine(&self) -> EngineKind {
        self.all.engine()
    }

    /// The compiled circuit: the array of as many top modules as there are runs.
    pub fn program(&self) -> &Program {
        self.all.program()
    }

    /// The port of that Verilog name or bundle path.
    ///
    /// # Errors
    ///
    /// There is none.
    pub fn port(&self, name: &str) -> Result<Port, UnknownName> {
        self.all.port(name)
    }

    /// Sets an input of one run from now on; nothing happens before the next step.
    ///
    /// # Panics
    ///
    /// The value does not fit, the port is an output, or there is no such run.
    #[track_caller]
    pub fn set(&mut self, port: Port, run: u32, value: impl IntoValue) {
        self.check(run);
        let bits = self.all.circuit.fitting(port, value);
        self.inputs[port.index as usize].set(run, &bits);
    }

    /// Sets an input of every run, to what `value` says for it.
    ///
    /// # Panics
    ///
    /// As [`Batch::set`].
    #[track_caller]
    pub fn set_each<V: IntoValue>(&mut self, port: Port, mut value: impl FnMut(u32) -> V) {
        for run in 0..self.runs() {
            self.set(port, run, value(run));
        }
    }

    /// Sets an input of all runs alike.
    ///
    /// # Panics
    ///
    /// As [`Batch::set`].
    #[track_caller]
    pub fn set_all(&mut self, port: Port, value: impl IntoValue) {
        let bits = self.all.circuit.fitting(port, value);
        let input = &mut self.inputs[port.index as usize];
        input.limbs.chunks_exact_mut(input.size).for_each(|run| run.copy_from_slice(bits.limbs()));
        input.waits = true;
    }

    /// Sets a list of inputs of one run; see [`Simulation::set_list`](crate::Simulation::set_list).
    ///
    /// # Panics
    ///
    /// There are more or fewer values than inputs; or as [`Batch::set`].
    #[track_caller]
    pub fn set_list<V: IntoValue>(
        &mut self,
        run: u32,
        list: impl FnOnce(&I::Of<Port>) -> &[Port],
        values: impl IntoIterator<Item = V>,
    ) {
        self.check(run);
        let (all, inputs) = (&self.all, &mut self.inputs);
        in_step(list(&self.i), values, |port, value| {
            inputs[port.index as usize].set(run, &all.circuit.fitting(port, value));
        });
    }

    /// The values of a list of outputs in one run; see [`Simulation::get_list`](crate::Simulation::get_list).
    ///
    /// # Panics
    ///
    /// One of them is wider than 64 bits, or there is no such run.
    #[track_caller]
    pub fn get_list(&mut self, run: u32, list: impl FnOnce(&O::Of<Port>) -> &[Port]) -> Vec<u64> {
        self.check(run);
        let all = self.ready();
        list(&all.o).iter().map(|port| all.circuit.narrow(*port, run)).collect()
    }

    /// Sets every input of one run; [`Batch::drive_bits`] takes values wider than 64 bits.
    ///
    /// # Panics
    ///
    /// As [`Batch::set`].
    #[track_caller]
    pub fn drive(&mut self, run: u32, values: I::Of<u64>) {
        self.drive_run(run, &values);
    }

    /// Sets every input of one run.
    ///
    /// # Panics
    ///
    /// As [`Batch::set`].
    #[track_caller]
    pub fn drive_bits(&mut self, run: u32, values: I::Of<Bits>) {
        self.drive_run(run, &values);
    }

    #[track_caller]
    fn drive_run<V: IntoValue + Leaf>(&mut self, run: u32, values: &I::Of<V>) {
        self.check(run);
        let (all, inputs) = (&self.all, &mut self.inputs);
        all.inputs.pair::<I, V>(&self.i, values, |port, value| {
            inputs[port.index as usize].set(run, &all.circuit.fitting(port, value.clone()));
        });
    }

    /// The value of a port in one run, settled.
    ///
    /// # Panics
    ///
    /// There is no such run.
    #[track_caller]
    pub fn get(&mut self, port: Port, run: u32) -> Bits {
        self.check(run);
        self.ready().circuit.get(port, run)
    }

    /// The value of a port in every run, settled.
    #[track_caller]
    pub fn get_each(&mut self, port: Port) -> Vec<Bits> {
        let id = self.all.circuit.declared(port).value;
        let value = self.all.circuit.program.value(id);
        let limbs = self.ready().circuit.engine.read(id);
        limbs.chunks_exact(value.limbs()).map(|run| Bits::from_limbs(value.width, run)).collect()
    }

    /// Every output of one run, settled.
    ///
    /// # Panics
    ///
    /// There is no such run.
    #[track_caller]
    pub fn read(&mut self, run: u32) -> O::Of<Bits> {
        self.check(run);
        self.ready().read_run(run)
    }

    /// Every output of one run as a number, settled; see [`Simulation::read_u64`](crate::Simulation::read_u64).
    ///
    /// # Panics
    ///
    /// An output is wider than 64 bits and does not fit, or there is no such run.
    #[track_caller]
    pub fn read_u64(&mut self, run: u32) -> O::Of<u64> {
        self.check(run);
        self.ready().read_run_u64(run)
    }

    /// The value of anything with a name in one run, settled; see [`Simulation::peek`](crate::Simulation::peek).
    ///
    /// # Errors
    ///
    /// There is no such name; the error has the nearest one.
    ///
    /// # Panics
    ///
    /// There is no such run.
    #[track_caller]
    pub fn peek(&mut self, path: &str, run: u32) -> Result<Bits, UnknownName> {
        self.check(run);
        self.ready().circuit.peek(path, run)
    }

    /// A word of a memory in one run.
    ///
    /// # Errors
    ///
    /// There is no such memory.
    ///
    /// # Panics
    ///
    /// The address is beyond its depth, or there is no such run.
    #[track_caller]
    pub fn peek_memory(&self, path: &str, run: u32, address: u32) -> Result<Bits, UnknownName> {
        self.check(run);
        self.all.circuit.peek_word(path, run, address)
    }

    /// Replaces a word of a memory in one run at once.
    ///
    /// # Errors
    ///
    /// There is no such memory.
    ///
    /// # Panics
    ///
    /// As [`Simulation::poke_memory`](crate::Simulation::poke_memory), or there is no such run.
    #[track_caller]
    pub fn poke_memory(
        &mut self,
        path: &str,
        run: u32,
        address: u32,
        value: impl IntoValue,
    ) -> Result<(), UnknownName> {
        self.check(run);
        self.all.circuit.poke_word(path, run, address, value)
    }

    /// All runs, with their inputs as they were set.
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
