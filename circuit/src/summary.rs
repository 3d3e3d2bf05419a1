//! A finished module's summary for its parents: the inputs and clocks that each output depends on within a cycle.

use crate::graph::{Graph, Sets};
use crate::ir::{Module, NodeId, Op};
use crate::netlist::Netlist;
use std::collections::BTreeSet;

/// For each output of a module, its dependencies that pass no register; and the synchronizers that its inputs feed.
pub struct Summary {
    pub outputs: Vec<Dependence>,
    /// Indices of input ports that are wired to a synchronizer, with its name.
    pub synchronized: Vec<(u32, String)>,
    /// The input ports whose declaration is faulty, and the outputs that follow from a problem: both by their nodes.
    pub faulty: BTreeSet<NodeId>,
    /// Whether it is a pad, whose line comes from outside.
    pub is_pad: bool,
}

pub struct Dependence {
    /// Indices of input ports.
    pub inputs: Vec<u32>,
    /// Those whose clocks are visible, not hidden by a quasi-static signal.
    pub timed_inputs: Vec<u32>,
    /// Indices of clocks whose registers or memories it reads.
    pub clocks: Vec<u32>,
    /// Whether it comes without logic, but for wires and an inverter.
    pub wired: bool,
}

impl Dependence {
    /// Treats the output as quasi-static.
    pub fn hide_clocks(&mut self) {
        self.timed_inputs.clear();
        self.clocks.clear();
    }
}

impl Summary {
    /// The summary of an unsound module, about which nothing more is reported.
    pub fn unknown(outputs: usize) -> Summary {
        let nothing = || Dependence { inputs: vec![], timed_inputs: vec![], clocks: vec![], wired: true };
        Summary {
            outputs: std::iter::repeat_with(nothing).take(outputs).collect(),
            synchronized: vec![],
            faulty: BTreeSet::new(),
            is_pad: false,
        }
    }
}

/// The combinational edges of a module, from a node to the nodes that it is computed from.
pub fn combinational(circuit: &impl Netlist, summaries: &[Summary]) -> Graph {
    Graph::new(circuit.nodes().len(), |node, push| operands(circuit, summaries, NodeId(node), &mut |id| push(id.0)))
}

/// Visits every node that `id` is computed from in the same cycle, through instances and asynchronous reads too.
pub fn operands(circuit: &impl Netlist, summaries: &[Summary], id: NodeId, visit: &mut dyn FnMut(NodeId)) {
    let op = &circuit.node(id).op;
    match op {
        Op::Read(memory, port) => {
            let read = circuit.read(*memory, *port);
            if read.clock.is_none() {
                visit(read.address);
            }
        }
        Op::Output(instance, port) => {
            let instance = &circuit.instances()[instance.0 as usize];
            let inputs = &summaries[instance.module.0 as usize].outputs[*port as usize].inputs;
            inputs.iter().filter_map(|input| instance.inputs.get(*input as usize)).for_each(|id| visit(*id));
        }
        _ => op.for_each_operand(visit),
    }
}

/// The inputs that each node depends on through these edges.
pub fn input_sets(circuit: &impl Netlist, operands: &Graph) -> Sets {
    let mut inputs = Sets::new(circuit.nodes().len(), circuit.inputs().len());
    circuit.inputs().iter().enumerate().for_each(|(i, input)| inputs.insert(input.node.0, i));
    inputs.spread(operands);
    inputs
}

/// The part of a finished module's summary that the check for loops in its parents needs.
pub fn of_loops(module: &Module, operands: &Graph) -> Summary {
    let sets = input_sets(module, operands);
    let mut summary = Summary::unknown(module.outputs.len());
    for (dependence, output) in summary.outputs.iter_mut().zip(&module.outputs) {
        dependence.inputs = sets.members(output.node.0).map(|input| input as u32).collect();
    }
    summary
}
