//! The summary of a draft: the inputs and clocks that each output depends on within a cycle.

use crate::draft::Draft;
use std::collections::BTreeSet;
use tilewright_circuit::graph::{Graph, Sets};
use tilewright_circuit::ir::{InstanceId, NodeId, Op};
pub(crate) use tilewright_circuit::summary::*;

/// The operands whose clocks are visible in `id`: a quasi-static signal, here or in a child, hides the clocks behind
/// it.
fn timed_operands(draft: &Draft, summaries: &[Summary], id: NodeId, visit: &mut dyn FnMut(NodeId)) {
    match &draft.node(id).op {
        Op::QuasiStatic(..) => {}
        Op::Output(instance, port) => {
            let instance = &draft.instances[instance.0 as usize];
            let inputs = &summaries[instance.module.0 as usize].outputs[*port as usize].timed_inputs;
            inputs.iter().filter_map(|input| instance.inputs.get(*input as usize)).for_each(|id| visit(*id));
        }
        _ => operands(draft, summaries, id, visit),
    }
}

/// The input ports that a node is wired to, if it is [wired](is_wired) to ports, state and constants; such a node
/// changes at most once a clock. `None` if there is logic, which glitches. A quasi-static signal is trusted.
pub(crate) fn wired_inputs(draft: &Draft, summaries: &[Summary], id: NodeId) -> Option<Vec<u32>> {
    let (mut seen, mut behind, mut inputs) = (BTreeSet::new(), vec![id], Vec::new());
    while let Some(id) = behind.pop() {
        if !seen.insert(id) {
            continue;
        }
        match draft.node(id).op {
            Op::Input(index) => inputs.push(index),
            Op::QuasiStatic(..) => continue,
            Op::Output(instance, _) if is_pad(draft, summaries, instance) => continue,
            _ if !is_wired(draft, summaries, id) => return None,
            _ => {}
        }
        operands(draft, summaries, id, &mut |id| behind.push(id));
    }
    Some(inputs)
}

/// Whether an instance is a pad. Its line comes from outside, and is trusted as an input is.
fn is_pad(draft: &Draft, summaries: &[Summary], instance: InstanceId) -> bool {
    summaries[draft.instances[instance.0 as usize].module.0 as usize].is_pad
}

/// Whether a node has no logic: a port, state, a constant, or wires with at most an inverter.
fn is_wired(draft: &Draft, summaries: &[Summary], id: NodeId) -> bool {
    match &draft.node(id).op {
        Op::Read(memory, port) => draft.memories[memory.0 as usize].memory.reads[*port as usize].clock.is_some(),
        Op::Output(instance, port) => {
            let module = draft.instances[instance.0 as usize].module;
            summaries[module.0 as usize].outputs[*port as usize].wired
        }
        Op::Input(_) => true,
        op => op.is_wiring(),
    }
}

/// For each node, whether it comes without logic, as defined by [`wired_inputs`].
fn wired(draft: &Draft, summaries: &[Summary], operands: &Graph) -> Vec<bool> {
    let mut wired = vec![true; draft.nodes.len()];
    for component in operands.components() {
        let comes = |node: &u32| {
            let is_static = matches!(draft.node(NodeId(*node)).op, Op::QuasiStatic(..));
            let behind = || operands.of(*node).iter().all(|of| wired[*of as usize]);
            is_static || is_wired(draft, summaries, NodeId(*node)) && behind()
        };
        let all = component.iter().all(comes);
        component.iter().for_each(|node| wired[*node as usize] = all);
    }
    wired
}

/// From each node to the operands whose clocks are visible in it.
pub(crate) fn timed(draft: &Draft, summaries: &[Summary]) -> Graph {
    Graph::new(draft.nodes.len(), |node, push| timed_operands(draft, summaries, NodeId(node), &mut |id| push(id.0)))
}

/// Whether the clocks of input ports count as clocks of the value. Inside the module they do; for a parent they do
/// not, because it knows the drivers.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum View {
    Inside,
    Outside,
}

/// The clocks whose state each node depends on within a cycle; a quasi-static signal hides the clocks behind it.
pub(crate) fn clock_sets(draft: &Draft, summaries: &[Summary], view: View, timed: &Graph) -> Sets {
    let mut sets = Sets::new(draft.nodes.len(), draft.clocks.len());
    for (i, node) in draft.nodes.iter().enumerate() {
        let mut add = |clock: tilewright_circuit::ir::ClockId| sets.insert(i as u32, clock.0 as usize);
        match &node.op {
            Op::Register(register) => add(draft.registers[register.0 as usize].clock),
            Op::Read(memory, port) => {
                let memory = &draft.memories[memory.0 as usize].memory;
                match memory.reads[*port as usize].clock {
                    Some(clock) => add(clock),
                    None => memory.writes.iter().for_each(|write| add(write.clock)),
                }
            }
            Op::Input(index) if view == View::Inside => draft.inputs[*index as usize].clock.into_iter().for_each(add),
            Op::Output(instance, port) => {
                let instance = &draft.instances[instance.0 as usize];
                let clocks = &summaries[instance.module.0 as usize].outputs[*port as usize].clocks;
                clocks.iter().for_each(|clock| add(instance.clocks[*clock as usize]));
            }
            _ => {}
        }
    }
    sets.spread(timed);
    sets
}

/// Whether a quasi-static signal, here or in an instance, hides the clocks behind it.
fn hides_clocks(draft: &Draft, summaries: &[Summary]) -> bool {
    let modules = draft.instances.iter().map(|instance| &summaries[instance.module.0 as usize]);
    draft.nodes.iter().any(|node| matches!(node.op, Op::QuasiStatic(..)))
        || modules.flat_map(|summary| &summary.outputs).any(|output| output.timed_inputs != output.inputs)
}

/// The summary of a draft; `renumber` maps its clocks to those of the finished module.
pub(crate) fn summarize(draft: &Draft, summaries: &[Summary], outputs: &[NodeId], renumber: &[Option<u32>]) -> Summary {
    let operands = combinational(draft, summaries);
    let inputs = input_sets(draft, &operands);
    let wired = wired(draft, summaries, &operands);
    let apart = hides_clocks(draft, summaries).then(|| timed(draft, summaries));
    let timed = apart.as_ref().unwrap_or(&operands);
    let timed_inputs = input_sets(draft, timed);
    let clocks = clock_sets(draft, summaries, View::Outside, timed);
    let dependence = |output: &NodeId| Dependence {
        inputs: inputs.members(output.0).map(|i| i as u32).collect(),
        timed_inputs: timed_inputs.members(output.0).map(|i| i as u32).collect(),
        clocks: clocks.members(output.0).filter_map(|clock| renumber[clock]).collect(),
        wired: wired[output.0 as usize],
    };
    Summary {
        outputs: outputs.iter().map(dependence).collect(),
        synchronized: vec![],
        faulty: BTreeSet::new(),
        is_pad: false,
    }
}
