//! From modules and instances to one flat netlist. Instance arrays stay whole, except those asked to be unrolled.

use std::collections::{BTreeSet, VecDeque};

use tilewright_hdl::ir::{Design, MemoryId, Module, ModuleId, Node, NodeId, Op};

use super::hierarchy::{ClockPort, Replication, Role, Scope, ScopeId, Signal};
use super::instances::{Children, key_of};
use super::{
    Affine, Assert, Axis, Cell, Clock, Kind, Memory, Passes, Port, Program, ReadPort, Register, Triggers, ValueId,
    WritePort,
};

/// A design made flat.
pub(super) struct Flat {
    /// Its cells in no particular order; nothing is scheduled.
    pub program: Program,
    /// The outputs of arrays that are kept whole, with the array that each is of.
    pub array_outputs: Vec<(ValueId, ArrayKey)>,
}

/// An instance array, the same one whatever lane it is looked at from: the instances' names from the top down.
pub(super) type ArrayKey = Vec<String>;

/// The design as cells, so many times side by side; the arrays of `unrolled` become single instances.
pub(super) fn flatten(design: &Design, lanes: u32, unrolled: &BTreeSet<ArrayKey>, passes: &Passes) -> Flat {
    let program = Program { passes: passes.clone(), ..Program::default() };
    let flat = Flat { program, array_outputs: Vec::new() };
    let mut flatten = Flatten { design, unrolled, flat, open: VecDeque::new() };
    flatten.top(lanes);
    while let Some(body) = flatten.open.pop_front() {
        flatten.body(body);
    }
    flatten.flat
}

pub(super) struct Flatten<'a> {
    pub(super) design: &'a Design,
    pub(super) unrolled: &'a BTreeSet<ArrayKey>,
    pub(super) flat: Flat,
    /// Instances whose cells have ids but are not filled in yet.
    open: VecDeque<Body>,
}

/// The inside of an instance.
pub(super) struct Body {
    pub(super) module: ModuleId,
    pub(super) key: ArrayKey,
    /// Its scope; several if it stands for instances that were written one by one.
    pub(super) scopes: Vec<ScopeId>,
    pub(super) lanes: u32,
    /// The cell of the module's first node; the others follow.
    base: u32,
    /// The first of a node's cells for single lanes, for nodes with lanes in a module with an unrolled array.
    split: Vec<Option<u32>>,
    /// What drives the inputs; empty for the top, whose inputs are state.
    inputs: Vec<ValueId>,
    /// The program's clock for each clock of the module.
    pub(super) clocks: Vec<u32>,
    children: Vec<Children>,
}

impl Body {
    pub(super) fn whole(&self, node: NodeId) -> ValueId {
        ValueId(self.base + node.0)
    }

    /// One lane of a node with lanes, where arrays are unrolled.
    pub(super) fn lane(&self, node: NodeId, lane: u32) -> ValueId {
        ValueId(self.split[node.0 as usize].expect("lanes are split where an array is unrolled") + lane)
    }
}

impl Flatten<'_> {
    fn top(&mut self, lanes: u32) {
        let module = self.design.top();
        let id = ModuleId(self.design.modules().len() as u32 - 1);
        self.flat.program.clocks = module.clocks.iter().map(program_clock).collect();
        let clocks = (0..module.clocks.len() as u32).collect();
        let scope = self.scope(None, module.name.clone(), id, Replication::Single, lanes);
        let base = self.enter(id, Vec::new(), vec![scope], lanes, Vec::new(), clocks);
        let value = |node: NodeId| ValueId(base + node.0);
        for input in &module.inputs {
            let clock = input.clock.map_or(0, |clock| clock.0 as usize);
            self.flat.program.inputs.push(Port {
                name: input.name.clone(),
                path: input.path.clone(),
                value: value(input.node),
                triggers: Triggers::inputs(clock),
            });
        }
        for output in &module.outputs {
            self.flat.program.outputs.push(Port {
                name: output.name.clone(),
                path: output.path.clone(),
                value: value(output.node),
                triggers: Triggers::NONE,
            });
        }
    }

    /// Adds a scope to the hierarchy.
    pub(super) fn scope(
        &mut self,
        parent: Option<ScopeId>,
        name: String,
        module: ModuleId,
        replication: Replication,
        lanes: u32,
    ) -> ScopeId {
        let scopes = &mut self.flat.program.hierarchy.scopes;
        let id = ScopeId(scopes.len() as u32);
        if let Some(parent) = parent {
            scopes[parent.0 as usize].children.push(id);
        }
        scopes.push(Scope {
            name,
            module: self.design.module(module).name.clone(),
            parent,
            replication,
            lanes,
            clocks: Vec::new(),
            signals: Vec::new(),
            memories: Vec::new(),
            children: Vec::new(),
        });
        id
    }

    /// Gives cells to the nodes of an instance, to be filled in later; returns the first.
    pub(super) fn enter(
        &mut self,
        module: ModuleId,
        key: ArrayKey,
        scopes: Vec<ScopeId>,
        lanes: u32,
        inputs: Vec<ValueId>,
        clocks: Vec<u32>,
    ) -> u32 {
        let definition = self.design.module(module);
        let base = self.flat.program.circuit.len() as u32;
        for node in &definition.nodes {
            self.cell(lanes * node.shape.lanes(), node);
        }
        let splits = definition
            .instances
            .iter()
            .any(|instance| !instance.shape.is_plain() && self.unrolled.contains(&key_of(&key, instance)));
        let mut split = vec![None; definition.nodes.len()];
        if splits {
            for (index, node) in definition.nodes.iter().enumerate() {
                split[index] = (!node.shape.is_plain()).then(|| {
                    let ids: Vec<u32> = (0..node.shape.lanes()).map(|_| self.cell(lanes, node)).collect();
                    ids[0]
                });
            }
        }
        self.open.push_back(Body { module, key, scopes, lanes, base, split, inputs, clocks, children: Vec::new() });
        base
    }

    /// A cell for a node, whose kind is filled in later.
    fn cell(&mut self, lanes: u32, node: &Node) -> u32 {
        self.flat.program.circuit.push(Cell::new(Kind::State, lanes, node.width), Some(node.loc)).0
    }

    /// Fills in the cells of an instance and adds its state and names.
    fn body(&mut self, body: Body) {
        let module = self.design.module(body.module);
        let children = self.instances(&body, module);
        let body = &Body { children, ..body };
        let memories = self.state(body, module);
        for (index, node) in module.nodes.iter().enumerate() {
            let id = NodeId(index as u32);
            let kind = self.kind(body, module, node, &memories);
            self.flat.program.circuit.set_kind(body.whole(id), kind);
            if body.split[index].is_some() {
                self.split(body, id, node);
            }
        }
        self.name(body, module, &memories);
    }

    /// Adds registers, memories and asserts; returns the program's memory for each memory of the module.
    fn state(&mut self, body: &Body, module: &Module) -> Vec<u32> {
        let clock = |id: tilewright_hdl::ir::ClockId| body.clocks[id.0 as usize];
        for register in &module.registers {
            self.flat.program.registers.push(Register {
                value: body.whole(register.node),
                clock: clock(register.clock),
                reset: register.reset.clone(),
                enable: register.enable.map(|node| body.whole(node)),
                next: body.whole(register.next),
            });
        }
        for assert in &module.asserts {
            self.flat.program.asserts.push(Assert {
                clock: clock(assert.clock),
                condition: body.whole(assert.condition),
                message: assert.message.clone(),
                loc: assert.loc,
                scopes: body.scopes.clone(),
            });
        }
        let first = self.flat.program.memories.len() as u32;
        for memory in &module.memories {
            let reads = memory.reads.iter().filter_map(|read| {
                Some(ReadPort {
                    clock: clock(read.clock?),
                    address: body.whole(read.address),
                    enable: read.enable.map(|node| body.whole(node)),
                    value: body.whole(read.node),
                })
            });
            let writes = memory.writes.iter().map(|write| WritePort {
                clock: clock(write.clock),
                enable: body.whole(write.enable),
                address: body.whole(write.address),
                data: body.whole(write.data),
            });
            self.flat.program.memories.push(Memory {
                lanes: body.lanes,
                depth: memory.depth,
                width: memory.width,
                policy: memory.policy,
                contents: memory.contents.clone(),
                reads: reads.collect(),
                writes: writes.collect(),
            });
        }
        (first..first + module.memories.len() as u32).collect()
    }

    /// How a node's cell is computed, all lanes together.
    fn kind(&self, body: &Body, module: &Module, node: &Node, memories: &[u32]) -> Kind {
        let at = |id: &NodeId| body.whole(*id);
        let group = |of: &NodeId| module.node(*of).shape.lanes();
        match &node.op {
            Op::Input(index) => body.inputs.get(*index as usize).map_or(Kind::State, |&from| Kind::Alias(from)),
            Op::Const(bits) => Kind::Const(bits.clone()),
            Op::Unary(op, a) => Kind::Unary(*op, at(a)),
            Op::Binary(op, a, b) => Kind::Binary(*op, at(a), at(b)),
            Op::Compare { relation, signed, operands: [a, b] } => Kind::Compare(*relation, *signed, at(a), at(b)),
            Op::Shift(op, a, by) => Kind::Shift(*op, at(a), at(by)),
            Op::Mux { select, on_true, on_false } => {
                Kind::Mux { select: at(select), on_true: at(on_true), on_false: at(on_false) }
            }
            Op::Select { arms, default } => {
                Kind::Select { arms: arms.iter().map(|(c, v)| (at(c), at(v))).collect(), default: at(default) }
            }
            Op::Case { subject, arms, default } => Kind::Case {
                subject: at(subject),
                arms: arms.iter().map(|(key, v)| (key.clone(), at(v))).collect(),
                default: at(default),
            },
            Op::Slice { of, low } => Kind::Slice(at(of), *low),
            Op::Concat(parts) => Kind::Concat(parts.iter().map(at).collect()),
            Op::Repeat(of, times) => Kind::Repeat(at(of), *times),
            Op::Extend { of, signed } => Kind::Extend(at(of), *signed),
            Op::Register(_) => Kind::State,
            Op::Read(memory, port) => read_kind(body, module, *memory, *port, memories),
            Op::Wire(of) | Op::QuasiStatic(of, _) => Kind::Alias(at(of)),
            Op::Output(instance, port) => {
                let child = &module.instances[instance.0 as usize];
                let driver = self.design.module(child.module).outputs[*port as usize].node;
                let from = |base: &u32| ValueId(base + driver.0);
                match (child.shape.is_plain(), &body.children[instance.0 as usize]) {
                    (_, &Children::Sibling { base, lane, of }) => {
                        Kind::Lane { of: from(&base), axis: Axis::last(of), index: lane }
                    }
                    (false, Children::Bases(lanes)) if self.unrolled.contains(&key_of(&body.key, child)) => {
                        Kind::Stack { parts: lanes.iter().map(from).collect(), inner: 1 }
                    }
                    (_, Children::Bases(bases)) => Kind::Alias(from(&bases[0])),
                }
            }
            Op::Broadcast(of) => Kind::Broadcast { of: at(of), axis: Axis::last(node.shape.lanes()) },
            Op::PerLane(parts) => Kind::Stack { parts: parts.iter().map(at).collect(), inner: 1 },
            Op::Shifted { of, by, edge } => {
                let (of, axis, edge) = (at(of), Axis::last(group(of)), Some(at(edge)));
                Kind::Map { of, axis, count: axis.count, index: Affine::by(*by), edge }
            }
            Op::Lane(of, index) if body.split[of.0 as usize].is_some() => Kind::Alias(body.lane(*of, *index)),
            Op::Lane(of, index) => Kind::Lane { of: at(of), axis: Axis::last(group(of)), index: *index },
            Op::Reduce(by, of) => Kind::Reduce { by: *by, of: at(of), axis: Axis::last(group(of)) },
        }
    }

    /// Fills in the cells of a node's single lanes, which depend on no more than they have to.
    fn split(&mut self, body: &Body, id: NodeId, node: &Node) {
        let n = node.shape.lanes();
        for lane in 0..n {
            let kind = match &node.op {
                Op::Broadcast(of) => Kind::Alias(body.whole(*of)),
                Op::PerLane(parts) => Kind::Alias(body.whole(parts[lane as usize])),
                Op::Shifted { of, by, edge } => match lane.checked_add_signed(-by).filter(|&from| from < n) {
                    Some(from) => Kind::Alias(body.lane(*of, from)),
                    None => Kind::Alias(body.whole(*edge)),
                },
                _ => match &self.flat.program.circuit[body.whole(id)].kind {
                    Kind::Stack { parts, .. } => Kind::Alias(parts[lane as usize]),
                    _ => Kind::Lane { of: body.whole(id), axis: Axis::last(n), index: lane },
                },
            };
            self.flat.program.circuit.set_kind(body.lane(id, lane), kind);
        }
    }

    /// Enters the names of an instance's ports, registers, read data, nets and memories.
    fn name(&mut self, body: &Body, module: &Module, memories: &[u32]) {
        for id in &body.scopes {
            self.name_in(*id, body, module, memories);
        }
    }

    fn name_in(&mut self, id: ScopeId, body: &Body, module: &Module, memories: &[u32]) {
        let scope = &mut self.flat.program.hierarchy.scopes[id.0 as usize];
        scope.clocks = (module.clocks.iter().zip(&body.clocks))
            .map(|(ports, &clock)| ClockPort { port: ports.port.clone(), reset: ports.reset.clone(), clock })
            .collect();
        scope.memories =
            module.memories.iter().map(|memory| memory.name.clone()).zip(memories.iter().copied()).collect();
        scope.signals = signals(module, |node| body.whole(node));
    }
}

fn program_clock(clock: &tilewright_hdl::ir::Clock) -> Clock {
    Clock {
        name: clock.name.unwrap_or(&clock.port).to_string(),
        port: clock.port.clone(),
        reset: clock.reset.clone(),
        period: clock.period.expect("the clocks of a top have periods").picoseconds(),
        triggers: Triggers::NONE,
        registers: Vec::new(),
        reads: Vec::new(),
        writes: Vec::new(),
        asserts: Vec::new(),
    }
}

fn read_kind(body: &Body, module: &Module, memory: MemoryId, port: u32, memories: &[u32]) -> Kind {
    let read = &module.memories[memory.0 as usize].reads[port as usize];
    match read.clock {
        Some(_) => Kind::State,
        None => Kind::Read { memory: memories[memory.0 as usize], address: body.whole(read.address) },
    }
}

/// What of a module has a name in waves: ports first, then the data of synchronous reads (called `MEMORY_read`, or
/// `MEMORY_read0` and so on if there are several, where the description has no name for it), then the rest.
fn signals(module: &Module, value: impl Fn(NodeId) -> ValueId) -> Vec<Signal> {
    let mut all: Vec<Signal> = Vec::new();
    let mut taken = BTreeSet::new();
    let mut add = |name: String, role, node: NodeId| {
        if taken.insert(name.clone()) {
            let &Node { width, shape, .. } = module.node(node);
            let group = (!shape.is_plain()).then(|| shape.lanes());
            all.push(Signal { name, role, value: value(node), width, group, states: None });
        }
    };
    module.inputs.iter().for_each(|port| add(port.name.clone(), Role::Input, port.node));
    let is_register = |node: &Node| matches!(node.op, Op::Register(_));
    for port in &module.outputs {
        let node = module.node(port.node);
        let named_alike = is_register(node) && node.name.as_ref() == Some(&port.name);
        add(port.name.clone(), if named_alike { Role::Register } else { Role::Output }, port.node);
    }
    for memory in &module.memories {
        let synchronous: Vec<_> = memory.reads.iter().filter(|read| read.clock.is_some()).collect();
        for (index, read) in synchronous.iter().enumerate() {
            let number = if synchronous.len() > 1 { index.to_string() } else { String::new() };
            let named = module.node(read.node).name.clone();
            add(named.unwrap_or_else(|| format!("{}_read{number}", memory.name)), Role::ReadData, read.node);
        }
    }
    for (index, node) in module.nodes.iter().enumerate() {
        if let Some(name) = &node.name {
            let role = if is_register(node) { Role::Register } else { Role::Net };
            add(name.clone(), role, NodeId(index as u32));
        }
    }
    for register in &module.registers {
        let name = module.register_name(register);
        let named = all.iter_mut().filter(|signal| signal.value == value(register.node) || signal.name == name);
        named.for_each(|signal| signal.states = register.states.clone());
    }
    all
}
