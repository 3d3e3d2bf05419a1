//! The circuit: the result of elaborating a description, which simulators and printers read.
//!
//! A [`Design`] is a list of modules. Each module was elaborated once for its block type and parameters, however many
//! instances it has. A module is a graph of [`Node`]s, which are expressions of known width, together with its
//! registers, memories and instances. A `Design` has passed all checks: widths agree, every id is valid, every wire
//! has one driver, there is no combinational loop, and names are unique and legal in Verilog. [`Design::new`] makes a
//! design of edited modules and repeats these checks.
//!
//! Every value has a [`Shape`]: plain, a row or a grid of lanes. Most operations are elementwise: one node stands for
//! as many gates as it has lanes. The lane operations of [`Op`] change the shape. Registers, memories, instances and
//! properties have the lanes of their nodes. Only [`Op::Broadcast`] broadcasts.

mod affine;
mod design;
mod display;
mod foreign;
mod ids;
mod kind;
#[doc(hidden)]
pub mod latency;
mod meaning;
mod memory;
mod op;
mod pads;
mod ports;
mod property;
mod record;
mod register;
mod shape;
mod state;
mod validate;
mod words;

use crate::loc::Loc;
use std::collections::BTreeMap;

pub use affine::Affine;
pub use design::Design;
pub use display::{Format, Piece, Shown};
pub use foreign::{Foreign, Parameter};
pub use ids::{ClockId, InstanceId, MemoryId, ModuleId, NodeId, RegisterId};
pub use kind::{Kind, Names};
pub use latency::Latency;
pub use memory::{Contents, Memory, ReadPort, ReadUnderWrite, WritePort};
pub use op::{Binary, Op, Reduction, Relation, Shift, Unary};
pub use ports::{Clock, Input, Output};
pub use property::{Attribute, Directive, Property};
pub use record::{Field, Record};
pub use register::{Init, Register};
pub use shape::Shape;
pub use state::State;

/// One module definition.
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = tilewright_sim::shown! { |m, i| in { enable: bit() } out { count: bits(8) }
/// def!(count = m.reg(8).reset(0));
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
    /// Its description in words.
    pub about: About,
    /// The block's parameters in Rust's `Debug` format, such as `Counter { width: 8 }`.
    pub parameters: String,
    /// The place of the block's description.
    pub loc: Loc,
    /// The clocks it uses, the default clock first if it uses that one.
    pub clocks: Vec<Clock>,
    /// Input ports, in the sequence of declaration.
    pub inputs: Vec<Input>,
    /// Output ports, in the sequence of declaration.
    pub outputs: Vec<Output>,
    /// The expressions.
    pub nodes: Vec<Node>,
    /// The registers.
    pub registers: Vec<Register>,
    /// The memories.
    pub memories: Vec<Memory>,
    /// The instances and instance arrays.
    pub instances: Vec<Instance>,
    /// The properties: assertions, assumptions, covers and displays.
    pub properties: Vec<Property>,
    /// The records that are packed into words, each once.
    pub records: Vec<Record>,
    /// The module of somebody else for which this one is a model.
    pub foreign: Option<Foreign>,
    /// Whether that model is missing, and the outputs are zeros in its place.
    pub unmodelled: bool,
    /// Whether it is a `Pad`: a model of an `inout` port of the top.
    pub is_pad: bool,
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
///         /// The first summand.
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
/// assert_eq!((&*about.inputs["a"], about.inputs.get("b")), ("The first summand.", None));
/// ```
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct About {
    /// What the block does, in one or a few sentences.
    pub summary: String,
    /// Clocks from an input to the output that it causes. It is in words if it is not a single number, and says how
    /// often a new input can begin. A single number is counted by [`Design::latencies`]; if one stands here anyway,
    /// such as `4`, it must equal the count.
    pub latency: String,
    /// The paper and the section, such as `VC-1, section 3.3 (VC1-MU)`.
    pub source: String,
    /// The documentation of the inputs, and of the records of inputs, by their paths, such as `scan` and
    /// `scan.enable`. Paths within a list have no index.
    pub inputs: BTreeMap<String, String>,
    /// The documentation of the outputs, in the same form.
    pub outputs: BTreeMap<String, String>,
}

/// An expression of a known width.
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = tilewright_sim::shown! { |_, i| in { a: bits(8).of(row(4)), b: bits(8) } out { sum: _ }
/// def!(sum = i.a + i.b);
/// #     ShownOut { sum }
/// # };
/// // One node for four adders.
/// let node = design.top().node(design.top().outputs[0].node);
/// assert_eq!((node.name.as_deref(), node.width, node.shape), (Some("sum"), 8, row(4)));
/// ```
#[derive(Debug, Clone)]
pub struct Node {
    /// The operation.
    pub op: Op,
    /// Its width in bits, in one lane: 1 to 1,048,576.
    pub width: u32,
    /// Its lanes, each of that width; plain if it has none.
    pub shape: Shape,
    /// The meaning of a lane's bits.
    pub kind: Kind,
    /// The name given in the description; unique in the module, and legal in Verilog and VCD. Inputs and registers
    /// always have one.
    pub name: Option<String>,
    /// The place in the description.
    pub loc: Loc,
}

/// An instance, or an array of instances that differ only in the inputs of their lanes.
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
    /// The instantiated module.
    pub module: ModuleId,
    /// The array's lanes, at least 1; plain for a single instance.
    pub shape: Shape,
    /// The drivers of the inputs, in the sequence of the child's ports. Each has the array's shape followed by that
    /// of the port.
    pub inputs: Vec<NodeId>,
    /// The [`Op::Output`] nodes, in the sequence of the child's ports.
    pub outputs: Vec<NodeId>,
    /// For each clock of the child, the clock of this module that drives it.
    pub clocks: Vec<ClockId>,
    /// The place in the description.
    pub loc: Loc,
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

impl Module {
    /// The node with this id.
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
    /// def!(pair = m.pipe(Pair { low: i.word.part(0, 4), high: i.word.part(4, 4) }));
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
