//! How a value is computed from others: the operators of the circuit, made flat.

use tilewright_hdl::Bits;
use tilewright_hdl::ir::{Binary, Reduction, Relation, Shift, Unary};

use super::ValueId;

/// An operation. Elementwise kinds have operands of as many lanes as the result; widths are as for the operator of
/// the same name in [`tilewright_hdl::ir::Op`].
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Kind {
    /// Set from outside the expressions: an input, a register, the data of a synchronous read.
    State,
    /// The same in every lane.
    Const(Bits),
    /// The same as another value of the same shape.
    Alias(ValueId),
    /// An operator of one operand.
    Unary(Unary, ValueId),
    /// An operator of two operands.
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
    /// The value of the first arm whose condition holds, else the default.
    Select {
        /// Condition and value, highest priority first.
        arms: Vec<(ValueId, ValueId)>,
        /// The value where no condition holds.
        default: ValueId,
    },
    /// The value of the arm whose key equals the subject, else the default.
    Case {
        /// What is compared.
        subject: ValueId,
        /// Key and value; keys differ.
        arms: Vec<(Bits, ValueId)>,
        /// The value where no key equals the subject.
        default: ValueId,
    },
    /// The operand's bits from this one up.
    Slice(ValueId, u32),
    /// The operands side by side, the most significant first.
    Concat(Vec<ValueId>),
    /// The operand side by side with itself, so many times.
    Repeat(ValueId, u32),
    /// The operand widened, with its sign if the flag is set.
    Extend(ValueId, bool),
    /// The word of a memory at an address, at once.
    Read {
        /// The memory, by index.
        memory: u32,
        /// The address.
        address: ValueId,
    },
    /// From `L` lanes to `L * n`: each lane `n` times over.
    Broadcast(ValueId, u32),
    /// From `n` lanes to `n * m`: all lanes, `m` times over.
    Tile(ValueId, u32),
    /// From `L` lanes to `L * n`: lane `outer * n + i` is lane `outer` of operand `i`.
    PerLane(Vec<ValueId>),
    /// Within each group of `n` lanes: lane `i` is lane `i - by` of the operand, or its group's lane of `edge`.
    Shifted {
        /// `L * n` lanes.
        of: ValueId,
        /// How many lanes towards the higher index.
        by: i32,
        /// `L` lanes.
        edge: ValueId,
        /// The lanes of a group, `n`.
        group: u32,
    },
    /// From `L * n` lanes to `L`: lane `index` of each group of `n`.
    Lane {
        /// `L * n` lanes.
        of: ValueId,
        /// The lane within the group.
        index: u32,
        /// The lanes of a group, `n`.
        group: u32,
    },
    /// From `L * n` lanes to `L`: each group of `n` combined.
    Reduce {
        /// How.
        by: Reduction,
        /// `L * n` lanes.
        of: ValueId,
        /// The lanes of a group, `n`.
        group: u32,
    },
}

/// Calls `$visit` with a reference to every operand, shared or not as `$iter` says.
macro_rules! each_operand {
    ($kind:expr, $iter:ident, $visit:ident) => {
        match $kind {
            Kind::State | Kind::Const(_) => {}
            Kind::Alias(a)
            | Kind::Unary(_, a)
            | Kind::Slice(a, _)
            | Kind::Repeat(a, _)
            | Kind::Extend(a, _)
            | Kind::Read { address: a, .. }
            | Kind::Broadcast(a, _)
            | Kind::Tile(a, _)
            | Kind::Lane { of: a, .. }
            | Kind::Reduce { of: a, .. } => $visit(a),
            Kind::Binary(_, a, b)
            | Kind::Compare(_, _, a, b)
            | Kind::Shift(_, a, b)
            | Kind::Shifted { of: a, edge: b, .. } => {
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
            Kind::Concat(parts) | Kind::PerLane(parts) => parts.$iter().for_each($visit),
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

    /// Whether each lane of the result depends on the same lane of the operands alone.
    pub fn is_elementwise(&self) -> bool {
        !matches!(
            self,
            Kind::State
                | Kind::Const(_)
                | Kind::Alias(_)
                | Kind::Read { .. }
                | Kind::Broadcast(..)
                | Kind::Tile(..)
                | Kind::PerLane(_)
                | Kind::Shifted { .. }
                | Kind::Lane { .. }
                | Kind::Reduce { .. }
        )
    }
}
