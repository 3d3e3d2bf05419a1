//! A module under construction.

use crate::clock::OwnClock;
use crate::enabled::{EnabledPart, PartId};
use crate::in_place_of::{OwnPeriod, Renamed};
use crate::names::port_name;
use crate::port_names::{PortNames, named};
use crate::stages::Pipelines;
use crate::stream::{DraftStream, Sent};
use std::collections::{BTreeMap, BTreeSet, HashMap};
use tilewright_circuit::ir::*;
use tilewright_circuit::{Bits, Clock, Loc, Reset};

/// The declarations of a description so far. Parts that may still be missing are `Option`s here and plain in
/// [`Module`].
pub(crate) struct Draft {
    /// Tells this module's handles from those of others.
    pub serial: u32,
    pub block: &'static str,
    /// The place of the block's declaration, if known.
    pub declared: Option<Loc>,
    pub loc: Loc,
    /// How the default clock resets, and at which edge it acts.
    pub own: OwnClock,
    /// The clocks used so far; the first is the default clock, `None`.
    pub clocks: Vec<Option<Clock>>,
    pub clock_used: Vec<bool>,
    pub inputs: Vec<Input>,
    pub input_clocks: Vec<Option<Clock>>,
    pub nodes: Vec<Node>,
    pub registers: Vec<DraftRegister>,
    pub wires: Vec<DraftWire>,
    /// The streams that begin here, by the node of their `ready`.
    pub streams: BTreeMap<NodeId, DraftStream>,
    /// The streams that are offered here and sent to the parent.
    pub sent: Vec<Sent>,
    pub memories: Vec<DraftMemory>,
    pub instances: Vec<Instance>,
    /// The enabled part that each instance is in.
    pub instance_parts: Vec<Option<PartId>>,
    /// The names of each instance's output ports.
    pub instance_outputs: Vec<Vec<String>>,
    pub properties: Vec<DraftProperty>,
    /// The records that are packed into words, each once.
    pub records: Vec<Record>,
    /// The place of each cover, by its name.
    pub covers: HashMap<String, Loc>,
    /// The registers of past values, by their signals.
    pub pasts: BTreeMap<(NodeId, ClockId, Option<PartId>), NodeId>,
    /// The subjects of choices by code.
    pub chosen: Vec<(NodeId, Option<PartId>, Loc)>,
    pub synchronizers: Vec<Synchronizer>,
    pub pipelines: Pipelines,
    /// Inputs that the description says it leaves unused.
    pub ignored: BTreeSet<NodeId>,
    /// Fields of the payloads that instances send: the word of each, the field, and its path.
    pub unpacked: Vec<(NodeId, NodeId, String)>,
    /// Operands of faulty expressions. The circuit has only a stand-in of such an expression.
    pub in_problems: BTreeSet<NodeId>,
    /// The stand-ins for faulty objects, whose problems have been reported, and the values computed from them. No
    /// further problem with them is reported. Registers and wires are declared, so their values do not count as
    /// computed.
    pub stand_ins: BTreeSet<NodeId>,
    /// The names that the description gives to ports.
    pub port_names: PortNames,
    /// The module of somebody else for which this one is a model.
    pub foreign: Option<Foreign>,
    /// Whether it is a pad.
    pub is_pad: bool,
    /// Where the description says that there is no model.
    pub unmodelled: Option<Loc>,
    /// What [`Module::within`](crate::Module::within) puts before the names that are declared now.
    pub prefix: String,
    /// The clocks that run in place of others now, the innermost last.
    pub renamed: Vec<Renamed>,
    /// The clocks whose registers begin with values at power-on, whatever their descriptions say.
    pub by_power_on: Vec<&'static str>,
    /// The clocks in whose place the module's own runs, here or in an instance.
    pub own_periods: Vec<OwnPeriod>,
    /// The parts that [`Module::enabled`](crate::Module::enabled) made, each after the one around it.
    pub parts: Vec<EnabledPart>,
    /// The part that is being described.
    pub part: Option<PartId>,
    /// The clocks on which the instance of this module is in an enabled part: `None` for the module's own.
    pub gated: Vec<Option<&'static str>>,
    /// Those of them on which something runs here, with the inputs that enable it.
    pub enables: Vec<(ClockId, NodeId)>,
}

pub(crate) struct DraftRegister {
    pub node: NodeId,
    pub clock: ClockId,
    pub part: Option<PartId>,
    pub reset: Option<(Init, Loc)>,
    pub enable: Option<(NodeId, Loc)>,
    pub next: Option<(NodeId, Loc)>,
    pub initial: Option<(Bits, Loc)>,
    pub is_synchronizer: bool,
    pub attributes: Vec<Attribute>,
}

impl DraftRegister {
    /// A register about which nothing is stated yet.
    pub fn new(node: NodeId, clock: ClockId, part: Option<PartId>) -> DraftRegister {
        let (reset, initial, enable, next) = (None, None, None, None);
        let (is_synchronizer, attributes) = (false, Vec::new());
        DraftRegister { node, clock, part, reset, initial, enable, next, is_synchronizer, attributes }
    }
}

pub(crate) struct DraftProperty {
    pub property: Property,
    pub part: Option<PartId>,
}

pub(crate) struct DraftWire {
    pub node: NodeId,
    pub driver: Option<(NodeId, Loc)>,
}

pub(crate) struct DraftMemory {
    pub memory: Memory,
    pub true_dual_port: bool,
    /// The stand-in, if the declaration is faulty.
    pub stand_in: Option<NodeId>,
    /// The places of the write ports.
    pub written: Vec<Loc>,
    /// The clock of the handle of each read port, which an asynchronous read does not use.
    pub read_clocks: Vec<Option<Clock>>,
    /// The enabled part that each read port is in.
    pub read_parts: Vec<Option<PartId>>,
    /// The enabled part that each write port is in.
    pub write_parts: Vec<Option<PartId>>,
}

/// A signal of another clock, and its synchronizer.
pub(crate) struct Synchronizer {
    pub name: String,
    pub enters: NodeId,
    pub loc: Loc,
}

/// The target of a wire until it is driven.
pub(crate) const UNDRIVEN: NodeId = NodeId(u32::MAX);

impl Draft {
    pub fn new(serial: u32, block: &'static str, own: OwnClock, loc: Loc) -> Draft {
        Draft {
            serial,
            block,
            declared: None,
            loc,
            own,
            clocks: vec![None],
            clock_used: vec![false],
            inputs: Vec::new(),
            input_clocks: Vec::new(),
            nodes: Vec::new(),
            registers: Vec::new(),
            wires: Vec::new(),
            streams: BTreeMap::new(),
            sent: Vec::new(),
            memories: Vec::new(),
            instances: Vec::new(),
            instance_parts: Vec::new(),
            instance_outputs: Vec::new(),
            properties: Vec::new(),
            records: Vec::new(),
            covers: HashMap::new(),
            pasts: BTreeMap::new(),
            chosen: Vec::new(),
            synchronizers: Vec::new(),
            pipelines: Pipelines::default(),
            ignored: BTreeSet::new(),
            unpacked: Vec::new(),
            in_problems: BTreeSet::new(),
            stand_ins: BTreeSet::new(),
            port_names: Vec::new(),
            foreign: None,
            is_pad: false,
            unmodelled: None,
            prefix: String::new(),
            renamed: Vec::new(),
            by_power_on: Vec::new(),
            own_periods: Vec::new(),
            parts: Vec::new(),
            part: None,
            gated: Vec::new(),
            enables: Vec::new(),
        }
    }

    /// The name of the port with this path in a bundle.
    pub fn port(&self, path: &str) -> String {
        let usual = || self.foreign.as_ref().map_or_else(|| port_name("", path), |foreign| foreign.port_called(path));
        named(&self.port_names, path).unwrap_or_else(usual)
    }

    /// The name of the port of a clock.
    pub fn clock_port(&self, clock: Option<Clock>) -> String {
        let given = self.foreign.as_ref().and_then(|foreign| foreign.clock_port(clock));
        let usual = clock.map_or("clk".to_owned(), |clock| format!("{}_clk", clock.name));
        given.map(str::to_owned).or_else(|| named(&self.port_names, &usual)).unwrap_or(usual)
    }

    /// The name of the port of a clock's reset; `None` if it has none.
    pub fn reset_port(&self, id: ClockId) -> Option<String> {
        let clock = self.clocks[id.0 as usize];
        let usual = self.reset_of(id).port(clock.map(|clock| clock.name))?;
        let given = self.foreign.as_ref().and_then(|foreign| foreign.reset_port(clock));
        Some(given.map(str::to_owned).or_else(|| named(&self.port_names, &usual)).unwrap_or(usual))
    }

    /// The name with the prefix of the part that is being described.
    pub fn prefixed(&self, name: &str) -> String {
        if self.prefix.is_empty() { name.to_owned() } else { format!("{}_{name}", self.prefix) }
    }

    pub fn add(&mut self, op: Op, width: u32, shape: Shape, loc: Loc) -> NodeId {
        let id = NodeId(self.nodes.len() as u32);
        if !self.stand_ins.is_empty() {
            let mut follows = false;
            op.for_each_operand(|operand| follows |= self.stand_ins.contains(&operand));
            if follows {
                self.stand_ins.insert(id);
            }
        }
        self.nodes.push(Node::new(op, width, shape, loc));
        id
    }

    pub fn node(&self, id: NodeId) -> &Node {
        &self.nodes[id.0 as usize]
    }

    pub fn node_mut(&mut self, id: NodeId) -> &mut Node {
        &mut self.nodes[id.0 as usize]
    }

    /// The node as a value of this kind, in waves and Verilog too: itself, or a new node beside it.
    pub fn seen_as(&mut self, id: NodeId, kind: Kind, loc: Loc) -> NodeId {
        let node = self.node(id);
        if node.kind == kind {
            return id;
        }
        let op = if let Op::Const(_) = node.op { node.op.clone() } else { Op::Wire(id) };
        let seen = self.add(op, node.width, node.shape, loc);
        self.node_mut(seen).kind = kind;
        if self.stand_ins.contains(&id) {
            self.stand_ins.insert(seen);
        }
        seen
    }

    /// A plain node, repeated in each lane of a shape.
    pub fn spread(&mut self, mut node: NodeId, shape: Shape, loc: Loc) -> NodeId {
        let width = self.node(node).width;
        if let Shape::Grid(_, columns) = shape {
            node = self.add(Op::Broadcast { of: node, axis: 0 }, width, Shape::Row(columns), loc);
        }
        if shape.is_plain() { node } else { self.add(Op::Broadcast { of: node, axis: 0 }, width, shape, loc) }
    }

    /// The node, repeated in the lanes of a shape if it is plain.
    pub fn in_shape(&mut self, node: NodeId, shape: Shape, loc: Loc) -> NodeId {
        if self.node(node).shape == shape { node } else { self.spread(node, shape, loc) }
    }

    /// Two nodes in the lanes of one of them: a plain one is the same in all lanes of the other.
    pub fn alike(&mut self, nodes: [NodeId; 2], loc: Loc) -> ([NodeId; 2], Shape) {
        let shape = self.shape_of_both(nodes);
        (nodes.map(|node| self.in_shape(node, shape, loc)), shape)
    }

    /// The shape of two nodes of which one may be plain.
    pub fn shape_of_both(&self, nodes: [NodeId; 2]) -> Shape {
        let [first, second] = nodes.map(|node| self.node(node).shape);
        if first.is_plain() { second } else { first }
    }

    /// The index of a clock in this module; a new clock is added.
    pub fn clock(&mut self, clock: Option<Clock>) -> ClockId {
        let found = self.clocks.iter().position(|known| match (known, &clock) {
            (None, None) => true,
            (Some(a), Some(b)) => a.name == b.name,
            _ => false,
        });
        let index = found.unwrap_or_else(|| {
            self.clocks.push(clock);
            self.clock_used.push(false);
            self.clocks.len() - 1
        });
        ClockId(index as u32)
    }

    /// Like [`Draft::clock`], for an object that runs on the clock.
    pub fn use_clock(&mut self, clock: Option<Clock>) -> ClockId {
        let id = self.clock(clock);
        self.clock_used[id.0 as usize] = true;
        id
    }

    /// How a clock resets.
    pub fn reset_of(&self, id: ClockId) -> Reset {
        self.clocks[id.0 as usize].map_or(self.own.reset, |clock| self.as_it_resets(clock).reset)
    }

    /// Whether one of the nodes is a stand-in or is computed from one.
    pub fn follows_a_problem(&self, nodes: &[NodeId]) -> bool {
        nodes.iter().any(|node| self.stand_ins.contains(node))
    }

    /// The name of a clock for messages.
    pub fn clock_name(&self, id: ClockId) -> &'static str {
        self.clocks[id.0 as usize].map_or("clk", |clock| clock.name)
    }
}
