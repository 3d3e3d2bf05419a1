//! The common interface of a module under construction and a finished one, for walks over the graph.

use crate::ir::{Input, Instance, MemoryId, Module, Node, NodeId, ReadPort};

/// A graph of nodes with its inputs, memories and instances.
pub trait Netlist {
    /// The module's name for messages.
    fn title(&self) -> &str;
    fn nodes(&self) -> &[Node];
    fn inputs(&self) -> &[Input];
    fn instances(&self) -> &[Instance];
    fn read(&self, memory: MemoryId, port: u32) -> &ReadPort;
    /// A node for messages.
    fn describe(&self, id: NodeId) -> String;

    fn node(&self, id: NodeId) -> &Node {
        &self.nodes()[id.0 as usize]
    }
}

impl Netlist for Module {
    fn title(&self) -> &str {
        &self.name
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
        &self.memories[memory.0 as usize].reads[port as usize]
    }

    /// Its name, or else its number: the nodes of an edited circuit need not come from an expression.
    fn describe(&self, id: NodeId) -> String {
        let name = self.nodes.get(id.0 as usize).and_then(|node| node.name.clone());
        name.unwrap_or_else(|| format!("node {}", id.0))
    }
}
