//! A running circuit and its testbench interface.

use std::fmt;
use std::sync::Arc;

use tilewright_hdl::{Bits, Block, Bundle, DEFAULT_PERIOD, Design, Fields, Leaf, Period, elaborate_typed, uneven};

use crate::engine::Passes;
use crate::engine::lane;
use crate::engine::program::{self, Program, Triggers};
use crate::engine::{EngineKind, Started};
use crate::testbench::error::{Error, UnknownName};
use crate::testbench::port::{IntoValue, Port};
use crate::testbench::timeline::Timeline;
use crate::testbench::trace::{Observer, Poked};

/// A running circuit.
///
/// `I` and `O` are the block's input and output bundles; a simulation made by [`Simulation::from_design`] has none and
/// finds its ports by name.
pub struct Simulation<I: Bundle = (), O: Bundle = ()> {
    /// The input ports.
    pub i: I::Of<Port>,
    /// The output ports.
    pub o: O::Of<Port>,
    pub(crate) program: Arc<Program>,
    pub(crate) engine: Started,
    pub(crate) timeline: Timeline,
    pub(crate) resets: Vec<bool>,
    pub(crate) observers: Vec<Box<dyn Observer + Send>>,
    /// The words that were replaced before the first step, of which recordings tell.
    pub(crate) poked: Poked,
    /// The runs that are recorded: from the first step on, a recording has to explain everything.
    pub(crate) recorded: Vec<u32>,
    /// What may have changed since the observers last saw it.
    pub(crate) changed: Triggers,
    /// The clocks of the coming instant; kept to save an allocation.
    pub(crate) rising: Vec<usize>,
}

impl Simulation {
    /// Elaborates and compiles a block; its default clock has a period of 10 ns.
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
    /// # Errors
    ///
    /// None at present: every [`Design`] can be compiled.
    pub fn from_design(design: &Design) -> Result<Simulation, Error> {
        Simulation::with_passes(design, &Passes::default())
    }

    /// As [`Simulation::from_design`], with some optimisation passes only.
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
        let program = Arc::new(program::compile_lanes(design, runs, passes));
        let engine = Started::new(program.clone(), EngineKind::default(), vec![0; runs as usize]);
        Ok(Simulation {
            i,
            o,
            engine,
            timeline: Timeline::new(&program),
            resets: vec![false; program.clocks.len()],
            observers: Vec::new(),
            poked: Poked::default(),
            recorded: Vec::new(),
            changed: Triggers::NONE,
            rising: Vec::new(),
            program,
        })
    }

    /// The same circuit at time 0, with registers that a reset does not set and memories of unknown contents filled
    /// from `seed`, deterministically; 0 means zeros, as does not calling this. Inputs become zero.
    ///
    /// # Panics
    ///
    /// After the first step, or with a trace attached.
    #[track_caller]
    pub fn seeded(mut self, seed: u64) -> Self {
        self.seed(vec![seed]);
        self
    }

    #[track_caller]
    pub(crate) fn seed(&mut self, seeds: Vec<u64>) {
        assert!(self.timeline.time == 0, "a seed can only be given before the first step");
        assert!(self.observers.is_empty(), "give the seed before attaching a trace");
        self.restart(self.engine.again(self.engine.chosen(), seeds));
    }

    /// The same circuit at time 0 on this engine; inputs become zero. Where no code can be generated for this machine, it
    /// is the interpreter if that needs code: [`Simulation::engine`] tells, and [`Simulation::fallback`] why.
    ///
    /// # Panics
    ///
    /// After the first step, or with a trace attached.
    #[track_caller]
    pub fn on(mut self, kind: EngineKind) -> Self {
        assert!(self.timeline.time == 0, "an engine can only be chosen before the first step");
        assert!(self.observers.is_empty(), "choose the engine before attaching a trace");
        self.restart(self.engine.again(kind, self.engine.seeds.clone()));
        self
    }

    /// As on a machine that no code can be generated for, for that reason.
    #[doc(hidden)]
    pub fn without_code(mut self, reason: &str) -> Self {
        self.restart(self.engine.refuse(reason));
        self
    }

    fn restart(&mut self, engine: Started) {
        self.engine = engine;
        self.resets.fill(false);
        self.poked.clear();
    }

    /// The engine that runs: the one chosen, or the interpreter where no code can be generated for this machine.
    pub fn engine(&self) -> EngineKind {
        self.engine.kind()
    }

    /// Why the interpreter runs although another one was chosen; nothing if the chosen one runs.
    pub fn fallback(&self) -> Option<&str> {
        self.engine.fallback()
    }

    /// The compiled circuit.
    pub fn program(&self) -> &Program {
        &self.program
    }

    /// The port of that Verilog name or bundle path.
    ///
    /// # Errors
    ///
    /// There is none.
    pub fn port(&self, name: &str) -> Result<Port, UnknownName> {
        let ports = || self.program.inputs.iter().chain(&self.program.outputs);
        let found = ports().position(|port| port.name == name || port.path == name);
        found
            .map(|index| Port { index: index as u32 })
            .ok_or_else(|| UnknownName::new("port", name, &ports().map(|port| port.name.clone()).collect::<Vec<_>>()))
    }

    /// The declaration of a port.
    #[track_caller]
    pub(crate) fn declared(&self, port: Port) -> &program::Port {
        let index = port.index as usize;
        let inputs = self.program.inputs.len();
        let found =
            if index < inputs { Some(&self.program.inputs[index]) } else { self.program.outputs.get(index - inputs) };
        found.expect("the port is of another simulation")
    }

    /// Sets an input from now on. Several inputs may be set in any order; nothing happens before the next step.
    ///
    /// # Panics
    ///
    /// The value does not fit, or the port is an output.
    #[track_caller]
    pub fn set(&mut self, port: Port, value: impl IntoValue) {
        let bits = self.fitting(port, value);
        self.write(port, bits.limbs());
    }

    /// Sets an input in all runs.
    pub(crate) fn write(&mut self, port: Port, limbs: &[u64]) {
        let input = &self.program.inputs[port.index as usize];
        self.engine.write(input.value, limbs, input.triggers);
        self.changed = self.changed.with(input.triggers);
    }

    /// The value as an input takes it.
    #[track_caller]
    pub(crate) fn fitting(&self, port: Port, value: impl IntoValue) -> Bits {
        let Some(input) = self.program.inputs.get(port.index as usize) else {
            panic!("`{}` is an output and cannot be set", self.declared(port).name)
        };
        let width = self.program.value(input.value).width;
        match value.into_value(width) {
            Ok(bits) => bits,
            Err(problem) => {
                let bits = if width == 1 { "1 bit".to_string() } else { format!("{width} bits") };
                panic!("input `{}` has {bits} and {problem}", input.name)
            }
        }
    }

    /// The value of a port, settled: an output as it follows from the state and the inputs of this moment.
    #[track_caller]
    pub fn get(&mut self, port: Port) -> Bits {
        let value = self.declared(port).value;
        self.lane(value, 0)
    }

    /// As [`Simulation::get`], for a port of up to 64 bits.
    ///
    /// # Panics
    ///
    /// The port is wider.
    #[track_caller]
    pub fn get_u64(&mut self, port: Port) -> u64 {
        let value = self.declared(port).value;
        match self.engine.read(value) {
            [limb] => *limb,
            _ => panic!("`{}` is wider than 64 bits: use `get`", self.declared(port).name),
        }
    }

    /// Sets every input; [`Simulation::drive_bits`] takes values wider than 64 bits.
    ///
    /// # Panics
    ///
    /// A value does not fit, or a list is not as long as the block's.
    #[track_caller]
    pub fn drive(&mut self, values: I::Of<u64>) {
        let values = I::convert(&values, &mut |_, value: &u64| u128::from(*value));
        self.drive_each(&values);
    }

    /// Sets every input.
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
        for (port, value) in paired::<I, V>(&self.i, values) {
            self.set(port, value);
        }
    }

    /// Every output, settled.
    pub fn read(&mut self) -> O::Of<Bits> {
        self.read_run(0)
    }

    pub(crate) fn read_run(&mut self, run: u32) -> O::Of<Bits> {
        let (program, engine) = (&self.program, &mut self.engine);
        O::convert(&self.o, &mut |_, port: &Port| {
            let value = program.outputs[port.index as usize - program.inputs.len()].value;
            lane(program, &mut **engine, value, run)
        })
    }

    /// Every output as a number, settled; easy to compare with an expected bundle.
    ///
    /// # Panics
    ///
    /// An output is wider than 64 bits and does not fit.
    #[track_caller]
    pub fn read_u64(&mut self) -> O::Of<u64> {
        O::convert(&self.read(), &mut |path, bits: &Bits| {
            bits.to_u64().unwrap_or_else(|| panic!("output `{path}` does not fit 64 bits: use `read`"))
        })
    }

    /// Drives one bundle of inputs after another, an instant each, and gives the outputs settled before each edge.
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

/// Each input port with its value.
#[track_caller]
pub(crate) fn paired<I: Bundle, V: Leaf>(ports: &I::Of<Port>, values: &I::Of<V>) -> Vec<(Port, V)> {
    let (ports, values) = (ports.leaves(), values.leaves());
    if let Some(uneven) = uneven(&values, &ports) {
        panic!("input{uneven} is a list of {}, but is set to a list of {}", uneven.needs, uneven.has)
    }
    ports.into_iter().zip(values).map(|((_, port), (_, value))| (port, value)).collect()
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
    let first_output = design.top().inputs.len();
    let port = |index: usize| Port { index: index as u32 };
    let i = B::In::convert(&inputs, &mut |_, index: &usize| port(*index));
    let o = B::Out::convert(&outputs, &mut |_, index: &usize| port(first_output + *index));
    Ok(Typed { design, i, o })
}

impl<I: Bundle, O: Bundle> fmt::Debug for Simulation<I, O> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let top = &self.program.hierarchy.scopes[0].name;
        f.debug_struct("Simulation").field("top", top).field("time", &self.timeline.time).finish_non_exhaustive()
    }
}
