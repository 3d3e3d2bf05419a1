//! What a box can stand for: ports of the top, and registers, memories, instances and nets of the modules shown.

use super::ports::Ports;
use std::collections::BTreeMap;
use tilewright_circuit::ir::{Design, Instance, InstanceId, MemoryId, Module, ModuleId, NodeId, RegisterId};

/// Something that a box can stand for, in a scope.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum What {
    /// A bundle of ports of the top module.
    Port(usize),
    Register(RegisterId),
    Memory(MemoryId),
    /// An instance that is not opened.
    Instance(InstanceId),
    /// A net of logic that the diagram is drawn around.
    Net(NodeId),
}

/// A module whose contents are shown: the top, or that of an opened instance.
pub(super) struct Scope<'a> {
    pub module: &'a Module,
    /// The scope around it and its instance there.
    pub outside: Option<(usize, InstanceId)>,
    /// The scopes of its opened instances.
    pub opened: BTreeMap<InstanceId, usize>,
    /// The path of instances, each followed by a point.
    pub path: String,
}

/// The items of a design down to some level.
pub(super) struct Items<'a> {
    pub design: &'a Design,
    /// The top first, each scope before those inside it.
    pub scopes: Vec<Scope<'a>>,
    pub list: Vec<(usize, What)>,
    index: BTreeMap<(usize, What), usize>,
    /// The ports of each module.
    pub ports: Vec<Ports>,
    /// The item that the diagram is drawn around.
    pub focus: Option<usize>,
}

impl<'a> Items<'a> {
    /// The items at that depth; 1 is the top module alone.
    pub fn of(design: &'a Design, depth: u32) -> Items<'a> {
        let ports = design.modules().iter().map(Ports::of).collect();
        let mut items =
            Items { design, scopes: Vec::new(), list: Vec::new(), index: BTreeMap::new(), ports, focus: None };
        items.open(design.top(), None, String::new(), depth);
        let bundles = items.top_ports().bundles.iter().enumerate();
        let (ins, outs): (Vec<_>, Vec<_>) = bundles.map(|(i, it)| (What::Port(i), it.comes_in)).partition(|it| it.1);
        ins.iter().for_each(|(port, _)| items.add(0, *port));
        for scope in 0..items.scopes.len() {
            items.add_contents(scope);
        }
        outs.iter().for_each(|(port, _)| items.add(0, *port));
        items
    }

    fn open(&mut self, module: &'a Module, outside: Option<(usize, InstanceId)>, path: String, depth: u32) -> usize {
        let scope = self.scopes.len();
        self.scopes.push(Scope { module, outside, opened: BTreeMap::new(), path });
        for (i, instance) in module.instances.iter().enumerate().filter(|_| depth > 1) {
            let inside = self.design.module(instance.module);
            // A module of logic alone has nothing to show, and a model is not what is in a foreign module.
            let is_logic = inside.registers.is_empty() && inside.memories.is_empty() && inside.instances.is_empty();
            if is_logic || inside.foreign.is_some() {
                continue;
            }
            let id = InstanceId(i as u32);
            let path = format!("{}{}.", self.scopes[scope].path, instance.name);
            let opened = self.open(inside, Some((scope, id)), path, depth - 1);
            self.scopes[scope].opened.insert(id, opened);
        }
        scope
    }

    fn add_contents(&mut self, scope: usize) {
        let Scope { module, opened, .. } = &self.scopes[scope];
        let instances = (0..module.instances.len() as u32).map(InstanceId).filter(|id| !opened.contains_key(id));
        let mut found: Vec<What> = instances.map(What::Instance).collect();
        found.extend((0..module.memories.len() as u32).map(|id| What::Memory(MemoryId(id))));
        found.extend((0..module.registers.len() as u32).map(|id| What::Register(RegisterId(id))));
        found.into_iter().for_each(|what| self.add(scope, what));
    }

    /// Adds an item.
    pub fn add(&mut self, scope: usize, what: What) {
        self.index.insert((scope, what), self.list.len());
        self.list.push((scope, what));
    }

    pub fn find(&self, scope: usize, what: What) -> Option<usize> {
        self.index.get(&(scope, what)).copied()
    }

    pub fn top_ports(&self) -> &Ports {
        self.ports.last().expect("a design has a top module")
    }

    pub fn ports_of(&self, instance: &Instance) -> &Ports {
        let ModuleId(module) = instance.module;
        &self.ports[module as usize]
    }

    pub fn instance(&self, scope: usize, id: InstanceId) -> &'a Instance {
        &self.scopes[scope].module.instances[id.0 as usize]
    }

    /// The name of an item in its module.
    pub fn name(&self, item: usize) -> &str {
        let (scope, what) = self.list[item];
        let module = self.scopes[scope].module;
        match what {
            What::Port(bundle) => &self.top_ports().bundles[bundle].name,
            What::Register(id) => module.register_name(&module.registers[id.0 as usize]),
            What::Memory(id) => &module.memories[id.0 as usize].name,
            What::Instance(id) => &module.instances[id.0 as usize].name,
            What::Net(id) => module.node(id).name.as_deref().expect("only a named net has a box"),
        }
    }
}
