//! The names of an instance: its ports, registers, read data, nets and memories.

use std::borrow::Cow;

use rustc_hash::FxHashSet;
use tilewright_circuit::ir::{Kind, Module, Node, NodeId, Op};

use super::ValueId;
use super::flatten::{Body, Flatten};
use super::hierarchy::{ClockPort, Role, ScopeId, Signal};

impl Flatten<'_> {
    /// Enters the names of an instance's ports, registers, read data, nets and memories.
    pub(super) fn name(&mut self, body: &Body, module: &Module, memories: &[u32]) {
        for id in &body.scopes {
            self.name_in(*id, body, module, memories);
        }
    }

    fn name_in(&mut self, id: ScopeId, body: &Body, module: &Module, memories: &[u32]) {
        let scope = &mut self.flat.program.hierarchy.scopes[id.0 as usize];
        scope.clocks = (module.clocks.iter().zip(&body.clocks))
            .map(|(ports, &clock)| ClockPort { port: ports.port.clone(), reset: ports.reset.clone(), clock })
            .collect();
        let named = module.memories.iter().zip(memories);
        scope.memories = named.map(|(memory, &index)| (memory.name.clone(), index, memory.shape)).collect();
        scope.signals = signals(module, |node| body.whole(node));
    }
}

/// The named values of a module: ports first, then the data of synchronous reads, then the rest. Unnamed read data is
/// called `MEMORY_read`, or `MEMORY_read0` and so on if there are several.
fn signals<'a>(module: &'a Module, value: impl Fn(NodeId) -> ValueId) -> Vec<Signal> {
    let mut all: Vec<Signal> = Vec::new();
    let mut taken: FxHashSet<Cow<'a, str>> = FxHashSet::default();
    let mut add = |name: Cow<'a, str>, role, node: NodeId, kind: Kind| {
        if taken.insert(name.clone()) {
            let &Node { width, shape, .. } = module.node(node);
            all.push(Signal { name: name.into_owned(), role, value: value(node), width, shape, kind });
        }
    };
    for port in &module.inputs {
        add(port.name.as_str().into(), Role::Input, port.node, module.node(port.node).kind);
    }
    let is_register = |node: &Node| matches!(node.op, Op::Register(_));
    for port in &module.outputs {
        let node = module.node(port.node);
        let named_alike = is_register(node) && node.name.as_ref() == Some(&port.name);
        add(port.name.as_str().into(), if named_alike { Role::Register } else { Role::Output }, port.node, port.kind);
    }
    for memory in &module.memories {
        let synchronous: Vec<_> = memory.reads.iter().filter(|read| read.clock.is_some()).collect();
        for (index, read) in synchronous.iter().enumerate() {
            let number = if synchronous.len() > 1 { index.to_string() } else { String::new() };
            let Node { name, kind, .. } = module.node(read.node);
            let usual = || format!("{}_read{number}", memory.name).into();
            add(name.as_deref().map_or_else(usual, Cow::from), Role::ReadData, read.node, *kind);
        }
    }
    for (index, node) in module.nodes.iter().enumerate() {
        if let Some(name) = &node.name {
            let role = if is_register(node) { Role::Register } else { Role::Net };
            add(name.into(), role, NodeId(index as u32), node.kind);
        }
    }
    all
}
