//! What a random design is made of, as plain data that shrinks.
//!
//! Every value of these types is a valid design: a [`Pick`] is taken modulo what there is to choose from, operands are
//! cut or widened to the width that meets them, and values that would grow beyond [`WIDEST`] are cut. So a shrunk
//! description needs no repair. [`build`](crate::build) turns it into hardware, [`strategy`](crate::strategy) makes it.
//!
//! A design has one or two clocks; each step belongs to one of them and sees its values alone, but for the declared
//! crossings. A value that no other step reads is an output, so that nothing goes unobserved.

mod border;
mod control;
mod form;
mod instances;
mod lanes;
mod stores;

use crate::stimulus::Numbers;
pub use border::{Drives, Pad};
pub use control::{Ask, Coded, Exits, Machine};
pub use form::{Form, Meaning};
pub use instances::{Declared, Feed, Gather, Library, LibraryBlock};
pub use lanes::{End, LaneWork, Work};
pub use stores::{Contents, InParts, Memory, Read, Records, Rom, Write};
use tilewright_hdl::ir::{Relation, Shift};
use tilewright_hdl::{Edge, Radix, Reset};

/// The widest value that a step makes, in bits.
pub const WIDEST: u32 = 280;

/// A whole design.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Spec {
    /// The modules; each may instantiate those before it, and the last is the top.
    pub parts: Vec<Part>,
    /// How many steps a part may have with those of the parts in it, each counted in every lane; there is no room for
    /// instances beyond that.
    pub room: u32,
    /// The period of the second clock in picoseconds, if there is one; the first has 10 ns.
    pub second_period: Option<u64>,
    /// The seed of the names; 0 for names that are plain numbers.
    pub names: u64,
    /// What is done to it.
    pub stimulus: Stimulus,
}

/// The inputs over time.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Stimulus {
    /// The instants simulated.
    pub steps: u8,
    /// The seed of the values, of the kinds of reset and of the edges.
    pub seed: u64,
}

impl Stimulus {
    /// How the own clock and the second one reset.
    pub fn resets(&self) -> [Reset; 2] {
        let mut numbers = Numbers(self.seed ^ 0x7265_7365_7473);
        [(), ()].map(|()| Reset::ALL[numbers.draw() as usize % Reset::ALL.len()])
    }

    /// The edges of the own clock and of the second one.
    pub fn edges(&self) -> [Edge; 2] {
        let mut numbers = Numbers(self.seed ^ 0x65_6467_6573);
        [(), ()].map(|()| if numbers.draw().is_multiple_of(2) { Edge::Rising } else { Edge::Falling })
    }
}

/// A module.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Part {
    /// The input ports.
    pub inputs: Vec<Input>,
    /// It calls its clocks by names of its own, in whose place those of the design run; the top does not.
    pub names_clocks: bool,
    /// What is in it, in order; a step sees the values of the steps before it, and a register's next value sees all.
    pub steps: Vec<Step>,
}

/// An input port.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Input {
    /// What it is.
    pub form: Form,
    /// The clock it is synchronous to.
    pub clock: ClockPick,
    /// Adds an output like it, which an array may link to this input of a neighbour.
    pub link: Option<Link>,
}

/// What an output that is linked to an input has.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Link {
    /// The value.
    pub of: Pick,
    /// It comes out of a register, so that lanes may depend on it in any direction.
    pub registered: bool,
}

/// One of the design's clocks; the first, if there is only one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ClockPick {
    /// The module's own clock.
    Own,
    /// The second clock.
    Second,
}

/// A choice among the values that exist, and how it is fitted to the width it meets. 0 is the first value.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct Pick(pub u16);

/// On one line, since there are many.
impl std::fmt::Debug for Pick {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        write!(f, "Pick({})", self.0)
    }
}

/// A constant of some width.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Pattern {
    /// All bits zero.
    Zero,
    /// All bits one.
    Ones,
    /// 1.
    One,
    /// The sign alone.
    Sign,
    /// `0101...`.
    Alternating,
    /// A number, repeated every 64 bits.
    Number(u64),
}

/// An object or an operator on one of the clocks.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Step {
    /// Its clock.
    pub clock: ClockPick,
    /// It is in a part that this value enables.
    pub enabled: Option<Pick>,
    /// It names another clock, in whose place its own runs.
    pub renamed: bool,
    /// What it is.
    pub make: Make,
}

/// What a step makes.
#[allow(missing_docs, reason = "the fields are those of the operators of `tilewright_hdl::ir`")]
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Make {
    /// A constant.
    Constant(u32, Pattern),
    /// An operator of one operand.
    Unary(Unary, Pick),
    /// An operator of two operands of one width.
    Binary(Binary, Pick, Pick),
    /// A product.
    Product { signed: bool, operands: [Pick; 2] },
    /// A comparison.
    Compare { relation: Relation, signed: bool, operands: [Pick; 2] },
    /// A shift by a signal.
    Shift { shift: Shift, of: Pick, by: Pick },
    /// A shift by a constant: a number of the description, or a literal of the circuit.
    ShiftBy { shift: Shift, of: Pick, by: u32, literal: bool },
    /// A value of 8, 16, 32 or 64 bits rotated, which of them by the logarithm from 3 on; beyond, one of its own width.
    Rotate { of: Pick, size: u32, by: u32, right: bool },
    /// An operator whose other operand is a number of the description.
    WithNumber(WithNumber),
    /// A value that takes over what operators make of it, one after the other.
    Assigned(Pick, Vec<(Binary, Pick)>),
    /// A condition that another one implies.
    Implies([Pick; 2]),
    /// Constants by a small number.
    Lookup { subject: Pick, bits: u32, width: u32, words: Vec<Pattern> },
    /// A choice of two.
    Mux { meaning: Meaning, select: Pick, on_true: Pick, on_false: Arm },
    /// A choice by conditions.
    Select { meaning: Meaning, arms: Vec<(Pick, Arm)>, default: Pick },
    /// A choice by value.
    Case { meaning: Meaning, subject: Pick, arms: Vec<(u64, Arm)>, default: Pick },
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
    /// A net read before it is driven.
    Wire(Meaning, Pick),
    /// A register: what it takes where a condition holds, the first of which wins, and what it takes else.
    Register {
        form: Form,
        attribute: bool,
        reset: Option<Pattern>,
        enable: Option<Pick>,
        updates: Vec<(Pick, Pick)>,
        next: Option<Pick>,
    },
    /// What a small number, an opcode, says is done.
    Alu { subject: Pick, bits: u32, arms: Vec<Operation>, default: Pick },
    /// A comparison with a constant.
    Is(Pick, u64),
    /// Registers that each take over the one before; the first takes over the last one, or a value.
    Chain { width: u32, length: u32, ring: bool, enable: Option<Pick>, from: Pick },
    /// A register of a value, or of a record of it and a number; it may be enabled.
    Pipe { meaning: Meaning, of: Pick, beside: Option<Pick>, enable: Option<Pick> },
    /// A bit that turns over.
    Toggle(Pick),
    /// A state machine.
    Machine(Machine),
    /// A memory.
    Memory(Memory),
    /// A register, a memory and a pipeline of a record.
    Records(Records),
    /// A table of records.
    Rom(Rom),
    /// Rows and grids.
    Lanes(LaneWork),
    /// A value of the other clock, brought into this one.
    Cross { by: Crossing, of: Pick },
    /// Something stated of a value.
    State(Statement, Pick),
    /// A register of an enum's codes.
    Coded(Coded),
    /// A register with a value at power-on.
    PowerOn { meaning: Meaning, initial: Pattern, reset: Option<Pattern>, next: Pick },
    /// A memory of words in parts.
    InParts(InParts),
    /// An instance of a declared block with ports of records, or an array of it.
    Declared(Declared),
    /// A block of the library.
    Library(Library),
    /// A pad, in the top.
    Pad(Pad),
    /// Calls of a helper. All calls in a part declare objects of the same names.
    Again { times: u8, of: Pick },
    /// A condition that may fail: a value is never this one.
    Never(Pick, Pattern),
    /// An instance of an earlier part.
    Instance { part: Pick, inputs: Vec<Pick> },
    /// An array of an earlier part.
    Array { part: Pick, lanes: u32, towards_lower: bool, inputs: Vec<(Feed, Pick)>, outputs: Vec<Gather> },
}

/// What is stated of a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Statement {
    /// It is asserted to be at most all ones.
    Assert,
    /// It is assumed to be at most all ones.
    Assume,
    /// It has this value at some time.
    Cover(Pattern),
    /// Its lowest bit rises at some time.
    Rises,
    /// Its highest bit falls at some time.
    Falls,
    /// What it was one edge ago, and so many more, is what registers held that long.
    Past(u8),
    /// It is displayed where its lowest bit is high.
    Displayed,
}

/// Operators of one operand.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Unary {
    /// Every bit inverted.
    Not,
    /// The two's complement negative.
    Negative,
    /// All bits are one.
    AllOnes,
    /// Some bit is one.
    AnyOne,
    /// The number of ones is odd.
    Parity,
}

/// Operators of two operands of one width.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Binary {
    /// Bitwise and.
    And,
    /// Bitwise or.
    Or,
    /// Bitwise exclusive or.
    Xor,
    /// Wrapping sum.
    Add,
    /// Wrapping difference.
    Sub,
    /// Sum with its carry.
    AddCarry,
}

/// An operator whose other operand is a number of the description.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct WithNumber {
    /// The operator.
    pub op: NumberOp,
    /// The value.
    pub of: Pick,
    /// The value is signed, and so is the number.
    pub signed: bool,
    /// The number, cut to what the operator takes.
    pub number: u64,
    /// How it is written, if it is not signed.
    pub radix: Radix,
    /// The number is the operand on the left, where the language takes it there.
    pub on_left: bool,
}

/// What is computed with a number of the description.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum NumberOp {
    /// An operator of operands of one width.
    Binary(Binary),
    /// A product, with a number of 12 bits.
    Product,
    /// A comparison.
    Compare(Relation),
}

/// What a choice gives.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Arm {
    /// A value.
    Value(Pick),
    /// A number of the description.
    Number(Pattern),
}

/// How a value of one clock comes to the other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Crossing {
    /// It is said not to change.
    QuasiStatic,
    /// Its lowest bit is synchronized, 0 after a reset.
    Synchronize,
    /// It is synchronized, and is so after a reset.
    SynchronizeFrom(bool),
}

/// What an opcode stands for: `(a op b) + (c - a)`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Operation {
    /// The operator.
    pub op: Binary,
    /// Its operands, and the third value.
    pub operands: [Pick; 3],
}
