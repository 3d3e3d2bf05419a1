//! How a node is computed.

use super::{InstanceId, MemoryId, NodeId, RegisterId};
use crate::bits::Bits;

/// Operators of one operand.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Unary {
    /// Every bit inverted.
    Not,
    /// 1 bit: all bits are one.
    AllOnes,
    /// 1 bit: some bit is one.
    AnyOne,
    /// 1 bit: the number of ones is odd.
    Parity,
}

/// Operators of two operands of equal widths, with a result of that width except where said.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Binary {
    /// Bitwise and.
    And,
    /// Bitwise or.
    Or,
    /// Bitwise exclusive or.
    Xor,
    /// Sum, modulo 2 to the width.
    Add,
    /// Difference, modulo 2 to the width.
    Sub,
    /// Unsigned product; operands of any widths, the result's width is their sum.
    Mul,
    /// Two's complement product; operands of any widths, the result's width is their sum.
    MulSigned,
}

/// Comparisons.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Relation {
    /// Equal.
    Eq,
    /// Not equal.
    Ne,
    /// Less than.
    Lt,
    /// Less than or equal.
    Le,
    /// Greater than.
    Gt,
    /// Greater than or equal.
    Ge,
}

/// Shifts by an amount that is a signal.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Shift {
    /// Towards the most significant bit, filled with zeros.
    Left,
    /// Towards the least significant bit, filled with zeros.
    Right,
    /// Towards the least significant bit, filled with the sign.
    RightSigned,
}

/// Combinations of all lanes into one plain value.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Reduction {
    /// Bitwise and of all lanes.
    And,
    /// Bitwise or of all lanes.
    Or,
    /// Bitwise exclusive or of all lanes.
    Xor,
    /// Sum of all lanes, modulo 2 to the width.
    Add,
}

impl Reduction {
    /// The operator that combines two lanes.
    pub fn operator(self) -> Binary {
        match self {
            Reduction::And => Binary::And,
            Reduction::Or => Binary::Or,
            Reduction::Xor => Binary::Xor,
            Reduction::Add => Binary::Add,
        }
    }
}

/// How a node is computed.
#[derive(Debug, Clone, PartialEq)]
pub enum Op {
    /// The input port of that index in [`Module::inputs`](crate::ir::Module::inputs).
    Input(u32),
    /// A constant of the node's width.
    Const(Bits),
    /// An operator of one operand.
    Unary(Unary, NodeId),
    /// An operator of two operands.
    Binary(Binary, NodeId, NodeId),
    /// 1 bit; operands of equal widths; in two's complement if `signed`.
    Compare {
        /// The relation.
        relation: Relation,
        /// Whether the operands are in two's complement.
        signed: bool,
        /// Left and right operand.
        operands: [NodeId; 2],
    },
    /// The operand shifted by an unsigned amount of any width; an amount of the width or more leaves only filling.
    Shift(Shift, NodeId, NodeId),
    /// `if select { on_true } else { on_false }`; `select` has 1 bit.
    Mux {
        /// 1 bit.
        select: NodeId,
        /// The value where `select` is 1.
        on_true: NodeId,
        /// The value where `select` is 0.
        on_false: NodeId,
    },
    /// The value of the first arm whose 1-bit condition holds, else the default.
    Select {
        /// Condition and value, highest priority first.
        arms: Vec<(NodeId, NodeId)>,
        /// The value where no condition holds.
        default: NodeId,
    },
    /// The value of the arm whose key equals the subject, else the default; keys differ and have the subject's width.
    Case {
        /// What is compared.
        subject: NodeId,
        /// Key and value.
        arms: Vec<(Bits, NodeId)>,
        /// The value where no key equals the subject.
        default: NodeId,
    },
    /// Bits `low .. low + width` of the operand.
    Slice {
        /// The operand.
        of: NodeId,
        /// The lowest bit taken.
        low: u32,
    },
    /// The operands side by side, the most significant first.
    Concat(Vec<NodeId>),
    /// The operand side by side with itself, so many times.
    Repeat(NodeId, u32),
    /// The operand widened, with its sign bit if `signed`, otherwise with zeros.
    Extend {
        /// The operand, narrower than the node.
        of: NodeId,
        /// Whether the sign bit fills the new bits.
        signed: bool,
    },
    /// The present value of a register.
    Register(RegisterId),
    /// The data of a memory's read port of that index in [`Memory::reads`](crate::ir::Memory::reads).
    Read(MemoryId, u32),
    /// A named net declared before its driver.
    Wire(NodeId),
    /// The operand, which the description declares stable whenever another clock samples it, with the reason.
    QuasiStatic(NodeId, String),
    /// The output port of an instance; with lanes if the instance is an array.
    Output(InstanceId, u32),
    /// Lanes: the plain operand in every lane.
    Broadcast(NodeId),
    /// Lanes: plain operands, one for each lane.
    PerLane(Vec<NodeId>),
    /// Lanes: lane `i` is lane `i - by` of the operand, or the plain `edge` where there is no such lane.
    Shifted {
        /// The operand, with as many lanes.
        of: NodeId,
        /// How many lanes towards the higher index; negative towards the lower.
        by: i32,
        /// Plain: what enters at the end.
        edge: NodeId,
    },
    /// Plain: one lane of the operand.
    Lane(NodeId, u32),
    /// Plain: all lanes of the operand combined.
    Reduce(Reduction, NodeId),
}

impl Op {
    /// Whether the node is its operands, or a constant or the state of a register, without logic: at most inverted.
    pub(crate) fn is_wiring(&self) -> bool {
        matches!(
            self,
            Op::Const(_)
                | Op::Register(_)
                | Op::Wire(_)
                | Op::QuasiStatic(..)
                | Op::Unary(Unary::Not, _)
                | Op::Slice { .. }
                | Op::Concat(_)
                | Op::Repeat(..)
                | Op::Extend { .. }
                | Op::Broadcast(_)
                | Op::PerLane(_)
                | Op::Shifted { .. }
                | Op::Lane(..)
        )
    }

    /// Calls `visit` with every node of the same module that this one is computed from in the same clock cycle,
    /// except through an instance or an asynchronous read.
    pub fn for_each_operand(&self, mut visit: impl FnMut(NodeId)) {
        match self {
            Op::Input(_) | Op::Const(_) | Op::Register(_) | Op::Read(..) | Op::Output(..) => {}
            Op::Unary(_, a)
            | Op::Slice { of: a, .. }
            | Op::Repeat(a, _)
            | Op::Extend { of: a, .. }
            | Op::Wire(a)
            | Op::QuasiStatic(a, _)
            | Op::Broadcast(a)
            | Op::Lane(a, _)
            | Op::Reduce(_, a) => visit(*a),
            Op::Binary(_, a, b) | Op::Compare { operands: [a, b], .. } | Op::Shift(_, a, b) => {
                visit(*a);
                visit(*b);
            }
            Op::Shifted { of, edge, .. } => {
                visit(*of);
                visit(*edge);
            }
            Op::Mux { select, on_true, on_false } => [select, on_true, on_false].into_iter().for_each(|n| visit(*n)),
            Op::Select { arms, default } => {
                arms.iter().flat_map(|(c, v)| [*c, *v]).for_each(&mut visit);
                visit(*default);
            }
            Op::Case { subject, arms, default } => {
                visit(*subject);
                arms.iter().for_each(|(_, v)| visit(*v));
                visit(*default);
            }
            Op::Concat(parts) | Op::PerLane(parts) => parts.iter().for_each(|n| visit(*n)),
        }
    }
}
