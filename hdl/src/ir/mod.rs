//! The circuit: what elaboration makes of a description, and what simulators and printers read.
//!
//! A [`Design`] is a list of modules; each was elaborated once for its block type and parameters, however many
//! instances it has. A module is a graph of [`Node`]s, each an expression of a known width, with the objects of
//! the schematic (registers, memories, instances) beside it. Everything in a `Design` has passed the checks:
//! widths agree, every id leads somewhere, every wire is driven once, no combinational loop, every name unique and
//! legal in Verilog. Modules that were edited become a design again by [`Design::new`], which checks all of that.
//!
//! Every value has a [`Shape`]: plain, a row or a grid of lanes. Most operations are elementwise, so that one node stands
//! for as many gates as it has lanes; the lane operations of [`Op`] lead from one shape to another. Registers, memories,
//! instances and properties have lanes as their nodes have. Nothing is broadcast but by [`Op::Broadcast`].

mod affine;
mod kind;
pub(crate) mod latency;
mod op;
mod shape;
mod validate;

use crate::bits::Bits;
use crate::clock::Period;
use crate::loc::Loc;
use crate::problem::Problems;
use std::collections::BTreeMap;

pub use affine::Affine;
pub use kind::{Kind, Names};
pub use latency::Latency;
pub use op::{Binary, Op, Reduction, Relation, Shift, Unary};
pub use shape::Shape;

/// A whole circuit, which keeps every rule of this module: its readers need not ask.
#[derive(Debug, Clone)]
pub struct Design {
    modules: Vec<Module>,
}

/// A module's place in [`Design::modules`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct ModuleId(pub u32);

/// A node's place in [`Module::nodes`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct NodeId(pub u32);

/// A clock's place in [`Module::clocks`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct ClockId(pub u32);

/// A register's place in [`Module::registers`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct RegisterId(pub u32);

/// A memory's place in [`Module::memories`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct MemoryId(pub u32);

/// An instance's place in [`Module::instances`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct InstanceId(pub u32);

/// One module definition.
#[derive(Debug, Clone)]
pub struct Module {
    /// Its name in Verilog, unique in the design.
    pub name: String,
    /// What it is, for people.
    pub about: About,
    /// The block's parameters as Rust prints them, such as `Counter { width: 8 }`.
    pub parameters: String,
    /// Where the block is described.
    pub loc: Loc,
    /// The clocks it uses, the default clock first if it uses that one.
    pub clocks: Vec<Clock>,
    /// Input ports, in order of declaration.
    pub inputs: Vec<Input>,
    /// Output ports, in order of declaration.
    pub outputs: Vec<Output>,
    /// The expressions.
    pub nodes: Vec<Node>,
    /// The registers.
    pub registers: Vec<Register>,
    /// The memories.
    pub memories: Vec<Memory>,
    /// The instances and instance arrays.
    pub instances: Vec<Instance>,
    /// What is stated of it.
    pub properties: Vec<Property>,
}

/// A block's description in words, carried into the Verilog header and the documentation.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct About {
    /// What the block does, one or a few sentences.
    pub summary: String,
    /// Clocks from an input to the output it causes: words, where it is not one number, and how often it can begin. Where it is one,
    /// [`Design::latencies`] counts it; a number that stands here all the same, such as `4`, has to be that one.
    pub latency: String,
    /// The paper and the rule, such as `VC-1, section 3.3 (VC1-MU)`.
    pub source: String,
    /// What the inputs stand for, and the records of inputs, by their paths, such as `scan` and `scan.enable`; what is in
    /// a list has no number.
    pub inputs: BTreeMap<String, String>,
    /// What the outputs stand for, likewise.
    pub outputs: BTreeMap<String, String>,
}

/// A clock port of a module, and the reset that goes with it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Clock {
    /// The clock port's name in Verilog: `clk` for the default clock, `NAME_clk` for a named one.
    pub port: String,
    /// The reset port's name, `rst` or `NAME_rst`; `None` if nothing on this clock has a reset.
    pub reset: Option<String>,
    /// `None` for the default clock of a module that takes whatever clock its instance is given. At the top of a
    /// design every clock has a period.
    pub period: Option<Period>,
    /// `None` for the default clock, otherwise the clock's name.
    pub name: Option<&'static str>,
}

/// An input port.
#[derive(Debug, Clone)]
pub struct Input {
    /// The port's name: the path of the bundle's fields joined by `_`.
    pub name: String,
    /// The path in the bundle, such as `left.z`.
    pub path: String,
    /// The [`Op::Input`] node.
    pub node: NodeId,
    /// The clock that its values are synchronous to; `None` in a module without clocks.
    pub clock: Option<ClockId>,
}

/// An output port.
#[derive(Debug, Clone)]
pub struct Output {
    /// The port's name: the path of the bundle's fields joined by `_`.
    pub name: String,
    /// The path in the bundle, such as `pixel.z`.
    pub path: String,
    /// What drives it.
    pub node: NodeId,
    /// What its bits stand for, whatever those of its driver do.
    pub kind: Kind,
}

/// An expression of a known width.
#[derive(Debug, Clone)]
pub struct Node {
    /// How it is computed.
    pub op: Op,
    /// Its width in bits, in one lane: 1 to 1,048,576.
    pub width: u32,
    /// Its lanes, each of that width; plain without.
    pub shape: Shape,
    /// What the bits of a lane stand for.
    pub kind: Kind,
    /// The name that the description gave it; unique in the module, legal in Verilog and VCD. Inputs and registers
    /// always have one.
    pub name: Option<String>,
    /// Where the description made it.
    pub loc: Loc,
}

/// What the lanes of a register hold after a reset.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Init {
    /// The same in every lane; of a plain register always so.
    Same(Bits),
    /// A value for each lane, in row-major order.
    Each(Vec<Bits>),
}

impl Init {
    /// The value of one lane, counted in row-major order.
    pub fn lane(&self, lane: u32) -> &Bits {
        match self {
            Init::Same(value) => value,
            Init::Each(values) => &values[lane as usize],
        }
    }
}

/// A register, in each of its lanes. At an edge of its clock: `reset` if that clock's reset is high and there is a reset value; else `next`
/// if `enable` is absent or high; else unchanged.
#[derive(Debug, Clone)]
pub struct Register {
    /// The [`Op::Register`] node, which has the name, the width, the shape and the place.
    pub node: NodeId,
    /// Its clock.
    pub clock: ClockId,
    /// The value after a reset; `None` for a register that a reset does not touch.
    pub reset: Option<Init>,
    /// The value at power-on, the same in each lane; `None` if nothing may be relied on.
    pub initial: Option<Bits>,
    /// 1 bit, of the register's shape: whether it takes `next`; `None` means always.
    pub enable: Option<NodeId>,
    /// The value it takes.
    pub next: NodeId,
    /// Whether it is one of the two registers of a synchronizer, which a synthesizer is to keep as they are and close
    /// together: `ASYNC_REG` in Verilog.
    pub is_synchronizer: bool,
    /// For synthesizers.
    pub attributes: Vec<Attribute>,
}

/// What a read gives when its word is written at the same edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ReadUnderWrite {
    /// The word as it was before the edge.
    Old,
    /// Nothing that may be relied on; the cheapest memory on every FPGA. The simulator gives the old word inverted.
    Any,
}

/// What a memory holds at the start.
#[derive(Debug, Clone, PartialEq)]
pub enum Contents {
    /// Nothing that may be relied on.
    Unknown,
    /// The same word everywhere, in every lane.
    Fill(Bits),
    /// These words from address 0, in every lane; the rest is zero.
    Words(Vec<Bits>),
    /// For each lane, in row-major order, these words from address 0; the rest is zero. Not of a plain memory.
    Each(Vec<Vec<Bits>>),
}

/// A memory. At an edge every port on that clock samples at once; a later write port of the same clock wins over an
/// earlier one. A read beyond the depth gives zero, a write beyond it does nothing.
///
/// With a shape, every lane has words of its own. The address of a port is plain, the same for all lanes, or of the
/// memory's shape; so is an enable. Each port has it its own way. Where all addresses are plain, this is one memory of
/// wide words with a write mask for the lanes; else it is one memory a lane.
#[derive(Debug, Clone)]
pub struct Memory {
    /// Its name, unique in the module.
    pub name: String,
    /// The number of words.
    pub depth: u32,
    /// The width of a word in bits, in one lane.
    pub width: u32,
    /// Its lanes.
    pub shape: Shape,
    /// What a synchronous read gives when its word is written at the same edge.
    pub policy: ReadUnderWrite,
    /// What it holds at the start.
    pub contents: Contents,
    /// Read ports.
    pub reads: Vec<ReadPort>,
    /// Write ports.
    pub writes: Vec<WritePort>,
    /// For synthesizers.
    pub attributes: Vec<Attribute>,
    /// Where it is declared.
    pub loc: Loc,
}

/// A read port.
#[derive(Debug, Clone)]
pub struct ReadPort {
    /// `Some` for a synchronous port: the data is a register that takes the word at the edge. `None`: asynchronous.
    pub clock: Option<ClockId>,
    /// The address, of [`index_width`](crate::index_width)`(depth)` bits; plain or of the memory's shape.
    pub address: NodeId,
    /// 1 bit, plain or of the memory's shape: a synchronous port keeps its data where this is low; `None` means always
    /// reading.
    pub enable: Option<NodeId>,
    /// The [`Op::Read`] node, of the memory's shape.
    pub node: NodeId,
}

/// A write port.
#[derive(Debug, Clone)]
pub struct WritePort {
    /// Its clock.
    pub clock: ClockId,
    /// 1 bit, plain or of the memory's shape: whether it writes.
    pub enable: NodeId,
    /// The address, as wide as those of the read ports; plain or of the memory's shape.
    pub address: NodeId,
    /// The word, of the memory's shape.
    pub data: NodeId,
}

/// An instance, or an array of instances that differ only in what their lanes are fed.
#[derive(Debug, Clone)]
pub struct Instance {
    /// Its name, unique in the module, such as `u_merger`.
    pub name: String,
    /// What it is an instance of.
    pub module: ModuleId,
    /// The array's lanes, at least 1; plain for a single instance.
    pub shape: Shape,
    /// What drives the inputs, in the order of the child's ports; of the array's shape beside that of the port.
    pub inputs: Vec<NodeId>,
    /// The [`Op::Output`] nodes, in the order of the child's ports.
    pub outputs: Vec<NodeId>,
    /// For each clock of the child, the clock of this module that drives it.
    pub clocks: Vec<ClockId>,
    /// Where it is made.
    pub loc: Loc,
}

/// A statement about a condition, in every lane, at every edge of its clock while that clock's reset is low.
#[derive(Debug, Clone)]
pub struct Property {
    /// What is stated.
    pub directive: Directive,
    /// Its clock.
    pub clock: ClockId,
    /// 1 bit, of any shape.
    pub condition: NodeId,
    /// What is wrong if it does not hold; of a cover, what it is that happens.
    pub message: String,
    /// Where it is stated.
    pub loc: Loc,
}

/// What a [`Property`] states of its condition.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Directive {
    /// It always holds; if not, the circuit is wrong.
    Assert,
    /// It always holds; if not, what the inputs are given is wrong.
    Assume,
    /// It holds at some time.
    Cover,
}

/// An attribute for synthesizers, as Verilog's `(* ram_style = "block" *)`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Attribute {
    /// The name, a plain identifier.
    pub name: String,
    /// The value, a text.
    pub value: String,
}

impl Node {
    /// A node without a name, whose bits are a number.
    pub fn new(op: Op, width: u32, shape: Shape, loc: Loc) -> Node {
        Node { op, width, shape, kind: Kind::Number, name: None, loc }
    }
}

impl Design {
    /// The design of these modules, children before the modules that instantiate them; the top is the last.
    ///
    /// # Errors
    ///
    /// Every rule that the modules break, each at the place that the part in question was described.
    #[track_caller]
    pub fn new(modules: Vec<Module>) -> Result<Design, Problems> {
        let problems = validate::validate(&modules);
        if problems.is_empty() { Ok(Design { modules }) } else { Err(Problems(problems)) }
    }

    /// The modules, children before the modules that instantiate them; the top is the last.
    pub fn modules(&self) -> &[Module] {
        &self.modules
    }

    /// The modules, to be edited; [`Design::new`] makes a design of them again.
    pub fn into_modules(self) -> Vec<Module> {
        self.modules
    }

    /// The module that is not instantiated by another.
    pub fn top(&self) -> &Module {
        self.modules.last().expect("a design has a top module")
    }

    /// The module of that id.
    pub fn module(&self, id: ModuleId) -> &Module {
        &self.modules[id.0 as usize]
    }
}

impl Module {
    /// The node of that id.
    pub fn node(&self, id: NodeId) -> &Node {
        &self.nodes[id.0 as usize]
    }

    /// The width of a node in bits, in one lane.
    pub fn width(&self, id: NodeId) -> u32 {
        self.node(id).width
    }

    /// The shape of a node.
    pub fn shape(&self, id: NodeId) -> Shape {
        self.node(id).shape
    }

    /// The name of a register: its node's.
    pub fn register_name(&self, register: &Register) -> &str {
        self.node(register.node).name.as_deref().expect("a register has a name")
    }
}
