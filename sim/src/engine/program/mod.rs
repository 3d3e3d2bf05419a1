//! The compiled form of a circuit: flat, in order of evaluation, with its storage laid out. It says what to compute
//! and when, and nothing about what executes it, so that every engine reads the same program.
//!
//! A [`Value`] is `lanes x width` bits. An instance array stays whole: a value inside an array of `n` inside an
//! array of `m` has `m * n` lanes, and lane `outer * n + inner` belongs to that pair of instances. Most operations
//! are elementwise over equal lane counts; the lane operations of [`Kind`] lead from one lane count to another. A
//! program of several runs of a design is the array of so many top modules.
//!
//! Operations are grouped into [`Segment`]s by what can change them and by who needs them, so that an edge of one
//! clock evaluates nothing that depends on another clock alone.

mod apart;
mod circuit;
mod compile;
mod cycles;
mod flatten;
pub mod hierarchy;
mod instances;
mod kind;
mod named;
mod objects;
mod roots;
mod schedule;
mod split;

use crate::engine::Passes;
use tilewright_hdl::ir::{Contents, Init, ReadUnderWrite};
use tilewright_hdl::{Bits, Loc, limbs_for};

pub use circuit::{Cell, Circuit, ValueId};
pub use compile::{compile, compile_lanes, most_lanes};
pub(crate) use compile::{flat, tidy};
pub use hierarchy::Hierarchy;
pub use kind::{Axis, Kind, Lowered, Piece};
pub(crate) use schedule::assign_to_clocks;

/// What can make a segment's results stale: a bit for each clock's state and for each clock's inputs.
///
/// From the 33rd clock on, several share a bit; then a segment may be evaluated more often than it has to be.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Default)]
pub struct Triggers(u64);

impl Triggers {
    /// Nothing.
    pub const NONE: Triggers = Triggers(0);
    /// Everything.
    pub const ALL: Triggers = Triggers(u64::MAX);

    /// The registers, read data and memory words that change at an edge of this clock.
    pub fn state(clock: usize) -> Triggers {
        Triggers(1 << (2 * (clock % 32)))
    }

    /// The inputs that belong to this clock; those without a clock count as the first clock's.
    pub fn inputs(clock: usize) -> Triggers {
        Triggers(2 << (2 * (clock % 32)))
    }

    /// Both together.
    pub fn with(self, other: Triggers) -> Triggers {
        Triggers(self.0 | other.0)
    }

    /// Whether they have something in common.
    pub fn meet(self, other: Triggers) -> bool {
        self.0 & other.0 != 0
    }

    /// Whether all of these are among `others`.
    pub fn within(self, others: Triggers) -> bool {
        self.0 & !others.0 == 0
    }

    /// How many there are.
    pub fn count(self) -> u32 {
        self.0.count_ones()
    }
}

/// Who needs a segment's results: the edges of which clocks, and whether an output port.
///
/// From the 64th clock on, several share a bit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Default)]
pub struct Readers(u64);

impl Readers {
    /// Nobody: results that are there for peeking and for waves.
    pub const NONE: Readers = Readers(0);
    /// An output port.
    pub const OUTPUT: Readers = Readers(1);

    /// What an edge of this clock samples.
    pub fn edge(clock: usize) -> Readers {
        Readers(2 << (clock % 63))
    }

    /// Both together.
    pub fn with(self, other: Readers) -> Readers {
        Readers(self.0 | other.0)
    }

    /// Whether they have something in common.
    pub fn meet(self, other: Readers) -> bool {
        self.0 & other.0 != 0
    }

    /// How many there are.
    pub fn count(self) -> u32 {
        self.0.count_ones()
    }
}

/// A flat circuit with all that it reads from and changes.
///
/// What [`compile`] gives is in order: first state, then constants, then results, each after its operands.
#[derive(Debug, Clone, Default)]
pub struct Program {
    /// The values.
    pub circuit: Circuit,
    /// What is computed when, and where values are stored.
    pub schedule: Schedule,
    /// The clocks of the top module.
    pub clocks: Vec<Clock>,
    /// Input ports of the top module.
    pub inputs: Vec<Port>,
    /// Output ports of the top module.
    pub outputs: Vec<Port>,
    /// The registers.
    pub registers: Vec<Register>,
    /// The memories.
    pub memories: Vec<Memory>,
    /// What must hold at edges.
    pub asserts: Vec<Assert>,
    /// What is counted at edges.
    pub covers: Vec<Cover>,
    /// The names of it all.
    pub hierarchy: Hierarchy,
    /// How it was made, and how code is to be.
    pub passes: Passes,
}

/// When values are computed, and where an engine that keeps all of them in limbs does so.
#[derive(Debug, Clone, Default)]
pub struct Schedule {
    /// Per value: its first limb, and the segment that computes it, if one does.
    pub slots: Vec<(usize, Option<u32>)>,
    /// How many 64-bit limbs all values take.
    pub storage: usize,
    /// The limb at which the state ends and constants and results begin.
    pub state_end: usize,
    /// The grouping of what is computed, in order of evaluation.
    pub segments: Vec<Segment>,
}

/// A value: its shape and its place in the storage.
#[derive(Debug, Clone, Copy)]
pub struct Value {
    /// The number of lanes, at least 1.
    pub lanes: u32,
    /// The width of a lane in bits, at least 1.
    pub width: u32,
    /// The first limb. Lane `i` has the limbs `offset + i * limbs ..` of [`Value::limbs`] each, the lowest first.
    pub offset: usize,
    /// The segment that computes it; `None` for state and constants.
    pub segment: Option<u32>,
}

impl Value {
    /// How many limbs one lane takes.
    pub fn limbs(&self) -> usize {
        limbs_for(self.width)
    }

    /// Where all lanes are in the storage.
    pub fn range(&self) -> std::ops::Range<usize> {
        self.offset..self.offset + self.lanes as usize * self.limbs()
    }
}

/// A run of operations that become stale by the same triggers and have the same readers.
#[derive(Debug, Clone)]
pub struct Segment {
    /// The values that it computes, by id.
    pub values: std::ops::Range<u32>,
    /// What makes it stale.
    pub triggers: Triggers,
    /// Who needs it.
    pub readers: Readers,
    /// The earlier segments that it may depend on, in order of evaluation.
    pub needs: Vec<u32>,
}

/// A clock and all that happens at its edges.
#[derive(Debug, Clone)]
pub struct Clock {
    /// The clock's name: that of the description, or `clk` for the default clock.
    pub name: String,
    /// The port in Verilog.
    pub port: String,
    /// The reset port in Verilog, if anything has a reset.
    pub reset: Option<String>,
    /// The period in picoseconds.
    pub period: u64,
    /// What can make its edge do something else than the last time.
    pub triggers: Triggers,
    /// Its registers, by index in [`Program::registers`].
    pub registers: Vec<u32>,
    /// Its read ports, by memory and index in [`Memory::reads`].
    pub reads: Vec<(u32, u32)>,
    /// Its write ports, by memory and index in [`Memory::writes`], a later one of a memory wins.
    pub writes: Vec<(u32, u32)>,
    /// Its asserts, by index in [`Program::asserts`].
    pub asserts: Vec<u32>,
}

/// A port of the top module.
#[derive(Debug, Clone)]
pub struct Port {
    /// Its name in Verilog.
    pub name: String,
    /// Its path in the bundle.
    pub path: String,
    /// Its value, with as many lanes as the program has: all lanes of the port side by side, the first in the lowest bits.
    pub value: ValueId,
    /// The number of its own lanes; 1 of a plain port.
    pub lanes: u32,
    /// It is one number, in two's complement.
    pub is_signed: bool,
    /// What a change of this input makes stale; none for an output.
    pub triggers: Triggers,
}

/// A register, in all lanes of its array.
#[derive(Debug, Clone)]
pub struct Register {
    /// What it holds.
    pub value: ValueId,
    /// Its clock, by index in [`Program::clocks`].
    pub clock: u32,
    /// What it holds after a reset: values for so many lanes, over and over.
    pub reset: Option<Init>,
    /// What it holds at power-on, if not the value after a reset.
    pub initial: Option<Bits>,
    /// 1 bit a lane: whether it takes `next`; `None` means always.
    pub enable: Option<ValueId>,
    /// What it takes.
    pub next: ValueId,
    /// The unit that it is in.
    pub unit: Option<UnitId>,
}

/// An instance of an array whose instances run one by one: see [`Passes::apart_from`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct UnitId(pub u32);

/// A memory, in all lanes of its array.
#[derive(Debug, Clone)]
pub struct Memory {
    /// The number of lanes.
    pub lanes: u32,
    /// The number of words in a lane.
    pub depth: u32,
    /// The width of a word in bits.
    pub width: u32,
    /// What a synchronous read gives when its word is written at the same edge.
    pub policy: ReadUnderWrite,
    /// What it holds at the start: words for so many lanes, over and over.
    pub contents: Contents,
    /// Synchronous read ports.
    pub reads: Vec<ReadPort>,
    /// Write ports.
    pub writes: Vec<WritePort>,
    /// The unit that it is in.
    pub unit: Option<UnitId>,
}

/// A synchronous read port.
#[derive(Debug, Clone)]
pub struct ReadPort {
    /// Its clock, by index in [`Program::clocks`].
    pub clock: u32,
    /// The address.
    pub address: ValueId,
    /// 1 bit a lane: whether it reads; `None` means always.
    pub enable: Option<ValueId>,
    /// The data register.
    pub value: ValueId,
}

/// A write port.
#[derive(Debug, Clone)]
pub struct WritePort {
    /// Its clock, by index in [`Program::clocks`].
    pub clock: u32,
    /// 1 bit a lane: whether it writes.
    pub enable: ValueId,
    /// The address.
    pub address: ValueId,
    /// The word.
    pub data: ValueId,
}

/// A condition that must hold at every edge of its clock while that clock's reset is low.
#[derive(Debug, Clone)]
pub struct Assert {
    /// Its clock, by index in [`Program::clocks`].
    pub clock: u32,
    /// 1 bit a lane.
    pub condition: ValueId,
    /// What is wrong if it does not hold.
    pub message: String,
    /// Whether it is the stimulus that is wrong then.
    pub is_assumption: bool,
    /// Where the description states it.
    pub loc: Loc,
    /// How many of the lanes of the condition each instance has.
    pub group: u32,
    /// The scope that it stands in; several for instances that run in lanes but were written one by one.
    pub scopes: Vec<hierarchy::ScopeId>,
}

/// A condition whose edges are counted, by a register beside those of the design.
#[derive(Debug, Clone)]
pub struct Cover {
    /// Its clock, by index in [`Program::clocks`].
    pub clock: u32,
    /// The register that counts, in each lane, also while the reset is high.
    pub counter: ValueId,
    /// What happens.
    pub name: String,
    /// Where the description states it.
    pub loc: Loc,
    /// How many of the lanes each instance has.
    pub group: u32,
    /// The scope that it stands in; several for instances that run in lanes but were written one by one.
    pub scopes: Vec<hierarchy::ScopeId>,
}

impl Register {
    /// The value of a lane after a reset, if a reset touches it.
    pub fn reset(&self, lane: u32) -> Option<&[u64]> {
        let value = match self.reset.as_ref()? {
            Init::Same(value) => value,
            Init::Each(values) => &values[lane as usize % values.len()],
        };
        Some(value.limbs())
    }
}

impl Program {
    /// How many runs of the design there are side by side.
    pub fn lanes(&self) -> u32 {
        self.hierarchy.scopes[0].lanes
    }

    /// The shape and the place of a value.
    pub fn value(&self, id: ValueId) -> Value {
        let Cell { lanes, width, .. } = self.circuit[id];
        let (offset, segment) = self.schedule.slots[id.index()];
        Value { lanes, width, offset, segment }
    }

    /// Whether a value is set from outside the circuit: an input, a register, the data of a synchronous read.
    pub fn is_state(&self, id: ValueId) -> bool {
        self.circuit[id].kind == Kind::State
    }
}
