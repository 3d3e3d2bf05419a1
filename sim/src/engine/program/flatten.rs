//! From modules and instances to one flat netlist. Instance arrays stay whole, unless they are to be unrolled.

use std::collections::{BTreeMap, BTreeSet, HashMap, VecDeque};

use tilewright_circuit::Edge;
use tilewright_circuit::ir::{self, Design, Instance, InstanceId, MemoryId, Module, ModuleId, Node, NodeId, Op};

use super::hierarchy::{Replication, Scope, ScopeId};
use super::instances::{Children, key_of};
use super::{Axis, Cell, Clock, Kind, Passes, Port, Program, Triggers, UnitId, ValueId};

/// A design made flat.
pub(super) struct Flat {
    /// Its cells in no particular sequence; nothing is scheduled.
    pub program: Program,
    /// The outputs of whole arrays, with the array of each.
    pub array_outputs: Vec<(ValueId, Key)>,
    /// The instances, with the cell of the first node of each.
    pub instances: Vec<(u32, ModuleId, Key)>,
}

/// An instance or an instance array, independent of the lane: the instances' names from the top down.
pub(super) type Key = Vec<String>;

/// Objects whose lanes depend on each other, so they are not evaluated at once.
#[derive(Default, PartialEq, Eq, Clone)]
pub(super) struct Unrolled {
    /// Arrays that become single instances.
    pub arrays: BTreeSet<Key>,
    /// Those arrays whose instances are units.
    pub apart: BTreeSet<Key>,
    /// Nodes whose lanes are computed separately, by their instance.
    pub nodes: BTreeMap<Key, BTreeSet<NodeId>>,
}

/// The design as cells, repeated `lanes` times.
pub(super) fn flatten(design: &Design, lanes: u32, unrolled: &Unrolled, passes: &Passes) -> Flat {
    let program = Program { passes: passes.clone(), ..Program::default() };
    let flat = Flat { program, array_outputs: Vec::new(), instances: Vec::new() };
    let mut flatten = Flatten {
        design,
        unrolled,
        flat,
        top_inputs: HashMap::new(),
        addresses: HashMap::new(),
        open: VecDeque::new(),
        units: 0,
    };
    flatten.top(lanes);
    while let Some(body) = flatten.open.pop_front() {
        flatten.body(body);
    }
    flatten.flat
}

pub(super) struct Flatten<'a> {
    pub(super) design: &'a Design,
    pub(super) unrolled: &'a Unrolled,
    pub(super) flat: Flat,
    /// The values that a testbench sets for the inputs of the top that have lanes.
    top_inputs: HashMap<NodeId, ValueId>,
    /// The address of each asynchronous read port, by memory of the program and port, in all lanes.
    pub(super) addresses: HashMap<(u32, u32), ValueId>,
    /// Instances whose cells have ids but are not filled in yet.
    open: VecDeque<Body>,
    /// The number of units so far.
    pub(super) units: u32,
}

/// An instance that is entered: see [`Body`].
pub(super) struct Entered {
    pub module: ModuleId,
    pub key: Key,
    pub scopes: Vec<ScopeId>,
    pub lanes: u32,
    pub unit: Option<UnitId>,
    pub inputs: Vec<ValueId>,
    pub clocks: Vec<u32>,
}

/// The inside of an instance.
pub(super) struct Body {
    pub(super) module: ModuleId,
    pub(super) key: Key,
    /// Its scope; several if it represents separate instances.
    pub(super) scopes: Vec<ScopeId>,
    pub(super) lanes: u32,
    /// The unit that it is in, or is.
    pub(super) unit: Option<UnitId>,
    /// The cell of the module's first node; the others follow.
    base: u32,
    /// The first of a node's cells for single lanes, if the node is unrolled.
    pub(super) split: Vec<Option<u32>>,
    /// The drivers of the inputs; empty for the top, whose inputs are state.
    inputs: Vec<ValueId>,
    /// The program's clock for each clock of the module.
    pub(super) clocks: Vec<u32>,
    children: Vec<Children>,
}

impl Body {
    pub(super) fn whole(&self, node: NodeId) -> ValueId {
        ValueId(self.base + node.0)
    }
}

impl Flatten<'_> {
    fn top(&mut self, lanes: u32) {
        let module = self.design.top();
        let id = ModuleId(self.design.modules().len() as u32 - 1);
        self.flat.program.clocks = module.clocks.iter().map(program_clock).collect();
        let clocks = (0..module.clocks.len() as u32).collect();
        let scope = self.scope(None, module.name.clone(), id, Replication::Single, lanes);
        let base = self.enter(Entered {
            module: id,
            key: Vec::new(),
            scopes: vec![scope],
            lanes,
            inputs: Vec::new(),
            clocks,
            unit: None,
        });
        let value = |node: NodeId| ValueId(base + node.0);
        for input in &module.inputs {
            let clock = input.clock.map_or(0, |clock| clock.0 as usize);
            let value = self.packed_input(module, input.node, value(input.node), lanes);
            let node = module.node(input.node);
            let (lanes, is_signed) = (node.shape.lanes(), node.kind == ir::Kind::Signed && node.shape.is_plain());
            self.flat.program.inputs.push(Port {
                name: input.name.clone(),
                path: input.path.clone(),
                value,
                lanes,
                is_signed,
                triggers: Triggers::inputs(clock),
            });
        }
        for output in &module.outputs {
            let value = self.packed_output(module.node(output.node), value(output.node), lanes);
            let shape = module.shape(output.node);
            let (lanes, is_signed) = (shape.lanes(), output.kind == ir::Kind::Signed && shape.is_plain());
            self.flat.program.outputs.push(Port {
                name: output.name.clone(),
                path: output.path.clone(),
                value,
                lanes,
                is_signed,
                triggers: Triggers::NONE,
            });
        }
    }

    /// The value that a testbench sets for an input of the top: all lanes side by side, the first in the lowest bits.
    fn packed_input(&mut self, module: &Module, id: NodeId, input: ValueId, lanes: u32) -> ValueId {
        let node = module.node(id);
        if node.shape.is_plain() {
            return input;
        }
        let circuit = &mut self.flat.program.circuit;
        let axis = Axis::last(node.shape.lanes());
        let port = circuit.push(Cell::new(Kind::State, lanes, node.width * axis.count), Some(node.loc));
        self.top_inputs.insert(id, port);
        port
    }

    /// The value that a testbench reads of an output of the top.
    fn packed_output(&mut self, node: &Node, of: ValueId, lanes: u32) -> ValueId {
        if node.shape.is_plain() {
            return of;
        }
        let axis = Axis::last(node.shape.lanes());
        let packed = Cell::new(Kind::Pack { of, axis }, lanes, node.width * axis.count);
        self.flat.program.circuit.push(packed, Some(node.loc))
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
    pub(super) fn enter(&mut self, instance: Entered) -> u32 {
        let Entered { module, key, scopes, lanes, unit, inputs, clocks } = instance;
        let definition = self.design.module(module);
        let base = self.flat.program.circuit.len() as u32;
        for node in &definition.nodes {
            self.cell(lanes * node.shape.lanes(), node);
        }
        let is_unrolled = |instance: &Instance| self.unrolled.arrays.contains(&key_of(&key, instance));
        let splits = self.unrolled.nodes.contains_key(&key) || definition.instances.iter().any(is_unrolled);
        self.flat.instances.push((base, module, key.clone()));
        let mut split = vec![None; definition.nodes.len()];
        if splits {
            for (index, node) in definition.nodes.iter().enumerate() {
                split[index] = (!node.shape.is_plain()).then(|| {
                    let ids: Vec<u32> = (0..node.shape.lanes()).map(|_| self.cell(lanes, node)).collect();
                    ids[0]
                });
            }
        }
        self.open.push_back(Body {
            module,
            key,
            scopes,
            lanes,
            unit,
            base,
            split,
            inputs,
            clocks,
            children: Vec::new(),
        });
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
        for index in 0..module.nodes.len() {
            let id = NodeId(index as u32);
            let kind = self.kind(body, module, id, &memories);
            self.flat.program.circuit.set_kind(body.whole(id), kind);
            if body.split[index].is_some() {
                self.split(body, module, id, &memories);
            }
        }
        self.name(body, module, &memories);
    }

    /// The operation of a node's cell, for all lanes together.
    fn kind(&self, body: &Body, module: &Module, id: NodeId, memories: &[u32]) -> Kind {
        let node = module.node(id);
        let at = |id: &NodeId| body.whole(*id);
        let (own, theirs) =
            (|axis: u32| Axis::of(node.shape, axis), |of: NodeId, axis| Axis::of(module.node(of).shape, axis));
        match &node.op {
            _ if self.is_split(body, id) => {
                let first = body.split[id.0 as usize].expect("its lanes have cells");
                Kind::Stack { parts: (0..node.shape.lanes()).map(|lane| ValueId(first + lane)).collect(), inner: 1 }
            }
            Op::Input(index) => match (body.inputs.get(*index as usize), node.shape.is_plain()) {
                (Some(&from), _) => Kind::Alias(from),
                (None, true) => Kind::State,
                (None, false) => Kind::Unpack { of: self.top_inputs[&id], axis: Axis::last(node.shape.lanes()) },
            },
            Op::Register(_) => Kind::State,
            Op::Read(memory, port) => self.read_kind(module, *memory, *port, memories),
            Op::Output(instance, port) => self.output_kind(body, module, *instance, *port),
            Op::Broadcast { of, axis } => Kind::Broadcast { of: at(of), axis: own(*axis) },
            Op::Stack { parts, axis } => Kind::Stack { parts: parts.iter().map(at).collect(), inner: own(*axis).inner },
            Op::Map { of, axis, index, edge } => Kind::Map {
                of: at(of),
                axis: theirs(*of, *axis),
                count: own(*axis).count,
                index: *index,
                edge: edge.as_ref().map(at),
            },
            Op::Interleave { parts, axis } => {
                Kind::Interleave { parts: parts.iter().map(at).collect(), axis: theirs(parts[0], *axis) }
            }
            Op::Lane { of, index, .. } if node.shape.is_plain() && body.split[of.0 as usize].is_some() => {
                Kind::Alias(body.at(*of, *index))
            }
            Op::Lane { of, axis, index } => Kind::Lane { of: at(of), axis: theirs(*of, *axis), index: *index },
            Op::Pick { of, axis, index } => Kind::Pick { of: at(of), axis: theirs(*of, *axis), index: at(index) },
            Op::Reduce { by, of, axis } => Kind::Reduce { by: *by, of: at(of), axis: theirs(*of, *axis) },
            Op::Pack { of, axis } => Kind::Pack { of: at(of), axis: theirs(*of, *axis) },
            Op::Unpack { of, axis } => Kind::Unpack { of: at(of), axis: own(*axis) },
            _ => elementwise(node, at),
        }
    }

    /// The output of an instance.
    fn output_kind(&self, body: &Body, module: &Module, instance: InstanceId, port: u32) -> Kind {
        let child = &module.instances[instance.0 as usize];
        let definition = self.design.module(child.module);
        let driver = definition.outputs[port as usize].node;
        let inner = definition.node(driver).shape.lanes();
        let from = |base: &u32| ValueId(base + driver.0);
        match (child.shape.is_plain(), &body.children[instance.0 as usize]) {
            (_, &Children::Sibling { base, lane, of }) => {
                Kind::Lane { of: from(&base), axis: Axis { count: of, inner }, index: lane }
            }
            (false, Children::Bases(lanes)) if self.unrolled.arrays.contains(&key_of(&body.key, child)) => {
                Kind::Stack { parts: lanes.iter().map(from).collect(), inner }
            }
            (_, Children::Bases(bases)) => Kind::Alias(from(&bases[0])),
        }
    }

    /// The data of a memory's read port.
    fn read_kind(&self, module: &Module, memory: MemoryId, port: u32, memories: &[u32]) -> Kind {
        let read = &module.memories[memory.0 as usize].reads[port as usize];
        let memory = memories[memory.0 as usize];
        match read.clock {
            Some(_) => Kind::State,
            None => Kind::Read { memory, address: self.addresses[&(memory, port)] },
        }
    }
}

/// An elementwise operation.
pub(super) fn elementwise(node: &Node, at: impl Fn(&NodeId) -> ValueId) -> Kind {
    match &node.op {
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
        Op::Wire(of) | Op::QuasiStatic(of, _) => Kind::Alias(at(of)),
        op => unreachable!("not elementwise: {op:?}"),
    }
}

fn program_clock(clock: &tilewright_circuit::ir::Clock) -> Clock {
    Clock {
        name: clock.name.unwrap_or(&clock.port).to_string(),
        port: clock.port.clone(),
        reset: clock.reset.clone(),
        kind: clock.kind,
        falls: clock.edge == Edge::Falling,
        period: clock.period.expect("the clocks of a top have periods").picoseconds(),
        triggers: Triggers::NONE,
        registers: Vec::new(),
        reads: Vec::new(),
        writes: Vec::new(),
        asserts: Vec::new(),
    }
}
