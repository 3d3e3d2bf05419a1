//! The compiled form of a circuit: flat, in the order of evaluation, with its storage laid out. It says what to
//! compute and when, but not how, so every engine reads the same program.
//!
//! A [`Value`] is `lanes x width` bits. An instance array stays whole: a value inside an array of `n` inside an array
//! of `m` has `m * n` lanes, and lane `outer * n + inner` belongs to that pair of instances. Most operations are
//! elementwise over equal lane counts; the lane operations of [`Kind`] change the lane count. A program for several
//! runs of a design is an array of top modules.
//!
//! Operations with the same causes of change and the same readers form a [`Segment`]. So an edge of one clock
//! evaluates nothing that depends only on another clock.

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
mod properties;
mod roots;
mod schedule;
mod split;

use crate::engine::Passes;
use tilewright_circuit::ir::{Contents, Init, ReadUnderWrite};
use tilewright_circuit::{Bits, Reset, limbs_for};

pub use circuit::{Cell, Circuit, ValueId};
pub use compile::{compile, compile_lanes, most_lanes};
pub(crate) use compile::{flat, tidy};
pub use hierarchy::Hierarchy;
pub use kind::{Axis, Kind, Lowered, Piece};
pub use properties::{Assert, Cover, Display};
pub(crate) use schedule::assign_to_clocks;

/// The causes that can make a segment's results stale: a bit for each clock's state and for each clock's inputs.
///
/// From the 33rd clock on, several share a bit; then a segment may be evaluated more often than necessary.
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

    /// The number of causes.
    pub fn count(self) -> u32 {
        self.0.count_ones()
    }
}

/// The readers of a segment's results: the edges of some clocks, and output ports.
///
/// From the 64th clock on, several share a bit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Default)]
pub struct Readers(u64);

impl Readers {
    /// No readers: results that are only for peeking and for waves.
    pub const NONE: Readers = Readers(0);
    /// An output port.
    pub const OUTPUT: Readers = Readers(1);

    /// The samples at an edge of this clock.
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

    /// The number of readers.
    pub fn count(self) -> u32 {
        self.0.count_ones()
    }
}

/// A flat circuit with all objects that it reads and changes.
///
/// The values of [`compile`]'s result are in sequence: first state, then constants, then results, each after its
/// operands.
#[derive(Debug, Clone, Default)]
pub struct Program {
    /// The values.
    pub circuit: Circuit,
    /// When values are computed, and where an engine with all values in limbs stores them.
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
    /// The assertions and assumptions.
    pub asserts: Vec<Assert>,
    /// The covers.
    pub covers: Vec<Cover>,
    /// The displays.
    pub displays: Vec<Display>,
    /// The names of everything.
    pub hierarchy: Hierarchy,
    /// The passes that made it, and those for its code.
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
    /// The groups of computed values, in the order of evaluation.
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
    /// The number of limbs of one lane.
    pub fn limbs(&self) -> usize {
        limbs_for(self.width)
    }

    /// The range of all lanes in the storage.
    pub fn range(&self) -> std::ops::Range<usize> {
        self.offset..self.offset + self.lanes as usize * self.limbs()
    }
}

/// A run of operations that become stale by the same triggers and have the same readers.
#[derive(Debug, Clone)]
pub struct Segment {
    /// The values that it computes, by id.
    pub values: std::ops::Range<u32>,
    /// The causes that make it stale.
    pub triggers: Triggers,
    /// Its readers.
    pub readers: Readers,
    /// The earlier segments that it may depend on, in the order of evaluation.
    pub needs: Vec<u32>,
}

/// A clock and everything that happens at its edges.
#[derive(Debug, Clone)]
pub struct Clock {
    /// The clock's name: that of the description, or `clk` for the default clock.
    pub name: String,
    /// The port in Verilog.
    pub port: String,
    /// The reset port in Verilog, if the reset is used.
    pub reset: Option<String>,
    /// The kind of reset.
    pub kind: Reset,
    /// Its edges are where it falls; it is high before the first.
    pub falls: bool,
    /// The period in picoseconds.
    pub period: u64,
    /// The causes that can make its edge have another effect than the last time.
    pub triggers: Triggers,
    /// Its registers, by index in [`Program::registers`].
    pub registers: Vec<u32>,
    /// Its read ports, by memory and index in [`Memory::reads`].
    pub reads: Vec<(u32, u32)>,
    /// Its write ports, by memory and index in [`Memory::writes`]; a later one of a memory wins.
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
    /// Its value, with as many lanes as the program has runs: all lanes of the port side by side, the first in the
    /// lowest bits.
    pub value: ValueId,
    /// The number of its own lanes; 1 for a plain port.
    pub lanes: u32,
    /// It is one number, in two's complement.
    pub is_signed: bool,
    /// The values that a change of this input makes stale; none for an output.
    pub triggers: Triggers,
}

/// A register, in all lanes of its array.
#[derive(Debug, Clone)]
pub struct Register {
    /// Its value.
    pub value: ValueId,
    /// Its clock, by index in [`Program::clocks`].
    pub clock: u32,
    /// The value after a reset, for a number of lanes, repeated.
    pub reset: Option<Init>,
    /// The value at power-on, if it differs from that after a reset.
    pub initial: Option<Bits>,
    /// 1 bit a lane: the enable; `None` means always.
    pub enable: Option<ValueId>,
    /// The next value.
    pub next: ValueId,
    /// The unit that contains it.
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
    /// The result of a synchronous read whose word is written at the same edge.
    pub policy: ReadUnderWrite,
    /// The contents at the start: words for a number of lanes, repeated.
    pub contents: Contents,
    /// Synchronous read ports.
    pub reads: Vec<ReadPort>,
    /// Write ports.
    pub writes: Vec<WritePort>,
    /// The unit that contains it.
    pub unit: Option<UnitId>,
}

/// A synchronous read port.
#[derive(Debug, Clone)]
pub struct ReadPort {
    /// Its clock, by index in [`Program::clocks`].
    pub clock: u32,
    /// The address.
    pub address: ValueId,
    /// 1 bit a lane: the enable; `None` means always.
    pub enable: Option<ValueId>,
    /// The data register.
    pub value: ValueId,
}

/// A write port.
#[derive(Debug, Clone)]
pub struct WritePort {
    /// Its clock, by index in [`Program::clocks`].
    pub clock: u32,
    /// 1 bit a lane: the enable.
    pub enable: ValueId,
    /// The address.
    pub address: ValueId,
    /// The word.
    pub data: ValueId,
}

impl Memory {
    /// Whether a seed fills it. One that is never written is zero: so it is in Verilog, too.
    pub fn is_unknown(&self) -> bool {
        self.contents == Contents::Unknown && !self.writes.is_empty()
    }
}

impl Register {
    /// The value of a lane after a reset, if it has a reset value.
    pub fn reset(&self, lane: u32) -> Option<&[u64]> {
        let value = match self.reset.as_ref()? {
            Init::Same(value) => value,
            Init::Each(values) => &values[lane as usize % values.len()],
        };
        Some(value.limbs())
    }
}

impl Program {
    /// The number of runs of the design side by side.
    pub fn lanes(&self) -> u32 {
        self.hierarchy.scopes[0].lanes
    }

    /// The shape and the place of a value.
    pub fn value(&self, id: ValueId) -> Value {
        let Cell { lanes, width, .. } = self.circuit[id];
        let (offset, segment) = self.schedule.slots[id.index()];
        Value { lanes, width, offset, segment }
    }

    /// Whether registers change at once when a clock's reset becomes this: those of an asynchronous one.
    pub(crate) fn resets_at_once(&self, clock: usize, is_active: bool) -> bool {
        is_active && self.clocks[clock].kind.is_asynchronous()
    }

    /// The registers that change at once when a clock's reset becomes this.
    pub(crate) fn reset_at_once(&self, clock: usize, is_active: bool) -> impl Iterator<Item = &Register> {
        let registers: &[_] = if self.resets_at_once(clock, is_active) { &self.clocks[clock].registers } else { &[] };
        registers.iter().map(|&index| &self.registers[index as usize])
    }

    /// Whether a value is set from outside the circuit: an input, a register, the data of a synchronous read.
    pub fn is_state(&self, id: ValueId) -> bool {
        self.circuit[id].kind == Kind::State
    }
}
