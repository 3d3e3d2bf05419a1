//! The operations that compute values: the flattened operators of the circuit.

use tilewright_circuit::Bits;
use tilewright_circuit::ir::{Affine, Binary, Reduction, Relation, Shape, Shift, Unary};

use super::ValueId;

/// An operation. Elementwise kinds have operands with as many lanes as the result; the rules for widths are those of
/// the operator of the same name in [`tilewright_hdl::ir::Op`].
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Kind {
    /// Set from outside the expressions: an input, a register, the data of a synchronous read.
    State,
    /// The same in every lane.
    Const(Bits),
    /// Equal to another value of the same shape.
    Alias(ValueId),
    /// An operator with one operand.
    Unary(Unary, ValueId),
    /// An operator with two operands.
    Binary(Binary, ValueId, ValueId),
    /// A comparison, in two's complement if the flag is set.
    Compare(Relation, bool, ValueId, ValueId),
    /// The first operand shifted by the second.
    Shift(Shift, ValueId, ValueId),
    /// `if select { on_true } else { on_false }`.
    Mux {
        /// 1 bit.
        select: ValueId,
        /// The value where `select` is 1.
        on_true: ValueId,
        /// The value where `select` is 0.
        on_false: ValueId,
    },
    /// The value of the first arm whose condition is true, else the default.
    Select {
        /// Condition and value, highest priority first.
        arms: Vec<(ValueId, ValueId)>,
        /// The value if no condition is true.
        default: ValueId,
    },
    /// The value of the arm whose key equals the subject, else the default.
    Case {
        /// The compared value.
        subject: ValueId,
        /// Key and value; keys differ.
        arms: Vec<(Bits, ValueId)>,
        /// The value if no key equals the subject.
        default: ValueId,
    },
    /// The operand's bits from this one up.
    Slice(ValueId, u32),
    /// The operands side by side, the most significant first.
    Concat(Vec<ValueId>),
    /// Copies of the operand side by side; the second field is their number.
    Repeat(ValueId, u32),
    /// The operand widened, with its sign if the flag is set.
    Extend(ValueId, bool),
    /// The word of a memory at an address, asynchronously.
    Read {
        /// The memory, by index.
        memory: u32,
        /// The address.
        address: ValueId,
    },
    /// Adds an axis: the operand, repeated.
    Broadcast {
        /// The operand.
        of: ValueId,
        /// The axis that is added.
        axis: Axis,
    },
    /// Adds an axis: the parts, one after another.
    Stack {
        /// The lanes along the axis; all of one shape.
        parts: Vec<ValueId>,
        /// The number of lanes within one step of the axis.
        inner: u32,
    },
    /// Lane `i` along an axis is lane `index(i)` of the operand.
    Map {
        /// The operand.
        of: ValueId,
        /// The axis, as the operand has it.
        axis: Axis,
        /// The lanes that the result has along it.
        count: u32,
        /// The rule that gives the source lane.
        index: Affine,
        /// Without the axis: the value if the operand has no such lane; present if that occurs.
        edge: Option<ValueId>,
    },
    /// Lane `i` along an axis is lane `i / k` of part `i % k`.
    Interleave {
        /// The parts, `k` of one shape.
        parts: Vec<ValueId>,
        /// The axis, as each part has it.
        axis: Axis,
    },
    /// Removes an axis: one lane along it.
    Lane {
        /// The operand.
        of: ValueId,
        /// The axis, as the operand has it.
        axis: Axis,
        /// The lane.
        index: u32,
    },
    /// Removes an axis: the lane that a number selects, or 0 if there is none.
    Pick {
        /// The operand.
        of: ValueId,
        /// The axis, as the operand has it.
        axis: Axis,
        /// The selected lane, of the result's shape.
        index: ValueId,
    },
    /// Removes an axis: all lanes along it combined.
    Reduce {
        /// The operator.
        by: Reduction,
        /// The operand.
        of: ValueId,
        /// The axis, as the operand has it.
        axis: Axis,
    },
    /// Removes an axis: all lanes along it side by side, lane 0 lowest.
    Pack {
        /// The operand.
        of: ValueId,
        /// The axis, as the operand has it.
        axis: Axis,
    },
    /// Adds an axis: parts of the operand, the lowest in lane 0.
    Unpack {
        /// The operand.
        of: ValueId,
        /// The axis that is added.
        axis: Axis,
    },
    /// Operations that only a lowered function has.
    Lowered(Lowered),
}

/// The machine operations that only lowering makes.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Lowered {
    /// In each lane, the operand's lane with the number in that lane of `at`, which must exist.
    Gather {
        /// The operand.
        of: ValueId,
        /// The selected lane, of the result's shape.
        at: ValueId,
    },
    /// Lane `i` is lane `i - by` of the operand, undefined if there is none.
    Slide {
        /// The operand.
        of: ValueId,
        /// The distance in lanes towards the higher index.
        by: i32,
    },
    /// The stored form of a memory's word, some bits of which may be inverted.
    Word {
        /// The memory, by index.
        memory: u32,
        /// The address.
        address: ValueId,
    },
    /// For each lane, the stored form of the word of the memory lane with a given number, at a common address.
    WordOf {
        /// The memory, by index: it has lanes.
        memory: u32,
        /// The address, in one lane.
        address: ValueId,
        /// The selected lane, of the result's shape.
        at: ValueId,
    },
    /// Very many pieces of values side by side.
    Assemble {
        /// The values, each once.
        of: Vec<ValueId>,
        /// The pieces, the least significant first.
        pieces: Vec<Piece>,
    },
    /// The operand rotated to the left.
    Rotate {
        /// The operand.
        of: ValueId,
        /// The distance in bits, less than its width.
        left: u32,
    },
}

/// Some bits of one of several values.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Piece {
    /// The value, by its index among them.
    pub of: u32,
    /// The first bit.
    pub low: u32,
    /// The number of bits.
    pub width: u32,
}

/// An axis of a value: the value's lanes are `outer` groups of `count` lanes, each of which is `inner` lanes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Axis {
    /// The lanes along it.
    pub count: u32,
    /// The lanes within one step: the distance of two neighbours along it.
    pub inner: u32,
}

impl Axis {
    /// The last axis.
    pub fn last(count: u32) -> Axis {
        Axis { count, inner: 1 }
    }

    /// An axis of a shape.
    pub fn of(shape: Shape, axis: u32) -> Axis {
        Axis { count: shape.extent(axis), inner: shape.inner(axis) }
    }

    /// The number of lanes of the axis and within it.
    pub fn lanes(self) -> u32 {
        self.count * self.inner
    }

    /// The lane of a value with the axis at number `index` along it, for a lane of a value without the axis.
    pub fn at(self, lane: u32, index: u32) -> u32 {
        (lane / self.inner * self.count + index) * self.inner + lane % self.inner
    }

    /// For a lane of a value with the axis: the number along it, and the lane of a value without it.
    pub fn split(self, lane: u32) -> (u32, u32) {
        let (outer, within) = (lane / self.lanes(), lane % self.lanes());
        (within / self.inner, outer * self.inner + within % self.inner)
    }
}

/// Calls `$visit` with a reference to every operand, mutable or not as `$iter` is.
macro_rules! each_operand {
    ($kind:expr, $iter:ident, $visit:ident) => {
        match $kind {
            Kind::State | Kind::Const(_) => {}
            Kind::Alias(a)
            | Kind::Unary(_, a)
            | Kind::Slice(a, _)
            | Kind::Repeat(a, _)
            | Kind::Extend(a, _)
            | Kind::Lowered(Lowered::Rotate { of: a, .. })
            | Kind::Read { address: a, .. }
            | Kind::Lowered(Lowered::Word { address: a, .. })
            | Kind::Broadcast { of: a, .. }
            | Kind::Lowered(Lowered::Slide { of: a, .. })
            | Kind::Lane { of: a, .. }
            | Kind::Reduce { of: a, .. }
            | Kind::Pack { of: a, .. }
            | Kind::Unpack { of: a, .. } => $visit(a),
            Kind::Binary(_, a, b)
            | Kind::Compare(_, _, a, b)
            | Kind::Shift(_, a, b)
            | Kind::Pick { of: a, index: b, .. }
            | Kind::Lowered(Lowered::Gather { of: a, at: b } | Lowered::WordOf { address: a, at: b, .. }) => {
                $visit(a);
                $visit(b);
            }
            Kind::Mux { select, on_true, on_false } => {
                $visit(select);
                $visit(on_true);
                $visit(on_false);
            }
            Kind::Select { arms, default } => {
                arms.$iter().for_each(|(condition, value)| {
                    $visit(condition);
                    $visit(value);
                });
                $visit(default);
            }
            Kind::Case { subject, arms, default } => {
                $visit(subject);
                arms.$iter().for_each(|(_, value)| $visit(value));
                $visit(default);
            }
            Kind::Map { of, edge, .. } => {
                $visit(of);
                edge.$iter().for_each($visit);
            }
            Kind::Concat(parts)
            | Kind::Stack { parts, .. }
            | Kind::Interleave { parts, .. }
            | Kind::Lowered(Lowered::Assemble { of: parts, .. }) => {
                parts.$iter().for_each($visit);
            }
        }
    };
}

impl Kind {
    /// Calls `visit` with every operand.
    pub fn for_each_operand(&self, mut visit: impl FnMut(ValueId)) {
        let mut visit = |operand: &ValueId| visit(*operand);
        each_operand!(self, iter, visit);
    }

    /// Calls `visit` with every operand, which it may replace.
    pub fn rewrite(&mut self, mut visit: impl FnMut(&mut ValueId)) {
        each_operand!(self, iter_mut, visit);
    }

    /// The operand, and its lane, that a movement of lanes copies to a lane; `None` of operations that compute, or that a number steers.
    pub fn source(&self, lane: u32) -> Option<(ValueId, u32)> {
        Some(match *self {
            Kind::Alias(of) => (of, lane),
            Kind::Broadcast { of, axis } => (of, axis.split(lane).1),
            Kind::Stack { ref parts, inner } => {
                let (number, rest) = Axis { count: parts.len() as u32, inner }.split(lane);
                (parts[number as usize], rest)
            }
            Kind::Map { of, axis, count, index, edge } => {
                let (number, rest) = Axis { count, ..axis }.split(lane);
                match index.source(number, axis.count) {
                    Some(from) => (of, axis.at(rest, from)),
                    None => (edge?, rest),
                }
            }
            Kind::Interleave { ref parts, axis } => {
                let all = parts.len() as u32;
                let (number, rest) = Axis { count: axis.count * all, ..axis }.split(lane);
                (parts[(number % all) as usize], axis.at(rest, number / all))
            }
            Kind::Lane { of, axis, index } => (of, axis.at(lane, index)),
            _ => return None,
        })
    }

    /// Whether each lane of the result depends on the same lane of the operands only.
    pub fn is_elementwise(&self) -> bool {
        match self {
            Kind::Unary(..)
            | Kind::Binary(..)
            | Kind::Compare(..)
            | Kind::Shift(..)
            | Kind::Mux { .. }
            | Kind::Select { .. }
            | Kind::Case { .. }
            | Kind::Slice(..)
            | Kind::Concat(_)
            | Kind::Repeat(..)
            | Kind::Extend(..)
            | Kind::Lowered(Lowered::Rotate { .. } | Lowered::Assemble { .. }) => true,
            Kind::State
            | Kind::Const(_)
            | Kind::Alias(_)
            | Kind::Read { .. }
            | Kind::Broadcast { .. }
            | Kind::Stack { .. }
            | Kind::Map { .. }
            | Kind::Interleave { .. }
            | Kind::Lane { .. }
            | Kind::Pick { .. }
            | Kind::Reduce { .. }
            | Kind::Pack { .. }
            | Kind::Unpack { .. }
            | Kind::Lowered(_) => false,
        }
    }
}
