//! A running circuit and its testbench interface.

use std::fmt;

use tilewright_circuit::{DefaultClock, Design};
use tilewright_hdl::{Block, Bundle, DEFAULT_PERIOD, elaborate_typed};

use crate::engine::program::Program;
use crate::engine::{EngineKind, Passes};
use crate::testbench::error::{Error, UnknownName};
use crate::testbench::port::Port;
use crate::testbench::port_order::PortOrder;
use crate::testbench::running::Running;

/// A running circuit.
///
/// `I` and `O` are the block's input and output bundles. A simulation made by [`Simulation::from_design`] has none;
/// find its ports by name.
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
    /// Elaborates and compiles a block. Its default clock has a period of 10 ns.
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

    /// Like [`Simulation::of`], with another period of the default clock, or with another [`DefaultClock`].
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
    pub fn at<B: Block>(block: &B, clock: impl Into<DefaultClock>) -> Result<Simulation<B::In, B::Out>, Error> {
        let Typed { design, i, o } = typed(block, clock)?;
        Simulation::new(&design, 1, i, o, &Passes::default())
    }

    /// Compiles a design; find its ports with [`Simulation::port`].
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
    /// [`Error::Description`] if a foreign module has no model.
    pub fn from_design(design: &Design) -> Result<Simulation, Error> {
        Simulation::new(design, 1, (), (), &Passes::default())
    }

    /// Like [`Simulation::from_design`], with the given optimisation passes only, and in machine code at once.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// use tilewright_sim::Passes;
    ///
    /// let design = tilewright_hdl::elaborate(&Counter)?;
    /// let mut sim = Simulation::with_passes(&design, &Passes::default())?;
    /// sim.run(5); // the same as with `Simulation::from_design`
    /// assert_eq!(sim.peek("count")?, 0);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// As [`Simulation::from_design`].
    pub fn with_passes(design: &Design, passes: &Passes) -> Result<Simulation, Error> {
        Ok(Simulation::new(design, 1, (), (), passes)?.on(EngineKind::Compiled))
    }
}

impl<I: Bundle, O: Bundle> Simulation<I, O> {
    /// `runs` runs of a design.
    pub(crate) fn new(
        design: &Design,
        runs: u32,
        i: I::Of<Port>,
        o: O::Of<Port>,
        passes: &Passes,
    ) -> Result<Simulation<I, O>, Error> {
        design.check_models()?;
        #[cfg(feature = "mutation")]
        let design = &tilewright_mutants::from_environment(design);
        let inputs = PortOrder::of::<I>(&i);
        Ok(Simulation { i, o, circuit: Running::new(design, runs, passes), inputs })
    }

    /// Another simulation of the circuit, at time 0, on the same engine and with the same seed. It does not elaborate
    /// the block again.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut first = Simulation::of(&Counter)?;
    /// first.set(first.i.enable, 1);
    /// first.run(5);
    /// let mut second = first.another();
    /// second.set(second.i.enable, 1);
    /// second.run(2);
    /// assert_eq!((first.get_u64(first.o.count), second.get_u64(second.o.count)), (5, 2));
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn another(&self) -> Self {
        let (i, o, inputs) = (self.i.clone(), self.o.clone(), self.inputs.clone());
        Simulation { i, o, circuit: self.circuit.another(), inputs }
    }

    /// The same circuit at time 0, with a seed that determines the start of registers without a reset and of memories
    /// with unknown contents. A seed of 0 means zeros, which is also the default. Inputs become zero.
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
    /// Called after the first step, or with a trace attached.
    #[track_caller]
    pub fn seeded(mut self, seed: u64) -> Self {
        self.circuit.seed(vec![seed]);
        self
    }

    /// The same circuit at time 0 on this engine; inputs become zero. If the engine generates code and cannot do so
    /// for this machine, the interpreter runs instead: [`Simulation::engine`] tells, and [`Simulation::fallback`]
    /// says why.
    ///
    /// ```
    /// # use tilewright_sim::{EngineKind, Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?.on(EngineKind::Reference);
    /// sim.set(sim.i.enable, 1);
    /// sim.run(5);
    /// assert_eq!(sim.get(sim.o.square), 25); // the same as on any other
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// Called after the first step, or with a trace attached.
    #[track_caller]
    pub fn on(mut self, kind: EngineKind) -> Self {
        self.circuit.put_on(kind);
        self
    }

    /// The number of edges at which instances that run one by one had nothing to do and were skipped, summed over all
    /// instances ([`Passes::apart_from`] says which they are). With several clocks it is the number of clock edges
    /// that were skipped ([`Passes::idle_from`]). It is 0 on engines that skip nothing.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_sim::Passes;
    /// block! {
    ///     /// Counts while it is enabled.
    ///     struct Node;
    ///     in NodeIn { is_busy: bit() }
    ///     out NodeOut { count: bits(8) }
    /// }
    ///
    /// impl Node {
    ///     fn build(&self, m: Module, i: NodeIn) -> NodeOut {
    ///         def!(count = m.reg(8).reset(0));
    ///         count.when(i.is_busy, count + 1);
    ///         NodeOut { count: *count }
    ///     }
    /// }
    ///
    /// block! {
    ///     /// Four counters, the last of which is busy.
    ///     struct Nodes;
    ///     out NodesOut { all: bits(32) }
    /// }
    ///
    /// impl Nodes {
    ///     fn build(&self, m: Module, (): ()) -> NodesOut {
    ///         def!(number = m.reg(2).reset(3));
    ///         number.next(*number);
    ///         let numbers = constants(bits(2).of(4), u64::from);
    ///         let nodes = m.array("u_node", 4, &Node, |_| NodeIn { is_busy: numbers.eq(*number) });
    ///         NodesOut { all: nodes.count.pack() }
    ///     }
    /// }
    ///
    /// let passes = Passes { apart_from: 1, apart_single: 0, ..Passes::default() };
    /// let mut sim = tilewright_sim::Simulation::with_passes(&elaborate(&Nodes)?, &passes)?;
    /// sim.run(100);
    /// assert_eq!(sim.peek("all")?, 100 << 24);
    /// assert!((250..300).contains(&sim.left_out()) || sim.engine() == tilewright_sim::EngineKind::Interpreter);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn left_out(&self) -> u64 {
        self.circuit.engine.left_out()
    }

    /// The number of specialised versions of lane loops so far. Each version is for frequent values of the scalars
    /// that select the operation of all lanes, as an instruction does (`sim/docs/engine.md`). It is 0 on an engine
    /// that generates no code.
    ///
    /// ```
    /// use tilewright_hdl::{Module, bits, block, case, def, elaborate, row};
    ///
    /// block! {
    ///     /// Sums that add one of two numbers, or nothing.
    ///     struct Sums;
    ///     in SumsIn { op: bits(2), other: bits(1), x: bits(8), y: bits(8) }
    ///     out SumsOut { last: bits(8) }
    /// }
    ///
    /// impl Sums {
    ///     fn build(&self, m: Module, i: SumsIn) -> SumsOut {
    ///         def!(sum = m.reg(bits(8).of(row(4096))).reset(0));
    ///         let number = case(i.other, [(0, i.x)], i.y).of(row(4096)) ^ sum.previous(i.x);
    ///         sum.next(case(i.op, [(1, *sum + number), (2, *sum ^ number)], *sum));
    ///         SumsOut { last: sum.lane(4095) }
    ///     }
    /// }
    ///
    /// let mut sim = tilewright_sim::Simulation::of(&Sums)?;
    /// sim.set(sim.i.op, 1);
    /// sim.run(1000);
    /// println!("{} versions", sim.versions());
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn versions(&self) -> u64 {
        self.circuit.engine.versions()
    }

    /// Acts as on a machine for which no code can be generated, for the given reason.
    #[doc(hidden)]
    pub fn without_code(mut self, reason: &str) -> Self {
        self.circuit.restart(self.circuit.engine.refuse(reason));
        self
    }

    /// The same circuit at time 0, on an engine of two tiers of which the second one begins after this number of edges.
    #[doc(hidden)]
    pub fn code_after(mut self, edges: u64) -> Self {
        self.circuit.restart(self.circuit.engine.code_after(edges));
        self
    }

    /// The engine that runs: the chosen one, or the interpreter if no code can be generated for this machine.
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

    /// Why the interpreter runs although another engine was chosen; `None` if the chosen one runs.
    ///
    /// ```
    /// # use tilewright_sim::{EngineKind, Simulation, for_examples::Counter};
    /// let sim = Simulation::of(&Counter)?;
    /// # let mut sim = sim;
    /// // There is a reason exactly if the engine is not the chosen one.
    /// assert_eq!(sim.fallback().is_some(), sim.engine() != EngineKind::default());
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

    /// The port with this Verilog name or bundle path.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// assert_eq!(sim.port("count")?, sim.o.count);
    /// assert!(sim.port("late").is_err()); // a register inside is not a port: use `peek`
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// There is no such port.
    pub fn port(&self, name: &str) -> Result<Port, UnknownName> {
        self.circuit.port(name)
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
    // The remaining values are only counted.
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
pub(crate) fn typed<B: Block>(block: &B, clock: impl Into<DefaultClock>) -> Result<Typed<B>, Error> {
    let (design, inputs, outputs) = elaborate_typed(block, clock)?;
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
            .field("time", &self.circuit.timeline.time())
            .finish_non_exhaustive()
    }
}
