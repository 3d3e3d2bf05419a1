//! A folded module while it is being printed: what is known of it before, and what its text has read so far.

use super::lane_names::{ArrayNames, LaneNames};
use super::names::name_nodes;
use super::plan::Plan;
use super::reads::{ReadNames, name_reads};
use super::scope::Names;
use super::states::StateNames;
use super::usage::Usage;
use tilewright_hdl::ir::{ClockId, Design, InstanceId, Module, NodeId, Op};

/// A folded module while it is being printed.
pub struct Printer<'a> {
    pub design: &'a Design,
    pub module: &'a Module,
    pub plan: Plan,
    pub taken: Names,
    /// The names of the nodes that have one.
    pub names: Vec<Option<String>>,
    /// The names of synchronous read ports, by memory and port.
    pub reads: Vec<Vec<Option<ReadNames>>>,
    pub states: StateNames,
    pub arrays: ArrayNames,
    pub usage: Usage,
}

impl<'a> Printer<'a> {
    pub fn new(design: &'a Design, module: &'a Module) -> Printer<'a> {
        let plan = Plan::new(module);
        let mut taken = Names::of(design, module);
        let reads = name_reads(module, &mut taken);
        let names = name_nodes(design, module, &plan, &reads, &mut taken);
        let states = StateNames::new(module, &mut taken);
        let arrays = ArrayNames::new(design, module, &mut taken);
        let usage = Usage::new(module.nodes.len());
        Printer { design, module, plan, taken, names, reads, states, arrays, usage }
    }

    /// The name of a node that has one.
    pub fn name(&self, id: NodeId) -> &str {
        self.names[id.0 as usize].as_deref().expect("a declared node has a name")
    }

    /// Whether a node's name is the name of the output port that it drives.
    pub fn is_port(&self, id: NodeId) -> bool {
        let name = self.names[id.0 as usize].as_ref();
        self.module.outputs.iter().any(|output| output.node == id && Some(&output.name) == name)
    }

    /// The names in a lane of an array.
    pub fn lane_names(&self, array: InstanceId) -> &LaneNames {
        &self.arrays.arrays[&array]
    }

    /// The net of an output inside of a lane's scope.
    pub fn lane_port(&self, array: InstanceId, port: u32) -> &str {
        &self.lane_names(array).outputs[port as usize]
    }

    /// The name of one lane of an array's output, seen from outside the array.
    pub fn lane_name(&self, of: NodeId, lane: u32) -> String {
        let (instance, port) = self.array_output(of);
        let instance_name = &self.module.instances[instance.0 as usize].name;
        format!("{instance_name}[{lane}].{}", self.lane_port(instance, port))
    }

    /// Notes that a whole lane is read.
    pub fn read_lane(&mut self, of: NodeId, lane: u32) {
        let lanes = self.module.node(of).shape.lanes();
        self.usage.lanes.entry(of).or_insert_with(|| vec![false; lanes as usize])[lane as usize] = true;
    }

    /// The array and the port that a lane node comes from.
    pub fn array_output(&self, of: NodeId) -> (InstanceId, u32) {
        match self.module.node(of).op {
            Op::Output(instance, port) => (instance, port),
            _ => unreachable!("folding leaves only outputs to pick lanes of"),
        }
    }

    /// The name of a clock's port, which is read from here on.
    pub fn clock_port(&mut self, clock: ClockId) -> String {
        let port = self.module.clocks[clock.0 as usize].port.clone();
        self.usage.clocks.insert(port.clone());
        port
    }

    /// The name of the reset port that goes with a clock, which is read from here on.
    pub fn reset_port(&mut self, clock: ClockId) -> String {
        let reset = self.module.clocks[clock.0 as usize].reset.clone();
        let reset = reset.expect("a clock with a reset register has a reset port");
        self.usage.clocks.insert(reset.clone());
        reset
    }
}
