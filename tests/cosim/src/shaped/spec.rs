//! What a random design with shapes is made of, as plain data that shrinks.
//!
//! Every value of these types is a valid design: a [`Pick`] is taken modulo what there is to choose from, and operands are
//! brought to the width and the shape that meet them. `build` turns it into modules,
//! [`strategy`](super::strategy) makes it.

pub use crate::spec::{Pattern, Pick, Stimulus};
use tilewright_hdl::ReadUnderWrite;
use tilewright_hdl::ir::{Affine, Binary, Reduction, Relation, Shape, Shift, Unary};

/// The widest lane, in bits.
pub const WIDEST: u32 = 280;
/// The most lanes of a value in its module.
pub const MOST_LANES: u32 = 80;
/// The most lanes of a value in all instances of its module.
pub const MOST_LANES_IN_ALL: u32 = 400;
/// The widest value that lanes side by side make.
pub const WIDEST_PACKED: u32 = 1024;

/// A whole design.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Spec {
    /// The modules; each may instantiate those before it, and the last is the top.
    pub parts: Vec<Part>,
    /// The period of the second clock in picoseconds, if there is one; the first has 10 ns.
    pub second_period: Option<u64>,
    /// The seed of the names; 0 for names that are plain numbers.
    pub names: u64,
    /// What makes it a circuit that no description makes, for our own engines alone.
    pub odd: Odd,
    /// What is done to it.
    pub stimulus: Stimulus,
}

/// What no other simulator is asked about.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash)]
pub struct Odd {
    /// The seed of an order of the nodes in which operands may come after what is made of them; 0 for none.
    pub order: u64,
    /// Memories of [`ReadUnderWrite::Any`] read what is being written.
    pub reads_any: bool,
}

/// A module.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Part {
    /// The input ports: width and shape.
    pub inputs: Vec<(u32, ShapePick)>,
    /// The shapes that its values have most often.
    pub shapes: Vec<Shape>,
    /// What is in it, in order; a step sees the values of the steps before it, and a register's next value sees all.
    pub steps: Vec<Step>,
}

/// One of the part's shapes, or one of these with an axis less; plain by 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct ShapePick(pub u8);

/// How many lanes: as many as one of the part's shapes has along some axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Count(pub u8);

/// An object or an operator.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Step {
    /// Whether what holds state is on the second clock, if there is one.
    pub second: bool,
    /// What it is.
    pub make: Make,
}

/// Where lanes come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Route {
    /// The neighbour so many lanes on.
    Shift(i8),
    /// The lanes in reverse.
    Reverse,
    /// Each lane so many times in a row.
    Stretch(u8),
    /// Each so-manieth lane.
    Stride(u8),
    /// As many lanes as are needed, spread evenly.
    Spread,
    /// Any rule.
    Any(Affine),
}

/// Operators of one value and another of its width.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Fold {
    /// An operator.
    Binary(Binary),
    /// The smaller, as an unsigned number.
    Min,
    /// The first shifted to the left by the second.
    Shifted,
    /// The first where the second is odd, its inverse elsewhere.
    Chosen,
}

/// A value that reads itself in other lanes.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Link {
    /// Along which axis.
    pub axis: u8,
    /// Which lanes.
    pub route: Route,
    /// What comes in at the end.
    pub edge: Pick,
    /// What is done with it on the way.
    pub with: Vec<(Fold, Pick)>,
}

/// What a step makes.
#[allow(missing_docs, reason = "the fields are those of the operators of `tilewright_hdl::ir`")]
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Make {
    /// A constant.
    Constant { width: u32, pattern: Pattern, shape: ShapePick },
    /// A constant for each lane: the lane's number, or anything.
    Table { width: u32, seed: Option<u64>, shape: ShapePick },
    /// An operator of one operand.
    Unary(Unary, Pick),
    /// An operator of two operands, of one width but for products.
    Binary(Binary, Pick, Pick),
    /// A comparison.
    Compare { relation: Relation, signed: bool, operands: [Pick; 2] },
    /// A shift by a signal.
    Shift { shift: Shift, of: Pick, by: Pick },
    /// A shift by a constant.
    ShiftBy { shift: Shift, of: Pick, by: u32 },
    /// A choice of two.
    Mux { select: Pick, on_true: Pick, on_false: Pick },
    /// A choice by conditions.
    Select { arms: Vec<(Pick, Pick)>, default: Pick },
    /// A choice by value.
    Case { subject: Pick, arms: Vec<(u64, Pick)>, default: Pick },
    /// Constants by a small number.
    Lookup { subject: Pick, bits: u32, width: u32, words: Vec<Pattern> },
    /// Some bits.
    Slice { of: Pick, low: u32, width: u32 },
    /// More bits.
    Extend { of: Pick, by: u32, signed: bool },
    /// Values side by side.
    Concat(Vec<Pick>),
    /// A value beside itself.
    Repeat(Pick, u32),
    /// A named net.
    Name(Pick),
    /// A value in all lanes along a new axis.
    Broadcast { of: Pick, axis: u8, count: Count },
    /// Values as lanes.
    Stack { parts: Vec<Pick>, axis: u8 },
    /// Lanes of another value.
    Map { of: Pick, axis: u8, route: Route, count: Count, edge: Pick },
    /// Lanes of several values by turns.
    Interleave { parts: Vec<Pick>, axis: u8 },
    /// One lane.
    Lane { of: Pick, axis: u8, index: u8 },
    /// The lane that a signal of so many bits says, or of those that it has.
    PickLane { of: Pick, axis: u8, index: Pick, bits: Option<u32> },
    /// All lanes combined.
    Reduce { by: Reduction, of: Pick, axis: u8 },
    /// All lanes along all axes combined.
    ReduceAll { by: Reduction, of: Pick },
    /// Lanes side by side.
    Pack { of: Pick, axis: u8 },
    /// Parts of a value as lanes.
    Unpack { of: Pick, axis: u8, count: Count },
    /// Each lane taken on its own, put through the same operators, and put together again.
    Apart { of: Pick, with: Vec<(Fold, Pick)>, axis: u8 },
    /// Nets that are read before they are driven, each by itself and the others in other lanes; no loop.
    Chain { width: u32, shape: ShapePick, links: Vec<Link> },
    /// The same, lane by lane through nodes of their own.
    Ladder { of: Pick, axis: u8, fold: Fold },
    /// A register; with a link, of what its neighbours hold.
    Register { start: Start, enable: Option<Pick>, next: Pick, link: Option<Link> },
    /// A register that takes the value of the first condition that holds, and keeps what it has where none does.
    Chosen { start: Start, updates: Vec<(Pick, Pick)> },
    /// Values side by side, held together, and taken apart.
    Record { fields: Vec<Pick>, held: Held },
    /// A memory.
    Memory(Store),
    /// Instances of an earlier part, plain or arrays, so many one by one.
    Instance { part: Pick, shape: ShapePick, copies: u8, inputs: Vec<(Feed, Pick)> },
    /// A condition that always holds.
    Assert(Pick),
    /// A condition that may fail: a value is never this one.
    Never(Pick, Pattern),
    /// A value is this one at some time.
    Sometimes(Pick, Pattern),
    /// What a value was at the last edge, which is stated of it where there was one.
    Past(Pick),
}

/// A register's width and shape, and what it holds at first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Start {
    /// Bits.
    pub width: u32,
    /// Lanes.
    pub shape: ShapePick,
    /// After a reset.
    pub reset: Reset,
    /// At power-on.
    pub initial: Option<Pattern>,
}

/// What holds a record.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Held {
    /// A net.
    Net,
    /// A register.
    Register,
    /// A memory of two words: where it is written and read.
    Memory(Pick),
}

/// What a reset does to a register.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Reset {
    /// Nothing.
    Keeps,
    /// The same in all lanes.
    Same(Pattern),
    /// A value for each lane, where it has any.
    Each(u64),
}

/// A memory.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Store {
    /// Words.
    pub depth: u32,
    /// Bits.
    pub width: u32,
    /// Lanes.
    pub shape: ShapePick,
    /// [`ReadUnderWrite::Any`] keeps its synchronous reads off in cycles of writing, but see [`Odd::reads_any`].
    pub policy: ReadUnderWrite,
    /// What it holds at the start.
    pub contents: Filling,
    /// The ports that read.
    pub reads: Vec<Read>,
    /// The ports that write, all on one clock.
    pub writes: Vec<Write>,
    /// There is another memory of this width with the same ports.
    pub twin: Option<u32>,
}

/// A memory's contents at the start.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Filling {
    /// None given.
    Unknown,
    /// One word everywhere.
    Fill(Pattern),
    /// Words from address 0, the same in all lanes.
    Words(Vec<Pattern>),
    /// So many words at most for each lane, where it has any.
    Each(u64, u8),
}

/// A value of the shape of a memory, or a plain one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct MaybePlain {
    /// Which.
    pub pick: Pick,
    /// The same for all lanes.
    pub plain: bool,
}

/// A port that reads.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Read {
    /// Within the cycle.
    pub asynchronous: bool,
    /// On the clock that does not write, if there are two; then the memory gives the old word.
    pub crossing: bool,
    /// When it reads.
    pub enable: Option<MaybePlain>,
    /// Where.
    pub address: MaybePlain,
}

/// A port that writes.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Write {
    /// When it writes.
    pub enable: MaybePlain,
    /// Where.
    pub address: MaybePlain,
    /// What; may be a value of a later step.
    pub data: Pick,
}

/// What feeds an input of an array.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Feed {
    /// A value.
    Value,
    /// The array's lane.
    Index,
    /// An output of the lane before, along an axis; or of the copy before.
    Previous {
        /// The axis; all of an array go the same way along it.
        axis: u8,
        /// What comes in at the end.
        edge: Pick,
    },
}
