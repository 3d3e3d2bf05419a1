//! The number of clocks from a module's inputs to its outputs, if it is a single number. It is counted, because a
//! stated latency could be wrong.

use super::{Design, Instance, Module, Node, NodeId, Op, Register};
use crate::graph::Graph;
use std::fmt;

/// The clocks from every input of a module to every output that depends on it, except through enables: the number of
/// registers and synchronous reads between. See [`Design::latencies`].
///
/// ```
/// # use tilewright_hdl::*;
/// let latency = ir::Latency { clocks: 1, enable: Some("advances".to_owned()) };
/// assert_eq!(latency.to_string(), "1 clock with `advances`");
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Latency {
    /// The number of clocks.
    pub clocks: u32,
    /// The input port that enables all those registers, if there is one: only clocks in which it is high count.
    pub enable: Option<String>,
}

impl fmt::Display for Latency {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let plural = if self.clocks == 1 { "" } else { "s" };
        write!(f, "{} clock{plural}", self.clocks)?;
        self.enable.iter().try_for_each(|enable| write!(f, " with `{enable}`"))
    }
}

impl Design {
    /// The latency of each module. `None` if it is not a single number, as for a state machine, a queue, or a module
    /// with several clocks.
    ///
    /// ```
    /// use tilewright_hdl::*;
    ///
    /// block! {
    ///     /// The square of a sum.
    ///     pub struct Square;
    ///     in SquareIn { a: bits(8), b: bits(8), advances: bit() }
    ///     out SquareOut { square: bits(16) }
    /// }
    ///
    /// impl Square {
    ///     fn build(&self, m: Module, i: SquareIn) -> SquareOut {
    ///         def!(sum = m.pipe_when(i.advances, i.a + i.b));
    ///         SquareOut { square: m.pipe_when(i.advances, "squared", sum.times(sum)) }
    ///     }
    /// }
    ///
    /// let latencies = elaborate(&Square)?.latencies();
    /// assert_eq!(latencies[0].as_ref().unwrap().to_string(), "2 clocks with `advances`");
    /// # Ok::<(), Problems>(())
    /// ```
    pub fn latencies(&self) -> Vec<Option<Latency>> {
        let mut delays: Vec<Vec<Delay>> = Vec::new();
        for module in self.modules() {
            delays.push(output_delays(module, &delays));
        }
        self.modules().iter().zip(&delays).map(|(module, delays)| latency(module, delays)).collect()
    }
}

/// The latency of a module whose outputs have these delays.
#[doc(hidden)]
pub fn latency(module: &Module, delays: &[Delay]) -> Option<Latency> {
    match delays.iter().fold(Delay::Nothing, |all, one| all.or(*one)) {
        Delay::Clocks { clocks, gate } => {
            let enable = if let Gate::Input(input) = gate { Some(&module.inputs[input as usize].name) } else { None };
            Some(Latency { clocks, enable: enable.cloned() })
        }
        Delay::Nothing | Delay::Several => None,
    }
}

/// The time from an input to a value.
#[derive(Debug, Clone, Copy, PartialEq)]
#[doc(hidden)]
pub enum Delay {
    /// The value depends on no input.
    Nothing,
    /// This number of clocks.
    Clocks { clocks: u32, gate: Gate },
    /// There is no single answer.
    Several,
}

/// The clocks that a delay counts.
#[derive(Debug, Clone, Copy, PartialEq)]
#[doc(hidden)]
pub enum Gate {
    /// All clocks.
    Always,
    /// Those in which this input is high.
    Input(u32),
}

impl Delay {
    fn or(self, other: Delay) -> Delay {
        match (self, other) {
            (Delay::Nothing, one) | (one, Delay::Nothing) => one,
            (one, other) if one == other => one,
            _ => Delay::Several,
        }
    }

    /// The delay of a value that accumulates such values.
    fn remembered(self) -> Delay {
        if self == Delay::Nothing { Delay::Nothing } else { Delay::Several }
    }

    /// The delay after `more` clocks; `None` if their enable is not an input.
    fn after(self, more: u32, by: Option<Gate>) -> Delay {
        match (self, by) {
            (Delay::Nothing, _) => Delay::Nothing,
            (delay, _) if more == 0 => delay,
            (Delay::Clocks { clocks, gate }, Some(by)) if clocks == 0 || gate == by => {
                Delay::Clocks { clocks: clocks + more, gate: by }
            }
            _ => Delay::Several,
        }
    }
}

/// The delay of each output of a module; those of its children are known.
#[doc(hidden)]
pub fn output_delays(module: &Module, children: &[Vec<Delay>]) -> Vec<Delay> {
    if module.clocks.len() > 1 {
        return vec![Delay::Several; module.outputs.len()];
    }
    let count = module.nodes.len();
    let graph = Graph::new(count, |node, push| operands(module, NodeId(node), &mut |id| push(id.0)));
    let mut delays = vec![Delay::Nothing; count];
    for input in &module.inputs {
        delays[input.node.0 as usize] = Delay::Clocks { clocks: 0, gate: Gate::Always };
    }
    for component in graph.components() {
        let own = match graph.is_cyclic(component) {
            // A value that depends on itself accumulates, even if only the number of enabled clocks.
            true => {
                let operands = component.iter().flat_map(|node| graph.of(*node));
                operands.fold(Delay::Nothing, |all, of| all.or(delays[*of as usize].remembered()))
            }
            false => delay(module, children, &delays, NodeId(component[0])),
        };
        component.iter().for_each(|node| delays[*node as usize] = own);
    }
    module.outputs.iter().map(|output| delays[output.node.0 as usize]).collect()
}

/// The nodes that determine the value of a node, in any clock, except for enables.
fn operands(module: &Module, id: NodeId, visit: &mut dyn FnMut(NodeId)) {
    match &module.node(id).op {
        Op::Register(register) => {
            let (next, enable) = taken(module, &module.registers[register.0 as usize]);
            visit(next);
            enable.into_iter().for_each(visit);
        }
        Op::Read(memory, port) => {
            let memory = &module.memories[memory.0 as usize];
            visit(memory.reads[*port as usize].address);
            memory.writes.iter().flat_map(|write| [write.enable, write.address, write.data]).for_each(visit);
        }
        Op::Output(instance, _) => {
            module.instances[instance.0 as usize].inputs.iter().for_each(|input| visit(*input));
        }
        op => op.for_each_operand(visit),
    }
}

/// The value that a register takes, and its enable. A register that takes a value under one condition and otherwise
/// keeps its own is enabled by that condition.
fn taken(module: &Module, register: &Register) -> (NodeId, Option<NodeId>) {
    match &module.node(register.next).op {
        Op::Select { arms, default } if *default == register.node && arms.len() == 1 && register.enable.is_none() => {
            (arms[0].1, Some(arms[0].0))
        }
        _ => (register.next, register.enable),
    }
}

fn delay(module: &Module, children: &[Vec<Delay>], delays: &[Delay], id: NodeId) -> Delay {
    let of = |id: NodeId| delays[id.0 as usize];
    let node: &Node = module.node(id);
    match &node.op {
        Op::Input(_) => of(id),
        Op::Register(register) => {
            let (next, enable) = taken(module, &module.registers[register.0 as usize]);
            of(next).after(1, gate(module, enable))
        }
        Op::Read(memory, port) => {
            let memory = &module.memories[memory.0 as usize];
            let read = &memory.reads[*port as usize];
            let written = memory.writes.iter().flat_map(|write| [write.enable, write.address, write.data]);
            // A word that an input has written stays for any time.
            let is_written = written.into_iter().any(|id| of(id) != Delay::Nothing);
            let data = if is_written { Delay::Several } else { of(read.address) };
            data.after(read.clock.is_some().into(), gate(module, read.enable))
        }
        Op::Output(instance, port) => {
            let instance = &module.instances[instance.0 as usize];
            through(module, instance, children[instance.module.0 as usize][*port as usize], &of)
        }
        op => {
            let mut all = Delay::Nothing;
            op.for_each_operand(|id| all = all.or(of(id)));
            all
        }
    }
}

/// The delay of an output of an instance, from the delays of the instance's inputs.
fn through(module: &Module, instance: &Instance, delay: Delay, of: &dyn Fn(NodeId) -> Delay) -> Delay {
    let Delay::Clocks { clocks, gate: by } = delay else {
        return if delay == Delay::Nothing { Delay::Nothing } else { Delay::Several };
    };
    let (enable, by) = match by {
        Gate::Always => (None, Some(Gate::Always)),
        Gate::Input(input) => (Some(input as usize), gate(module, Some(instance.inputs[input as usize]))),
    };
    let inputs = instance.inputs.iter().enumerate().filter(|(place, _)| Some(*place) != enable);
    inputs.fold(Delay::Nothing, |all, (_, input)| all.or(of(*input))).after(clocks, by)
}

/// The gate of an enable; `None` if the enable is more than an input.
fn gate(module: &Module, enable: Option<NodeId>) -> Option<Gate> {
    let Some(mut enable) = enable else { return Some(Gate::Always) };
    loop {
        match module.node(enable).op {
            Op::Input(input) => return Some(Gate::Input(input)),
            Op::Wire(of) | Op::Broadcast { of, .. } => enable = of,
            _ => return None,
        }
    }
}
