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
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = tilewright_sim::shown! { |m, i| in { enable: bit() } out { count: bits(8) }
/// let count = m.reg("count", 8).reset(0);
/// count.when(i.enable, count + 1);
/// #     ShownOut { count: *count }
/// # };
/// // How many bits of state it has.
/// let bits = |module: &ir::Module| module.registers.iter().map(|register| module.width(register.node)).sum::<u32>();
/// assert_eq!(design.modules().iter().map(bits).sum::<u32>(), 8);
/// ```
#[derive(Debug, Clone)]
pub struct Design {
    modules: Vec<Module>,
}

/// A module's place in [`Design::modules`].
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = tilewright_sim::shown! { |m, i| in { word: bits(8) } out { late: bits(8) }
/// let late = m.pipe("late", i.word);
/// #     ShownOut { late }
/// # };
/// assert_eq!(design.module(ir::ModuleId(0)).name, design.top().name);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct ModuleId(pub u32);

/// A node's place in [`Module::nodes`].
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = tilewright_sim::shown! { |_, i| in { word: bits(8) } out { flipped: bits(8) }
/// let flipped = !i.word;
/// #     ShownOut { flipped }
/// # };
/// // Operands come first, but for those that close a loop through a register.
/// let top = design.top();
/// let ir::Op::Unary(_, operand) = top.node(top.outputs[0].node).op else { panic!("a `not`") };
/// assert!(operand < top.outputs[0].node);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct NodeId(pub u32);

/// A clock's place in [`Module::clocks`].
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = tilewright_sim::shown! { |m, i| in { word: bits(8) } out { late: bits(8) }
/// let late = m.pipe("late", i.word);
/// #     ShownOut { late }
/// # };
/// let top = design.top();
/// let ir::ClockId(clock) = top.registers[0].clock;
/// assert_eq!(top.clocks[clock as usize].port, "clk");
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct ClockId(pub u32);

/// A register's place in [`Module::registers`].
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = tilewright_sim::shown! { |m, i| in { word: bits(8) } out { late: bits(8) }
/// let late = m.pipe("late", i.word);
/// #     ShownOut { late }
/// # };
/// let top = design.top();
/// let node = top.node(top.registers[0].node);
/// assert_eq!(node.op, ir::Op::Register(ir::RegisterId(0)));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct RegisterId(pub u32);

/// A memory's place in [`Module::memories`].
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = tilewright_sim::shown! { |m, i| in { at: bits(4) } out { word: bits(8) }
/// let word = m.memory("table", 16, 8, ReadUnderWrite::Any).fill(Bits::zero(8)).read(i.at);
/// #     ShownOut { word }
/// # };
/// let top = design.top();
/// assert_eq!(top.node(top.outputs[0].node).op, ir::Op::Read(ir::MemoryId(0), 0)); // its first read port
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct MemoryId(pub u32);

/// An instance's place in [`Module::instances`].
///
/// ```
/// # use tilewright_hdl::*;
/// # block! {
/// #     struct Halver;
/// #     in HalverIn { word: bits(8) }
/// #     out HalverOut { half: bits(8) }
/// # }
/// # impl Halver {
/// #     fn build(&self, _: Module, i: HalverIn) -> HalverOut {
/// #         HalverOut { half: i.word >> 1 }
/// #     }
/// # }
/// # block! {
/// #     struct Chain;
/// #     in ChainIn { word: bits(8) }
/// #     out ChainOut { quarter: bits(8) }
/// # }
/// # impl Chain {
/// #     fn build(&self, m: Module, i: ChainIn) -> ChainOut {
/// let half = m.instance("u_half", &Halver, HalverIn { word: i.word }).half;
/// let quarter = m.instance("u_quarter", &Halver, HalverIn { word: half }).half;
/// #         ChainOut { quarter }
/// #     }
/// # }
/// # let design = elaborate(&Chain)?;
/// let top = design.top();
/// assert_eq!(top.node(top.outputs[0].node).op, ir::Op::Output(ir::InstanceId(1), 0)); // its first output
/// # Ok::<(), Problems>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct InstanceId(pub u32);

/// One module definition.
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = tilewright_sim::shown! { |m, i| in { enable: bit() } out { count: bits(8) }
/// let count = m.reg("count", 8).reset(0);
/// count.when(i.enable, count + 1);
/// #     ShownOut { count: *count }
/// # };
/// let module = design.top();
/// assert_eq!((&*module.inputs[0].name, &*module.outputs[0].name), ("enable", "count"));
/// assert_eq!(module.register_name(&module.registers[0]), "count");
/// ```
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
///
/// ```
/// # use tilewright_hdl::*;
/// block! {
///     /// Adds two bytes.
///     struct Adder;
///     source = "Shannon, 1938";
///     in AdderIn {
///         /// What is added to.
///         a: bits(8),
///         b: bits(8),
///     }
///     out AdderOut { sum: bits(8) }
/// }
/// # impl Adder {
/// #     fn build(&self, _: Module, i: AdderIn) -> AdderOut {
/// #         AdderOut { sum: i.a + i.b }
/// #     }
/// # }
///
/// let about = Adder.about();
/// assert_eq!((&*about.summary, &*about.source), ("Adds two bytes.", "Shannon, 1938"));
/// assert_eq!((&*about.inputs["a"], about.inputs.get("b")), ("What is added to.", None));
/// ```
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
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = tilewright_sim::shown! { |m, i| in { word: bits(8) } out { late: bits(8) }
/// let late = m.pipe("late", i.word);
/// #     ShownOut { late }
/// # };
/// let clock = &design.top().clocks[0];
/// assert_eq!((&*clock.port, clock.name), ("clk", None));
/// assert_eq!(clock.reset, None); // a register of a pipeline has no reset, so the module has no port for it
/// ```
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
///
/// ```
/// # use tilewright_hdl::*;
/// bundle! { struct Pixel<T> { z: T, rgb: T } }
/// # block! {
/// #     struct Shown;
/// in ShownIn { left: Pixel { z: bits(16), rgb: bits(24) } }
/// #     out ShownOut { depth: bits(16) }
/// # }
/// # impl Shown {
/// #     fn build(&self, m: Module, i: ShownIn) -> ShownOut {
/// #         m.ignore(&i.left.rgb);
/// #         ShownOut { depth: i.left.z }
/// #     }
/// # }
/// # let design = elaborate(&Shown)?;
///
/// let port = &design.top().inputs[1];
/// assert_eq!((&*port.name, &*port.path), ("left_rgb", "left.rgb"));
/// # Ok::<(), Problems>(())
/// ```
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
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = tilewright_sim::shown! { |_, i| in { word: bits(8) } out { same: bits(8).signed() }
/// let same = i.word.signed();
/// #     ShownOut { same }
/// # };
/// // No operation, but read in another way.
/// let (top, output) = (design.top(), &design.top().outputs[0]);
/// assert_eq!(output.node, top.inputs[0].node);
/// assert_eq!((output.kind, top.node(output.node).kind), (ir::Kind::Signed, ir::Kind::Number));
/// ```
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
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = tilewright_sim::shown! { |_, i| in { a: bits(8).of(row(4)), b: bits(8) } out { sum: _ }
/// net!(sum = i.a + i.b);
/// #     ShownOut { sum }
/// # };
/// // One node for four adders.
/// let node = design.top().node(design.top().outputs[0].node);
/// assert_eq!((node.name.as_deref(), node.width, node.shape), (Some("sum"), 8, row(4)));
/// ```
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
///
/// ```
/// # use tilewright_hdl::*;
/// # block! {
/// #     struct Shown;
/// #     out ShownOut { next: _ }
/// # }
/// # impl Shown {
/// #     fn build(&self, m: Module, _: ()) -> ShownOut {
/// let ring = m.reg("ring", bits(4).of(row(3))).reset_each([7, 8, 9]);
/// ring.next(ring.previous(ring.last()));
/// #         ShownOut { next: *ring }
/// #     }
/// # }
/// # let design = elaborate(&Shown)?;
/// let reset = design.top().registers[0].reset.as_ref();
/// assert_eq!(reset, Some(&ir::Init::Each([7, 8, 9].map(|value| Bits::new(4, value)).into())));
/// # Ok::<(), Problems>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Init {
    /// The same in every lane; of a plain register always so.
    Same(Bits),
    /// A value for each lane, in row-major order.
    Each(Vec<Bits>),
}

impl Init {
    /// The value of one lane, counted in row-major order.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// let zeros = ir::Init::Same(Bits::zero(8));
    /// assert_eq!(zeros.lane(100), &Bits::zero(8)); // of as many lanes as there may be
    /// ```
    pub fn lane(&self, lane: u32) -> &Bits {
        match self {
            Init::Same(value) => value,
            Init::Each(values) => &values[lane as usize],
        }
    }
}

/// A register, in each of its lanes. At an edge of its clock: `reset` if that clock's reset is high and there is a reset value; else `next`
/// if `enable` is absent or high; else unchanged.
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = tilewright_sim::shown! { |m, i| in { enable: bit() } out { count: bits(8) }
/// let count = m.reg("count", 8).reset(5);
/// count.enable(i.enable).next(count + 1);
/// #     ShownOut { count: *count }
/// # };
/// let (top, register) = (design.top(), &design.top().registers[0]);
/// assert_eq!(register.enable, Some(top.inputs[0].node));
/// assert_eq!(register.reset.as_ref().unwrap().lane(0), &Bits::new(8, 5));
/// ```
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
///
/// ```
/// # use tilewright_hdl::*;
/// # let example = tilewright_sim::traced(|m| {
/// let count = m.reg("count", 2).reset(0);
/// count.next(count + 1);
/// for (name, policy) in [("old", ReadUnderWrite::Old), ("any", ReadUnderWrite::Any)] {
///     let cell = m.memory(&format!("{name}_cell"), 1, 2, policy).fill(Bits::zero(2));
///     cell.write(lit(1, 1), 0, count);
///     let _ = cell.read(0).named(name);
/// }
/// # });
/// assert_eq!(example.values("old"), [0, 0, 0, 1, 2]);
/// // What relies on it is to fail its tests.
/// assert_eq!(example.values("any"), [0, 3, 3, 2, 1]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ReadUnderWrite {
    /// The word as it was before the edge.
    Old,
    /// Nothing that may be relied on; the cheapest memory on every FPGA. The simulator gives the old word inverted.
    Any,
}

/// What a memory holds at the start.
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = tilewright_sim::shown! { |m, i| in { at: bits(4) } out { square: bits(8) }
/// let squares = m.memory("squares", 16, 8, ReadUnderWrite::Any).words((0..3).map(|x| Bits::new(8, x * x)));
/// let square = squares.read(i.at);
/// #     ShownOut { square }
/// # };
/// let ir::Contents::Words(words) = &design.top().memories[0].contents else { panic!("words") };
/// assert_eq!(words.len(), 3); // as many as were given: the rest is zero without being said
/// ```
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
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = tilewright_sim::shown! { |m, i| in { at: bits(4), word: bits(8) } out { last_word: bits(8) }
/// let last = m.memory("last", 12, 8, ReadUnderWrite::Old).fill(Bits::zero(8));
/// last.write(i.at.lt(12), i.at, i.word);
/// let last_word = last.read(i.at);
/// #     ShownOut { last_word }
/// # };
/// let memory = &design.top().memories[0];
/// assert_eq!((memory.depth * memory.width, memory.reads.len(), memory.writes.len()), (96, 1, 1));
/// ```
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
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = tilewright_sim::shown! { |m, i| in { at: bits(4) } out { now: bits(8), later: bits(8) }
/// let table = m.memory("table", 16, 8, ReadUnderWrite::Any).fill(Bits::zero(8));
/// let (now, later) = (table.read_async(i.at), table.read(i.at));
/// #     ShownOut { now, later }
/// # };
/// let reads = &design.top().memories[0].reads;
/// assert!(reads[0].clock.is_none() && reads[1].clock.is_some());
/// ```
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
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = tilewright_sim::shown! { |m, i| in { at: bits(4), word: bits(8) } out { word_before: bits(8) }
/// let table = m.memory("table", 16, 8, ReadUnderWrite::Any).fill(Bits::zero(8));
/// table.write(lit(1, 1), i.at, i.word);
/// let word_before = table.read(3);
/// #     ShownOut { word_before }
/// # };
/// let (top, write) = (design.top(), &design.top().memories[0].writes[0]);
/// assert_eq!((write.address, write.data), (top.inputs[0].node, top.inputs[1].node));
/// ```
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
///
/// ```
/// # use tilewright_hdl::*;
/// # block! {
/// #     struct Cell;
/// #     in CellIn { left: bits(4) }
/// #     out CellOut { held: bits(4) }
/// # }
/// # impl Cell {
/// #     fn build(&self, m: Module, i: CellIn) -> CellOut {
/// #         CellOut { held: m.pipe("held", i.left) }
/// #     }
/// # }
/// # block! {
/// #     struct Line;
/// #     in LineIn { word: bits(4) }
/// #     out LineOut { last: bits(4) }
/// # }
/// # impl Line {
/// #     fn build(&self, m: Module, i: LineIn) -> LineOut {
/// let cells = m.array("u_cell", 100, &Cell, |cells| CellIn { left: cells.held.previous(i.word) });
/// #         LineOut { last: cells.held.last() }
/// #     }
/// # }
/// # let design = elaborate(&Line)?;
/// // One instance with 100 lanes.
/// let [cells] = &design.top().instances[..] else { panic!("an array is one") };
/// assert_eq!((cells.shape, cells.inputs.len()), (row(100), 1));
/// # Ok::<(), Problems>(())
/// ```
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
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = tilewright_sim::shown! { |m, i| in { take: bit(), empty: bit() } out { taken: bit() }
/// m.assert(i.take.implies(!i.empty), "nothing is taken of what is empty");
/// #     ShownOut { taken: i.take }
/// # };
/// let (top, property) = (design.top(), &design.top().properties[0]);
/// assert_eq!((top.width(property.condition), &*property.message), (1, "nothing is taken of what is empty"));
/// ```
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
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = tilewright_sim::shown! { |m, i| in { take: bit(), empty: bit() } out { taken: bit() }
/// m.assume(i.take.implies(!i.empty), "nothing is taken of what is empty");
/// m.cover("something is taken", i.take);
/// #     ShownOut { taken: i.take }
/// # };
/// let directives: Vec<_> = design.top().properties.iter().map(|property| property.directive).collect();
/// assert_eq!(directives, [ir::Directive::Assume, ir::Directive::Cover]);
/// ```
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
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = tilewright_sim::shown! { |m, i| in { word: bits(8) } out { late: bits(8) }
/// let late = m.reg("late", 8).attribute("keep", "true");
/// late.next(i.word);
/// #     ShownOut { late: *late }
/// # };
/// let keep = ir::Attribute { name: "keep".to_owned(), value: "true".to_owned() };
/// assert_eq!(design.top().registers[0].attributes, [keep]);
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Attribute {
    /// The name, a plain identifier.
    pub name: String,
    /// The value, a text.
    pub value: String,
}

impl Node {
    /// A node without a name, whose bits are a number.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// let node = ir::Node::new(ir::Op::Const(Bits::new(8, 7)), 8, row(4), Loc::caller());
    /// assert_eq!((node.name, node.kind), (None, ir::Kind::Number));
    /// ```
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
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let design = tilewright_sim::shown! { |_, i| in { word: bits(8) } out { sum: bits(8) }
    /// let sum = i.word + 1;
    /// #     ShownOut { sum }
    /// # };
    /// // The one of the sum becomes a two.
    /// let mut modules = design.into_modules();
    /// for node in &mut modules[0].nodes {
    ///     if let ir::Op::Const(value) = &mut node.op {
    ///         *value = Bits::new(8, 2);
    ///     }
    /// }
    /// assert!(Design::new(modules.clone()).is_ok());
    /// // An output of a node that there is not.
    /// modules[0].outputs[0].node = ir::NodeId(99);
    /// assert!(Design::new(modules).is_err());
    /// ```
    #[track_caller]
    pub fn new(modules: Vec<Module>) -> Result<Design, Problems> {
        let problems = validate::validate(&modules);
        if problems.is_empty() { Ok(Design { modules }) } else { Err(Problems(problems)) }
    }

    /// The modules, children before the modules that instantiate them; the top is the last.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # block! {
    /// #     struct Halver;
    /// #     in HalverIn { word: bits(8) }
    /// #     out HalverOut { half: bits(8) }
    /// # }
    /// # impl Halver {
    /// #     fn build(&self, _: Module, i: HalverIn) -> HalverOut {
    /// #         HalverOut { half: i.word >> 1 }
    /// #     }
    /// # }
    /// # block! {
    /// #     struct Chain;
    /// #     in ChainIn { word: bits(8) }
    /// #     out ChainOut { quarter: bits(8) }
    /// # }
    /// # impl Chain {
    /// #     fn build(&self, m: Module, i: ChainIn) -> ChainOut {
    /// let half = m.instance("u_half", &Halver, HalverIn { word: i.word }).half;
    /// let quarter = m.instance("u_quarter", &Halver, HalverIn { word: half }).half;
    /// #         ChainOut { quarter }
    /// #     }
    /// # }
    /// # let design = elaborate(&Chain)?;
    /// // Two instances of one module.
    /// assert_eq!(design.modules().iter().map(|module| &*module.name).collect::<Vec<_>>(), ["halver", "chain"]);
    /// # Ok::<(), Problems>(())
    /// ```
    pub fn modules(&self) -> &[Module] {
        &self.modules
    }

    /// The modules, to be edited; [`Design::new`] makes a design of them again.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let design = tilewright_sim::shown! { |m, i| in { word: bits(8) } out { late: bits(8) }
    /// let late = m.pipe("late", i.word);
    /// #     ShownOut { late }
    /// # };
    /// let mut modules = design.into_modules();
    /// modules[0].name = "delay".to_owned();
    /// assert_eq!(Design::new(modules).unwrap().top().name, "delay");
    /// ```
    pub fn into_modules(self) -> Vec<Module> {
        self.modules
    }

    /// The module that is not instantiated by another.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let design = tilewright_sim::shown! { |m, i| in { word: bits(8) } out { late: bits(8) }
    /// let late = m.pipe("late", i.word);
    /// #     ShownOut { late }
    /// # };
    /// assert_eq!(design.top().inputs[0].name, "word"); // what a simulation sets
    /// ```
    pub fn top(&self) -> &Module {
        self.modules.last().expect("a design has a top module")
    }

    /// The module of that id.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # block! {
    /// #     struct Halver;
    /// #     in HalverIn { word: bits(8) }
    /// #     out HalverOut { half: bits(8) }
    /// # }
    /// # impl Halver {
    /// #     fn build(&self, _: Module, i: HalverIn) -> HalverOut {
    /// #         HalverOut { half: i.word >> 1 }
    /// #     }
    /// # }
    /// # block! {
    /// #     struct Outer;
    /// #     in OuterIn { word: bits(8) }
    /// #     out OuterOut { half: bits(8) }
    /// # }
    /// # impl Outer {
    /// #     fn build(&self, m: Module, i: OuterIn) -> OuterOut {
    /// let HalverOut { half } = m.instance("u_half", &Halver, HalverIn { word: i.word });
    /// #         OuterOut { half }
    /// #     }
    /// # }
    /// # let design = elaborate(&Outer)?;
    /// let instance = &design.top().instances[0];
    /// assert_eq!(design.module(instance.module).name, "halver");
    /// # Ok::<(), Problems>(())
    /// ```
    pub fn module(&self, id: ModuleId) -> &Module {
        &self.modules[id.0 as usize]
    }
}

impl Module {
    /// The node of that id.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let design = tilewright_sim::shown! { |_, i| in { word: bits(8) } out { flipped: bits(8) }
    /// let flipped = !i.word;
    /// #     ShownOut { flipped }
    /// # };
    /// let top = design.top();
    /// let input = top.node(top.inputs[0].node);
    /// assert_eq!((input.op.clone(), input.name.as_deref()), (ir::Op::Input(0), Some("word")));
    /// ```
    pub fn node(&self, id: NodeId) -> &Node {
        &self.nodes[id.0 as usize]
    }

    /// The width of a node in bits, in one lane.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let design = tilewright_sim::shown! { |_, i| in { word: bits(8).of(row(4)) } out { word_of_all: _ }
    /// let word_of_all = i.word.pack();
    /// #     ShownOut { word_of_all }
    /// # };
    /// let top = design.top();
    /// assert_eq!((top.width(top.inputs[0].node), top.width(top.outputs[0].node)), (8, 32));
    /// ```
    pub fn width(&self, id: NodeId) -> u32 {
        self.node(id).width
    }

    /// The shape of a node.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let design = tilewright_sim::shown! { |_, i| in { word: bits(8).of(row(4)) } out { word_of_all: _ }
    /// let word_of_all = i.word.pack();
    /// #     ShownOut { word_of_all }
    /// # };
    /// let top = design.top();
    /// assert_eq!((top.shape(top.inputs[0].node), top.shape(top.outputs[0].node)), (row(4), Shape::Plain));
    /// ```
    pub fn shape(&self, id: NodeId) -> Shape {
        self.node(id).shape
    }

    /// The name of a register: its node's.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let design = tilewright_sim::shown! { |m, i| in { word: bits(8) } out { out: bits(8) }
    /// bundle! { struct Pair<T> { low: T, high: T } }
    ///
    /// let pair = m.pipe("pair", Pair { low: i.word.part(0, 4), high: i.word.part(4, 4) });
    /// let out = pair.pack();
    /// #     ShownOut { out }
    /// # };
    /// let top = design.top();
    /// let names: Vec<_> = top.registers.iter().map(|register| top.register_name(register)).collect();
    /// assert_eq!(names, ["pair_low", "pair_high"]);
    /// ```
    pub fn register_name(&self, register: &Register) -> &str {
        self.node(register.node).name.as_deref().expect("a register has a name")
    }
}
