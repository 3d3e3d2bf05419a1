//! A module under construction.

use crate::bits::Bits;
use crate::clock::Clock;
use crate::enabled::{EnabledPart, PartId};
use crate::in_place_of::{OwnPeriod, Renamed};
use crate::ir::*;
use crate::loc::Loc;
use crate::module::port_name;
use crate::reset::Reset;
use crate::stages::Pipelines;
use crate::stream::{DraftStream, Sent};
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// The declarations of a description so far. Parts that may still be missing are `Option`s here and plain in
/// [`Module`].
pub(crate) struct Draft {
    /// Tells this module's handles from those of others.
    pub serial: u32,
    pub block: &'static str,
    /// The place of the block's declaration, if known.
    pub declared: Option<Loc>,
    pub loc: Loc,
    /// How the default clock resets.
    pub reset: Reset,
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
    /// Operands of faulty expressions. The circuit has only a stand-in of such an expression.
    pub in_problems: BTreeSet<NodeId>,
    /// The stand-ins for faulty objects, whose problems have been reported, and the values computed from them. No
    /// further problem with them is reported. Registers and wires are declared, so their values do not count as
    /// computed.
    pub stand_ins: BTreeSet<NodeId>,
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
    pub fn new(serial: u32, block: &'static str, reset: Reset, loc: Loc) -> Draft {
        Draft {
            serial,
            block,
            declared: None,
            loc,
            reset,
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
            covers: HashMap::new(),
            pasts: BTreeMap::new(),
            chosen: Vec::new(),
            synchronizers: Vec::new(),
            pipelines: Pipelines::default(),
            ignored: BTreeSet::new(),
            in_problems: BTreeSet::new(),
            stand_ins: BTreeSet::new(),
            foreign: None,
            is_pad: false,
            unmodelled: None,
            prefix: String::new(),
            renamed: Vec::new(),
            own_periods: Vec::new(),
            parts: Vec::new(),
            part: None,
            gated: Vec::new(),
            enables: Vec::new(),
        }
    }

    /// The name of the port with this path in a bundle.
    pub fn port(&self, path: &str) -> String {
        self.foreign.as_ref().map_or_else(|| port_name("", path), |foreign| foreign.port_called(path))
    }

    /// The name of the port of a clock.
    pub fn clock_port(&self, clock: Option<Clock>) -> String {
        let given = self.foreign.as_ref().and_then(|foreign| foreign.clock_port(clock));
        given.map_or_else(|| clock.map_or("clk".to_owned(), |clock| format!("{}_clk", clock.name)), str::to_owned)
    }

    /// The name of the port of a clock's reset; `None` if it has none.
    pub fn reset_port(&self, id: ClockId) -> Option<String> {
        let clock = self.clocks[id.0 as usize];
        let port = self.reset_of(id).port(clock.map(|clock| clock.name))?;
        let given = self.foreign.as_ref().and_then(|foreign| foreign.reset_port(clock));
        Some(given.map_or(port, str::to_owned))
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
        self.clocks[id.0 as usize].map_or(self.reset, |clock| clock.reset)
    }

    /// Whether one of the nodes is a stand-in or is computed from one.
    pub fn follows_a_problem(&self, nodes: &[NodeId]) -> bool {
        nodes.iter().any(|node| self.stand_ins.contains(node))
    }

    /// The name of a clock for messages.
    pub fn clock_name(&self, id: ClockId) -> &'static str {
        self.clocks[id.0 as usize].map_or("clk", |clock| clock.name)
    }

    /// A node in the words of the description: its name, or its expression, shortened.
    pub fn describe(&self, id: NodeId) -> String {
        self.describe_to(id, 3)
    }

    fn describe_to(&self, id: NodeId, depth: u32) -> String {
        let node = self.node(id);
        if let Some(name) = &node.name {
            return name.clone();
        }
        if depth == 0 {
            return "..".to_owned();
        }
        let say = |id: &NodeId| self.describe_to(*id, depth - 1);
        let list = |ids: &[NodeId]| ids.iter().map(say).collect::<Vec<_>>().join(", ");
        let inner = |id: &NodeId| match self.node(*id) {
            Node { name: None, op: Op::Binary(..) | Op::Compare { .. } | Op::Shift(..), .. } => {
                format!("({})", say(id))
            }
            _ => say(id),
        };
        match &node.op {
            Op::Input(index) => self.inputs[*index as usize].name.clone(),
            Op::Const(value) => constant_text(value, node.kind),
            Op::Unary(Unary::Not, a) => format!("!{}", inner(a)),
            Op::Unary(Unary::AllOnes, a) => format!("{}.all_ones()", inner(a)),
            Op::Unary(Unary::AnyOne, a) => format!("{}.any_one()", inner(a)),
            Op::Unary(Unary::Parity, a) => format!("{}.parity()", inner(a)),
            Op::Binary(op, a, b) => format!("{} {} {}", inner(a), op.symbol(), inner(b)),
            Op::Compare { relation, operands: [a, b], .. } => format!("{}.{}({})", inner(a), relation.method(), say(b)),
            Op::Shift(op, a, b) => format!("{} {} {}", inner(a), op.symbol(), inner(b)),
            Op::Mux { select, on_true, on_false } => format!("mux({})", list(&[*select, *on_true, *on_false])),
            Op::Select { .. } => "select(..)".to_owned(),
            Op::Case { subject, .. } => format!("case({}, ..)", say(subject)),
            Op::Slice { of, low } if node.width == 1 => format!("{}.bit({low})", inner(of)),
            Op::Slice { of, low } => format!("{}.slice({low}..{})", inner(of), low + node.width),
            Op::Concat(parts) => format!("cat![{}]", list(parts)),
            Op::Repeat(a, n) => format!("{}.repeat({n})", inner(a)),
            Op::Extend { of, signed: false } => format!("{}.zext({})", inner(of), node.width),
            Op::Extend { of, signed: true } => format!("{}.sext({})", inner(of), node.width),
            Op::Read(memory, _) => format!("{}.read(..)", self.memories[memory.0 as usize].memory.name),
            Op::Output(instance, port) => {
                let index = instance.0 as usize;
                format!("{}.{}", self.instances[index].name, self.instance_outputs[index][*port as usize])
            }
            // Of all wires without a driver, only that of a stream has no name.
            Op::Wire(UNDRIVEN) => "ready".to_owned(),
            Op::QuasiStatic(a, _) | Op::Wire(a) => say(a),
            Op::Broadcast { of, .. } => format!("{}.of(..)", inner(of)),
            Op::Stack { .. } => "stack(..)".to_owned(),
            Op::Map { of, index: Affine { mul: 1, add, div: 1 }, .. } => {
                format!("{}.shifted({}, ..)", inner(of), -i64::from(*add))
            }
            Op::Map { of, .. } => format!("{}.take(..)", inner(of)),
            Op::Interleave { .. } => "interleave(..)".to_owned(),
            Op::Lane { of, index, .. } => format!("{}.lane({index})", inner(of)),
            Op::Pick { of, index, .. } => format!("{}.pick({})", inner(of), say(index)),
            Op::Reduce { by, of, .. } => format!("{}.{}()", inner(of), by.method()),
            Op::Pack { of, .. } => format!("{}.pack()", inner(of)),
            Op::Unpack { of, .. } => format!("{}.unpack()", inner(of)),
            Op::Register(_) => match self.pasts.iter().find(|(_, past)| **past == id) {
                Some(((of, ..), _)) => format!("past({})", say(of)),
                None => "a register".to_owned(),
            },
        }
    }
}

/// A constant as a description writes it: a code by its name, a signed number with its sign.
fn constant_text(value: &Bits, kind: Kind) -> String {
    let code = |names: Names| Some(format!("{}::{}", names.of, names.name(value.to_u64()?)?));
    let text = match kind {
        Kind::Code(names) => code(names),
        Kind::Signed => value.to_i128().map(|number| number.to_string()),
        Kind::Number => None,
    };
    text.or_else(|| value.to_u64().map(|number| number.to_string())).unwrap_or_else(|| value.to_string())
}

impl Binary {
    /// The operator as Rust writes it.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// assert_eq!([ir::Binary::Add, ir::Binary::MulSigned].map(ir::Binary::symbol), ["+", "*"]);
    /// ```
    pub fn symbol(self) -> &'static str {
        match self {
            Binary::And => "&",
            Binary::Or => "|",
            Binary::Xor => "^",
            Binary::Add => "+",
            Binary::Sub => "-",
            Binary::Mul | Binary::MulSigned => "*",
        }
    }
}

impl Shift {
    /// The operator as Rust writes it.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// // The operand decides whether `>>` is signed, so both right shifts have one operator.
    /// assert_eq!([ir::Shift::Right, ir::Shift::RightSigned].map(ir::Shift::symbol), [">>", ">>"]);
    /// ```
    pub fn symbol(self) -> &'static str {
        match self {
            Shift::Left => "<<",
            Shift::Right | Shift::RightSigned => ">>",
        }
    }
}

impl Reduction {
    /// The method's name.
    fn method(self) -> &'static str {
        match self {
            Reduction::And => "and_all",
            Reduction::Or => "or_all",
            Reduction::Xor => "xor_all",
            Reduction::Add => "sum",
            Reduction::Min => "minimum",
            Reduction::Max => "maximum",
        }
    }
}

impl Relation {
    /// The method's name.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// assert_eq!([ir::Relation::Lt, ir::Relation::Ge].map(ir::Relation::method), ["lt", "ge"]);
    /// ```
    pub fn method(self) -> &'static str {
        match self {
            Relation::Eq => "eq",
            Relation::Ne => "ne",
            Relation::Lt => "lt",
            Relation::Le => "le",
            Relation::Gt => "gt",
            Relation::Ge => "ge",
        }
    }
}
