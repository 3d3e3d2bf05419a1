//! A running circuit and its testbench interface.

use std::fmt;

use tilewright_hdl::{Bits, Block, Bundle, DEFAULT_PERIOD, Design, Leaf, Period, elaborate_typed};

use crate::engine::program::Program;
use crate::engine::{EngineKind, Passes};
use crate::testbench::error::{Error, UnknownName};
use crate::testbench::port::{IntoValue, Port};
use crate::testbench::port_order::PortOrder;
use crate::testbench::running::Running;

/// A running circuit.
///
/// `I` and `O` are the block's input and output bundles; a simulation made by [`Simulation::from_design`] has none and
/// finds its ports by name.
///
/// ```
/// # use tilewright_sim::{Simulation, for_examples::Counter};
/// let mut sim = Simulation::of(&Counter)?;
/// sim.set(sim.i.enable, 1);
/// sim.run(5);
/// assert_eq!((sim.get_u64(sim.o.count), sim.get_u64(sim.o.square)), (5, 25));
/// # Ok::<(), tilewright_sim::Error>(())
/// ```
pub struct Simulation<I: Bundle = (), O: Bundle = ()> {
    /// The input ports.
    pub i: I::Of<Port>,
    /// The output ports.
    pub o: O::Of<Port>,
    pub(crate) circuit: Running,
    pub(crate) inputs: PortOrder,
}

impl Simulation {
    /// Elaborates and compiles a block; its default clock has a period of 10 ns.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// sim.step();
    /// assert_eq!(sim.time(), 10_000);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`Error::Description`] lists every mistake in the description.
    #[track_caller]
    pub fn of<B: Block>(block: &B) -> Result<Simulation<B::In, B::Out>, Error> {
        Simulation::at(block, DEFAULT_PERIOD)
    }

    /// As [`Simulation::of`], with another period of the default clock.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// use tilewright_hdl::Period;
    ///
    /// let mut sim = Simulation::at(&Counter, Period::ns(4))?;
    /// sim.step();
    /// assert_eq!(sim.time(), 4_000);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`Error::Description`] lists every mistake in the description.
    #[track_caller]
    pub fn at<B: Block>(block: &B, period: Period) -> Result<Simulation<B::In, B::Out>, Error> {
        let Typed { design, i, o } = typed(block, period)?;
        Simulation::new(&design, 1, i, o, &Passes::default())
    }

    /// Compiles a design; ports are found by [`Simulation::port`].
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let design = tilewright_hdl::elaborate(&Counter)?;
    /// let mut sim = Simulation::from_design(&design)?;
    /// let (enable, count) = (sim.port("enable")?, sim.port("count")?);
    /// sim.set(enable, 1);
    /// sim.run(5);
    /// assert_eq!(sim.get(count), 5);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// None at present: every [`Design`] can be compiled.
    pub fn from_design(design: &Design) -> Result<Simulation, Error> {
        Simulation::with_passes(design, &Passes::default())
    }

    /// As [`Simulation::from_design`], with some optimisation passes only.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// use tilewright_sim::Passes;
    ///
    /// let design = tilewright_hdl::elaborate(&Counter)?;
    /// let mut sim = Simulation::with_passes(&design, &Passes::default())?;
    /// sim.run(5); // as `Simulation::from_design`
    /// assert_eq!(sim.peek("count")?, 0);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// As [`Simulation::from_design`].
    pub fn with_passes(design: &Design, passes: &Passes) -> Result<Simulation, Error> {
        Simulation::new(design, 1, (), (), passes)
    }
}

impl<I: Bundle, O: Bundle> Simulation<I, O> {
    /// So many runs of a design.
    pub(crate) fn new(
        design: &Design,
        runs: u32,
        i: I::Of<Port>,
        o: O::Of<Port>,
        passes: &Passes,
    ) -> Result<Simulation<I, O>, Error> {
        #[cfg(feature = "mutation")]
        let design = &tilewright_mutants::from_environment(design);
        let inputs = PortOrder::of::<I>(&i);
        Ok(Simulation { i, o, circuit: Running::new(design, runs, passes), inputs })
    }

    /// The same circuit at time 0, with registers that a reset does not set and memories of unknown contents filled
    /// from `seed`, deterministically; 0 means zeros, as does not calling this. Inputs become zero.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?.seeded(7);
    /// let start = sim.peek("late")?; // it has no reset
    /// assert_eq!(start, Simulation::of(&Counter)?.seeded(7).peek("late")?);
    /// assert_ne!(start, Simulation::of(&Counter)?.seeded(8).peek("late")?);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// After the first step, or with a trace attached.
    #[track_caller]
    pub fn seeded(mut self, seed: u64) -> Self {
        self.circuit.seed(vec![seed]);
        self
    }

    /// The same circuit at time 0 on this engine; inputs become zero. Where no code can be generated for this machine, it
    /// is the interpreter if that needs code: [`Simulation::engine`] tells, and [`Simulation::fallback`] why.
    ///
    /// ```
    /// # use tilewright_sim::{EngineKind, Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?.on(EngineKind::Reference);
    /// sim.set(sim.i.enable, 1);
    /// sim.run(5);
    /// assert_eq!(sim.get(sim.o.square), 25); // as on any other
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// After the first step, or with a trace attached.
    #[track_caller]
    pub fn on(mut self, kind: EngineKind) -> Self {
        self.circuit.put_on(kind);
        self
    }

    /// As on a machine that no code can be generated for, for that reason.
    #[doc(hidden)]
    pub fn without_code(mut self, reason: &str) -> Self {
        self.circuit.restart(self.circuit.engine.refuse(reason));
        self
    }

    /// The engine that runs: the one chosen, or the interpreter where no code can be generated for this machine.
    ///
    /// ```
    /// # use tilewright_sim::{EngineKind, Simulation, for_examples::Counter};
    /// let sim = Simulation::of(&Counter)?.on(EngineKind::Interpreter);
    /// # let mut sim = sim;
    /// assert_eq!(sim.engine(), EngineKind::Interpreter);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn engine(&self) -> EngineKind {
        self.circuit.engine.kind()
    }

    /// Why the interpreter runs although another one was chosen; nothing if the chosen one runs.
    ///
    /// ```
    /// # use tilewright_sim::{EngineKind, Simulation, for_examples::Counter};
    /// let sim = Simulation::of(&Counter)?;
    /// # let mut sim = sim;
    /// // A reason is there exactly if the engine is another than the one that was chosen.
    /// assert_eq!(sim.fallback().is_some(), sim.engine() != EngineKind::Compiled);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn fallback(&self) -> Option<&str> {
        self.circuit.engine.fallback()
    }

    /// The compiled circuit.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// let clocks = sim.program().clocks.iter().map(|clock| clock.period).collect::<Vec<_>>();
    /// assert_eq!(clocks, [10_000]);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn program(&self) -> &Program {
        &self.circuit.program
    }

    /// The port of that Verilog name or bundle path.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// assert_eq!(sim.port("count")?, sim.o.count);
    /// assert!(sim.port("late").is_err()); // a register inside is no port: `peek` finds it
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// There is none.
    pub fn port(&self, name: &str) -> Result<Port, UnknownName> {
        self.circuit.port(name)
    }

    /// Sets an input from now on. Several inputs may be set in any order; nothing happens before the next step.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// sim.set(sim.i.enable, true);
    /// sim.step();
    /// sim.set(sim.i.enable, 0);
    /// sim.run(5);
    /// assert_eq!(sim.get(sim.o.count), 1);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// The value does not fit, or the port is an output.
    #[track_caller]
    #[inline]
    pub fn set(&mut self, port: Port, value: impl IntoValue) {
        self.circuit.set(port, value);
    }

    /// Sets a list of inputs, one of the fields of the bundle, each to the value at its place.
    ///
    /// ```
    /// # use tilewright_hdl::{Block, Module, Width, bits, bundle};
    /// # bundle! {
    /// #     /// What is multiplied.
    /// #     pub struct DotIn<T> { pub left: Vec<T>, pub right: Vec<T> }
    /// #     /// The products.
    /// #     pub struct DotOut<T> { pub products: Vec<T> }
    /// # }
    /// # #[derive(Debug, Clone, PartialEq, Eq, Hash)]
    /// # struct Dot;
    /// # impl Block for Dot {
    /// #     type In = DotIn;
    /// #     type Out = DotOut;
    /// #     fn inputs(&self) -> DotIn<Width> { DotIn { left: vec![bits(8); 3], right: vec![bits(8); 3] } }
    /// #     fn build(&self, _: Module, i: DotIn) -> DotOut {
    /// #         DotOut { products: i.left.iter().zip(&i.right).map(|(left, right)| left.times(*right)).collect() }
    /// #     }
    /// # }
    /// # let mut sim = tilewright_sim::Simulation::of(&Dot)?;
    /// sim.set_list(|i| &i.left, [1, 2, 3]);
    /// sim.set_list(|i| &i.right, [10, 10, 5]);
    /// assert_eq!(sim.get_list(|o| &o.products), [10, 20, 15]);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// There are more or fewer values than inputs; or as [`Simulation::set`].
    #[track_caller]
    pub fn set_list<V: IntoValue>(
        &mut self,
        list: impl FnOnce(&I::Of<Port>) -> &[Port],
        values: impl IntoIterator<Item = V>,
    ) {
        let circuit = &mut self.circuit;
        in_step(list(&self.i), values, |port, value| circuit.set(port, value));
    }

    /// The values of a list of outputs, one of the fields of the bundle, settled, as numbers.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Products};
    /// let mut sim = Simulation::of(&Products)?;
    /// sim.set_list(|i| &i.left, [1, 2, 3]);
    /// sim.set_list(|i| &i.right, [200; 3]);
    /// assert_eq!(sim.get_list(|o| &o.products), [200, 400, 600]);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// One of them is wider than 64 bits.
    #[track_caller]
    pub fn get_list(&mut self, list: impl FnOnce(&O::Of<Port>) -> &[Port]) -> Vec<u64> {
        let circuit = &mut self.circuit;
        list(&self.o).iter().map(|port| circuit.narrow(*port, 0)).collect()
    }

    /// Sets an input that has lanes, a value for each; a grid row by row.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Products};
    /// let mut sim = Simulation::of(&Products)?;
    /// sim.set_lanes(sim.i.lanes, [1, 2, 3, 200]);
    /// assert_eq!(sim.lanes(sim.o.squares), [1, 4, 9, 40_000]);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// There are more or fewer values than lanes; or as [`Simulation::set`].
    #[track_caller]
    pub fn set_lanes<V: IntoValue>(&mut self, port: Port, values: impl IntoIterator<Item = V>) {
        self.circuit.set_lanes(port, values);
    }

    /// The lanes of a port, settled, as numbers; a grid row by row. A plain port has one.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Products};
    /// let mut sim = Simulation::of(&Products)?;
    /// sim.set(sim.i.lanes, 0x04_03_02_01);
    /// assert_eq!(sim.lanes(sim.i.lanes), [1, 2, 3, 4]); // lane 0 is in the lowest bits
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// They are wider than 64 bits.
    #[track_caller]
    pub fn lanes(&mut self, port: Port) -> Vec<u64> {
        self.circuit.lanes(port)
    }

    /// The value of a port, settled: an output as it follows from the state and the inputs of this moment.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// sim.set(sim.i.enable, 1);
    /// sim.run(5);
    /// assert_eq!(sim.get(sim.o.count).to_string(), "8'h05");
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    #[track_caller]
    #[inline]
    pub fn get(&mut self, port: Port) -> Bits {
        self.circuit.get(port, 0)
    }

    /// As [`Simulation::get`], for a port of up to 64 bits.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// sim.set(sim.i.enable, 1);
    /// sim.run(5);
    /// assert_eq!(sim.get_u64(sim.o.count) * 3, 15);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// The port is wider.
    #[track_caller]
    #[inline]
    pub fn get_u64(&mut self, port: Port) -> u64 {
        self.circuit.narrow(port, 0)
    }

    /// Sets every input of the input bundle; [`Simulation::drive_bits`] takes values wider than 64 bits. The `ready` of a stream in it is an
    /// output, and its value means nothing here.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// # use tilewright_sim::for_examples::CounterIn;
    /// let mut sim = Simulation::of(&Counter)?;
    /// sim.drive(CounterIn { enable: 1 });
    /// sim.run(5);
    /// assert_eq!(sim.get(sim.o.count), 5);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// A value does not fit, or a list is not as long as the block's.
    #[track_caller]
    pub fn drive(&mut self, values: I::Of<u64>) {
        self.drive_each(&values);
    }

    /// Sets every input.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// # use tilewright_hdl::Bits;
    /// # use tilewright_sim::for_examples::CounterIn;
    /// let mut sim = Simulation::of(&Counter)?;
    /// sim.drive_bits(CounterIn { enable: Bits::ones(1) });
    /// sim.run(5);
    /// assert_eq!(sim.get(sim.o.count), 5);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// A value has another width than its port, or a list is not as long as the block's.
    #[track_caller]
    pub fn drive_bits(&mut self, values: I::Of<Bits>) {
        self.drive_each(&values);
    }

    #[track_caller]
    fn drive_each<V: IntoValue + Leaf>(&mut self, values: &I::Of<V>) {
        let circuit = &mut self.circuit;
        self.inputs.pair::<I, V>(&self.i, values, |port, value| circuit.set(port, value.clone()));
    }

    /// Every output, settled.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// sim.set(sim.i.enable, 1);
    /// sim.run(5);
    /// let outputs = sim.read();
    /// assert_eq!((outputs.count.width(), outputs.square.to_u64()), (8, Some(25)));
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn read(&mut self) -> O::Of<Bits> {
        self.read_run(0)
    }

    pub(crate) fn read_run(&mut self, run: u32) -> O::Of<Bits> {
        let circuit = &mut self.circuit;
        O::convert_leaves(&self.o, &mut |port: &Port| circuit.get(*port, run))
    }

    /// Every output as a number, settled; easy to compare with an expected bundle.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// # use tilewright_sim::for_examples::CounterOut;
    /// let mut sim = Simulation::of(&Counter)?;
    /// sim.set(sim.i.enable, 1);
    /// sim.run(5);
    /// assert_eq!(sim.read_u64(), CounterOut { count: 5, square: 25 });
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// An output is wider than 64 bits and does not fit.
    #[track_caller]
    pub fn read_u64(&mut self) -> O::Of<u64> {
        self.read_run_u64(0)
    }

    #[track_caller]
    pub(crate) fn read_run_u64(&mut self, run: u32) -> O::Of<u64> {
        let circuit = &mut self.circuit;
        O::convert_leaves(&self.o, &mut |port: &Port| circuit.number(*port, run))
    }

    /// Drives one bundle of inputs after another, an instant each, and gives the outputs settled before each edge.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// # use tilewright_sim::for_examples::CounterIn;
    /// let mut sim = Simulation::of(&Counter)?;
    /// let outputs = sim.stream([1, 1, 0, 1].map(|enable| CounterIn { enable }));
    /// assert_eq!(outputs.iter().map(|output| output.count).collect::<Vec<_>>(), [0, 1, 2, 2]);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// As [`Simulation::drive`], [`Simulation::read_u64`] and [`Simulation::step`].
    #[track_caller]
    pub fn stream(&mut self, inputs: impl IntoIterator<Item = I::Of<u64>>) -> Vec<O::Of<u64>> {
        let mut outputs = Vec::new();
        for bundle in inputs {
            self.drive(bundle);
            outputs.push(self.read_u64());
            self.step();
        }
        outputs
    }
}

/// Calls `set` with each port of a list and its value.
#[track_caller]
pub(crate) fn in_step<V>(ports: &[Port], values: impl IntoIterator<Item = V>, mut set: impl FnMut(Port, V)) {
    let (mut values, mut count) = (values.into_iter(), 0);
    for (port, value) in ports.iter().zip(&mut values) {
        set(*port, value);
        count += 1;
    }
    // What is left is only counted.
    let (has, needs) = (count + usize::from(count == ports.len()) * values.count(), ports.len());
    assert!(has == needs, "a list of {needs} inputs is set to a list of {has}: give each input one value");
}

/// A block's design and ports.
pub(crate) struct Typed<B: Block> {
    pub design: Design,
    pub i: <B::In as Bundle>::Of<Port>,
    pub o: <B::Out as Bundle>::Of<Port>,
}

/// Elaborates a block.
#[track_caller]
pub(crate) fn typed<B: Block>(block: &B, period: Period) -> Result<Typed<B>, Error> {
    let (design, inputs, outputs) = elaborate_typed(block, period)?;
    let port = |index: &usize| Port { index: *index as u32 };
    let i = B::In::convert(&inputs, &mut |_, index: &usize| port(index));
    let o = B::Out::convert(&outputs, &mut |_, index: &usize| port(index));
    Ok(Typed { design, i, o })
}

impl<I: Bundle, O: Bundle> fmt::Debug for Simulation<I, O> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let top = &self.circuit.program.hierarchy.scopes[0].name;
        f.debug_struct("Simulation")
            .field("top", top)
            .field("time", &self.circuit.timeline.time)
            .finish_non_exhaustive()
    }
}
