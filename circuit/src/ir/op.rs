//! The operations of nodes.

use super::{Affine, InstanceId, MemoryId, NodeId, RegisterId};
use crate::bits::Bits;

/// Operators with one operand.
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = tilewright_sim::shown! { |_, i| in { word: bits(8) } out { full: bit() }
/// let full = i.word.all_ones();
/// #     ShownOut { full }
/// # };
/// let top = design.top();
/// assert!(matches!(top.node(top.outputs[0].node).op, ir::Op::Unary(ir::Unary::AllOnes, _)));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Unary {
    /// Every bit inverted.
    Not,
    /// 1 bit: all bits are one.
    AllOnes,
    /// 1 bit: at least one bit is one.
    AnyOne,
    /// 1 bit: the number of ones is odd.
    Parity,
}

/// Operators with two operands of equal widths. The result has that width unless stated otherwise.
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = tilewright_sim::shown! { |_, i| in { a: bits(8), b: bits(8).signed() } out { product: _ }
/// let product = i.a.signed() * i.b;
/// #     ShownOut { product }
/// # };
/// // The operation says that it is signed; the kinds of its operands do not change it.
/// let top = design.top();
/// assert!(matches!(top.node(top.outputs[0].node).op, ir::Op::Binary(ir::Binary::MulSigned, ..)));
/// ```
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
    /// Unsigned product; the operands may differ in width, and the result's width is their sum.
    Mul,
    /// Two's complement product; the operands may differ in width, and the result's width is their sum.
    MulSigned,
}

/// Comparisons.
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = tilewright_sim::shown! { |_, i| in { a: bits(8).signed(), b: bits(8).signed() } out { less: bit() }
/// let less = i.a.lt(i.b);
/// #     ShownOut { less }
/// # };
/// let top = design.top();
/// let op = &top.node(top.outputs[0].node).op;
/// assert!(matches!(op, ir::Op::Compare { relation: ir::Relation::Lt, signed: true, .. }));
/// ```
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
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = tilewright_sim::shown! { |_, i| in { word: bits(8), amount: bits(3) } out { by_signal: bits(8), by_two: bits(8) }
/// let (by_signal, by_two) = (i.word << i.amount, i.word << 2);
/// #     ShownOut { by_signal, by_two }
/// # };
/// // A shift by a constant is wiring, not a shift.
/// let top = design.top();
/// let op = |output: usize| &top.node(top.outputs[output].node).op;
/// assert!(matches!(op(0), ir::Op::Shift(ir::Shift::Left, ..)));
/// assert!(matches!(op(1), ir::Op::Concat(_)));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Shift {
    /// Towards the most significant bit, filled with zeros.
    Left,
    /// Towards the least significant bit, filled with zeros.
    Right,
    /// Towards the least significant bit, filled with the sign.
    RightSigned,
}

/// Operators that combine all lanes along an axis into one.
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = tilewright_sim::shown! { |_, i| in { depths: bits(8).of(row(4)) } out { nearest: bits(8) }
/// let nearest = i.depths.minimum();
/// #     ShownOut { nearest }
/// # };
/// let top = design.top();
/// let op = &top.node(top.outputs[0].node).op;
/// assert!(matches!(op, ir::Op::Reduce { by: ir::Reduction::Min, axis: 0, .. }));
/// ```
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
    /// The smallest lane, as an unsigned number.
    Min,
    /// The largest lane, as an unsigned number.
    Max,
}

impl Reduction {
    /// The operator that combines two lanes; `None` for [`Min`](Reduction::Min) and [`Max`](Reduction::Max), which
    /// compare and choose.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// use tilewright_hdl::ir::{Binary, Reduction};
    ///
    /// assert_eq!(Reduction::Xor.operator(), Some(Binary::Xor));
    /// assert_eq!(Reduction::Max.operator(), None);
    /// ```
    pub fn operator(self) -> Option<Binary> {
        match self {
            Reduction::And => Some(Binary::And),
            Reduction::Or => Some(Binary::Or),
            Reduction::Xor => Some(Binary::Xor),
            Reduction::Add => Some(Binary::Add),
            Reduction::Min | Reduction::Max => None,
        }
    }
}

/// The operation of a node.
///
/// Operations up to [`Output`](Op::Output) are elementwise: their operands have the node's shape, and each lane is
/// computed from the same lane of the operands. The others change the shape along one axis.
///
/// ```
/// # use tilewright_hdl::*;
/// use tilewright_hdl::ir::Op;
/// # block! {
/// #     struct Masked;
/// #     in MaskedIn { word: bits(8), mask: bits(8) }
/// #     out MaskedOut { masked: bits(8) }
/// # }
/// # impl Masked {
/// #     fn build(&self, _: Module, i: MaskedIn) -> MaskedOut {
/// #         MaskedOut { masked: i.word & !i.mask }
/// #     }
/// # }
///
/// // `i.word & !i.mask`
/// let design = elaborate(&Masked)?;
/// let top = design.top();
/// let Op::Binary(ir::Binary::And, word, inverted) = top.node(top.outputs[0].node).op else { panic!("an and") };
/// assert_eq!(top.node(word).op, Op::Input(0));
/// assert!(matches!(top.node(inverted).op, Op::Unary(ir::Unary::Not, _)));
/// # Ok::<(), Problems>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub enum Op {
    /// The input port with this index in [`Module::inputs`](crate::ir::Module::inputs).
    Input(u32),
    /// A constant of the node's width, the same in every lane.
    Const(Bits),
    /// An operator with one operand.
    Unary(Unary, NodeId),
    /// An operator with two operands.
    Binary(Binary, NodeId, NodeId),
    /// 1 bit. The operands have equal widths, and are compared in two's complement if `signed`.
    Compare {
        /// The relation.
        relation: Relation,
        /// Whether the operands are in two's complement.
        signed: bool,
        /// Left and right operand.
        operands: [NodeId; 2],
    },
    /// The operand shifted by an unsigned amount of any width. If the amount is the width or more, only fill bits
    /// remain.
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
    /// The value of the first arm whose 1-bit condition is true, else the default.
    Select {
        /// Condition and value, highest priority first.
        arms: Vec<(NodeId, NodeId)>,
        /// The value if no condition is true.
        default: NodeId,
    },
    /// The value of the arm whose key equals the subject, else the default. Keys differ and have the subject's width.
    Case {
        /// The compared value.
        subject: NodeId,
        /// Key and value.
        arms: Vec<(Bits, NodeId)>,
        /// The value if no key equals the subject.
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
    /// Copies of the operand side by side; the second field is their number.
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
    /// The data of the memory's read port with this index in [`Memory::reads`](crate::ir::Memory::reads).
    Read(MemoryId, u32),
    /// A named net declared before its driver.
    Wire(NodeId),
    /// The operand, which the description declares stable whenever another clock samples it, and the reason.
    QuasiStatic(NodeId, String),
    /// The output port of an instance; of the instance's shape followed by that of the port.
    Output(InstanceId, u32),
    /// The operand, which lacks the axis, repeated in every lane along it.
    Broadcast {
        /// The operand, of the node's shape without the axis.
        of: NodeId,
        /// An axis of the node.
        axis: u32,
    },
    /// Lane `i` along the axis is part `i`.
    Stack {
        /// One for each of the node's lanes along the axis, of the node's shape without the axis.
        parts: Vec<NodeId>,
        /// An axis of the node.
        axis: u32,
    },
    /// Lane `i` along the axis is lane `index(i)` of the operand, or `edge` if that is out of range.
    Map {
        /// The operand; its number of lanes along the axis may differ from the node's.
        of: NodeId,
        /// An axis of both.
        axis: u32,
        /// The rule that gives the source lane.
        index: Affine,
        /// The value of lanes whose source is out of range, of the node's shape without the axis; given if and only
        /// if there are such lanes.
        edge: Option<NodeId>,
    },
    /// Lane `i` along the axis is lane `i / k` of part `i % k`, where `k` is the number of parts.
    Interleave {
        /// All of one shape; the node's lanes along the axis are those of all parts together.
        parts: Vec<NodeId>,
        /// An axis of the node and of the parts.
        axis: u32,
    },
    /// One lane of the operand along the axis; the axis is dropped.
    Lane {
        /// The operand.
        of: NodeId,
        /// An axis of the operand.
        axis: u32,
        /// The lane, below the operand's number of lanes along the axis.
        index: u32,
    },
    /// The lane of the operand along the axis that a signal selects; the axis is dropped. Zero if the index is out of
    /// range.
    Pick {
        /// The operand.
        of: NodeId,
        /// An axis of the operand.
        axis: u32,
        /// The selected lane, unsigned, of any width and of the node's shape.
        index: NodeId,
    },
    /// All lanes of the operand along the axis combined; the axis is dropped.
    Reduce {
        /// The operator that combines two lanes.
        by: Reduction,
        /// The operand.
        of: NodeId,
        /// An axis of the operand.
        axis: u32,
    },
    /// The lanes of the operand along the axis side by side, lane 0 in the lowest bits; the axis is dropped.
    Pack {
        /// The operand.
        of: NodeId,
        /// An axis of the operand.
        axis: u32,
    },
    /// The reverse of [`Pack`](Op::Pack): lane `i` along the axis is bits `i * width .. (i + 1) * width` of the operand.
    Unpack {
        /// The operand, of the node's shape without the axis.
        of: NodeId,
        /// An axis of the node.
        axis: u32,
    },
}

// Calls `$visit` with a reference to every operand, mutable or not as `$iter` is.
macro_rules! each_operand {
    ($op:expr, $iter:ident, $visit:ident) => {
        match $op {
            Op::Input(_) | Op::Const(_) | Op::Register(_) | Op::Read(..) | Op::Output(..) => {}
            Op::Unary(_, a)
            | Op::Slice { of: a, .. }
            | Op::Repeat(a, _)
            | Op::Extend { of: a, .. }
            | Op::Wire(a)
            | Op::QuasiStatic(a, _)
            | Op::Broadcast { of: a, .. }
            | Op::Lane { of: a, .. }
            | Op::Reduce { of: a, .. }
            | Op::Pack { of: a, .. }
            | Op::Unpack { of: a, .. } => $visit(a),
            Op::Binary(_, a, b)
            | Op::Compare { operands: [a, b], .. }
            | Op::Shift(_, a, b)
            | Op::Pick { of: a, index: b, .. } => {
                $visit(a);
                $visit(b);
            }
            Op::Map { of, edge, .. } => {
                $visit(of);
                edge.$iter().for_each($visit);
            }
            Op::Mux { select, on_true, on_false } => [select, on_true, on_false].into_iter().for_each($visit),
            Op::Select { arms, default } => {
                arms.$iter().for_each(|(condition, value)| {
                    $visit(condition);
                    $visit(value);
                });
                $visit(default);
            }
            Op::Case { subject, arms, default } => {
                $visit(subject);
                arms.$iter().for_each(|(_, value)| $visit(value));
                $visit(default);
            }
            Op::Concat(parts) | Op::Stack { parts, .. } | Op::Interleave { parts, .. } => {
                parts.$iter().for_each($visit)
            }
        }
    };
}

impl Op {
    /// Whether the node is its operands, a constant or the state of a register, without logic except for an
    /// inversion.
    #[doc(hidden)]
    pub fn is_wiring(&self) -> bool {
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
                | Op::Broadcast { .. }
                | Op::Stack { .. }
                | Op::Map { .. }
                | Op::Interleave { .. }
                | Op::Lane { .. }
                | Op::Pack { .. }
                | Op::Unpack { .. }
        )
    }

    /// Calls `visit` with every node of the same module that this one depends on in the same clock cycle, except
    /// through an instance or an asynchronous read.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// use tilewright_hdl::ir::{NodeId, Op};
    ///
    /// let [select, on_true, on_false] = [5, 3, 4].map(NodeId);
    /// let mut operands = Vec::new();
    /// Op::Mux { select, on_true, on_false }.for_each_operand(|node| operands.push(node.0));
    /// assert_eq!(operands, [5, 3, 4]);
    /// // The value of a register depends on nothing in the same clock.
    /// Op::Register(ir::RegisterId(0)).for_each_operand(|_| unreachable!("no operand"));
    /// ```
    pub fn for_each_operand(&self, mut visit: impl FnMut(NodeId)) {
        let mut visit = |operand: &NodeId| visit(*operand);
        each_operand!(self, iter, visit);
    }

    /// Calls `visit` with the operands of [`for_each_operand`](Op::for_each_operand), which it may replace.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// use tilewright_hdl::ir::{NodeId, Op};
    ///
    /// let mut op = Op::Concat(vec![NodeId(1), NodeId(2)]);
    /// op.for_each_operand_mut(|node| node.0 += 10);
    /// assert_eq!(op, Op::Concat(vec![NodeId(11), NodeId(12)]));
    /// ```
    pub fn for_each_operand_mut<'a>(&'a mut self, mut visit: impl FnMut(&'a mut NodeId)) {
        each_operand!(self, iter_mut, visit);
    }
}
