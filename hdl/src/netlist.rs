//! A module under construction as a graph.

use crate::draft::Draft;
use tilewright_circuit::ir::{Input, Instance, MemoryId, Node, NodeId, ReadPort};
pub(crate) use tilewright_circuit::netlist::Netlist;

impl Netlist for Draft {
    fn title(&self) -> &str {
        self.block
    }

    fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    fn inputs(&self) -> &[Input] {
        &self.inputs
    }

    fn instances(&self) -> &[Instance] {
        &self.instances
    }

    fn read(&self, memory: MemoryId, port: u32) -> &ReadPort {
        &self.memories[memory.0 as usize].memory.reads[port as usize]
    }

    fn describe(&self, id: NodeId) -> String {
        Draft::describe(self, id)
    }
}
