//! Operators with constant operands, or with one operand that determines the result.

use super::Fold;
use super::Outcome::{self, Op as Is, Same};
use crate::verilog::constant;
use crate::verilog::lane_values::known;
use crate::verilog::plan::{MOST_ARMS, MOST_KEYS};
use tilewright_circuit::Bits;
use tilewright_circuit::ir::{Binary, Node, NodeId, Op, Relation, Unary};

/// Longer concatenations are nested: Verilator makes each part one level deeper, and runs out of stack at tens of
/// thousands.
const MOST_PARTS: usize = 256;

/// Verilator 5.006 supports no wider signed product.
pub(super) const WIDEST_SIGNED_PRODUCT: u32 = 512;

impl Fold {
    pub(super) fn unary(&self, unary: Unary, a: NodeId) -> Outcome {
        match self.constant(a) {
            Some(value) => Is(Op::Const(unary.apply(&value))),
            None if unary != Unary::Not && self.width(a) == 1 => Same(a),
            None => match self.module.node(a) {
                Node { op: Op::Unary(Unary::Not, inner), name: None, .. } if unary == Unary::Not => Same(*inner),
                // It has one bit, so this is its inverse.
                Node { op: Op::Compare { relation, signed, operands }, name: None, .. } => {
                    Is(Op::Compare { relation: opposite(*relation), signed: *signed, operands: *operands })
                }
                _ => Is(Op::Unary(unary, a)),
            },
        }
    }

    pub(super) fn binary(&self, binary: Binary, a: NodeId, b: NodeId) -> Outcome {
        let values = (self.constant(a), self.constant(b));
        if let (Some(a), Some(b)) = &values
            && let Some(value) = constant::binary(binary, a, b)
        {
            return Is(Op::Const(value));
        }
        let zero = |value: &Option<Bits>| value.as_ref().is_some_and(Bits::is_zero);
        let ones = |value: &Option<Bits>| value.as_ref().is_some_and(|value| value.not().is_zero());
        match binary {
            Binary::Xor | Binary::Sub if a == b => Is(Op::Const(Bits::zero(self.width(a)))),
            Binary::And | Binary::Or if a == b => Same(a),
            Binary::And if self.are_opposite(a, b) => Is(Op::Const(Bits::zero(self.width(a)))),
            Binary::Or | Binary::Xor if self.are_opposite(a, b) => Is(Op::Const(Bits::ones(self.width(a)))),
            Binary::Mul | Binary::MulSigned if zero(&values.0) || zero(&values.1) => {
                Is(Op::Const(Bits::zero(self.width(a) + self.width(b))))
            }
            Binary::Add | Binary::Or | Binary::Xor if zero(&values.0) => Same(b),
            Binary::Add | Binary::Sub | Binary::Or | Binary::Xor if zero(&values.1) => Same(a),
            Binary::And if zero(&values.0) || ones(&values.1) => Same(a),
            Binary::And if zero(&values.1) || ones(&values.0) => Same(b),
            Binary::Or if ones(&values.0) => Same(a),
            Binary::Or if ones(&values.1) => Same(b),
            _ => Is(Op::Binary(binary, a, b)),
        }
    }

    /// A signed product as the low half of an unsigned one, with factors of its width.
    pub(super) fn wide_product(&mut self, id: NodeId, a: NodeId, b: NodeId) -> Outcome {
        let width = self.width(id);
        let [a, b] = [a, b].map(|of| self.add(id, width, Op::Extend { of, signed: true }));
        let product = self.add(id, 2 * width, Op::Binary(Binary::Mul, a, b));
        self.slice(id, product, 0, width)
    }

    /// Whether one is the other inverted.
    fn are_opposite(&self, a: NodeId, b: NodeId) -> bool {
        let inverts = |a, b| self.module.node(a).op == Op::Unary(Unary::Not, b);
        inverts(a, b) || inverts(b, a)
    }

    pub(super) fn compare(&self, relation: Relation, signed: bool, a: NodeId, b: NodeId) -> Outcome {
        let width = self.width(a);
        let (lowest, highest) = constant::range(width, signed);
        let truth = |value: bool| Is(Op::Const(Bits::from(value)));
        let is = |value: &Option<Bits>, what: &Bits| value.as_ref() == Some(what);
        // Linters compute a lane from constants, too.
        let value = |id| if self.module.shape(id).is_plain() { known(&self.module, id, 0) } else { self.constant(id) };
        let (left, right) = (value(a), value(b));
        if let (Some(left), Some(right)) = (&left, &right) {
            return truth(relation.holds(signed, left, right));
        }
        if a == b {
            return truth(matches!(relation, Relation::Eq | Relation::Le | Relation::Ge));
        }
        match relation {
            Relation::Lt if is(&right, &lowest) || is(&left, &highest) => truth(false),
            Relation::Gt if is(&right, &highest) || is(&left, &lowest) => truth(false),
            Relation::Le if is(&right, &highest) || is(&left, &lowest) => truth(true),
            Relation::Ge if is(&right, &lowest) || is(&left, &highest) => truth(true),
            Relation::Eq | Relation::Ne if width == 1 && (left.is_some() || right.is_some()) => {
                let (value, other) = if let Some(value) = left { (value, b) } else { (right.expect("a constant"), a) };
                match (relation == Relation::Eq) != value.is_zero() {
                    true => Same(other),
                    false => self.unary(Unary::Not, other),
                }
            }
            _ => Is(Op::Compare { relation, signed, operands: [a, b] }),
        }
    }

    pub(super) fn mux(&self, select: NodeId, on_true: NodeId, on_false: NodeId) -> Outcome {
        if let Some(select) = self.constant(select) {
            return Same(if select.is_zero() { on_false } else { on_true });
        }
        if on_true == on_false {
            return Same(on_true);
        }
        let bit = |id: NodeId| (self.width(id) == 1).then(|| self.constant(id)).flatten().map(|value| !value.is_zero());
        match (bit(on_true), bit(on_false)) {
            (Some(true), Some(false)) => Same(select),
            (Some(false), Some(true)) => self.unary(Unary::Not, select),
            _ => Is(Op::Mux { select, on_true, on_false }),
        }
    }

    pub(super) fn select(&mut self, id: NodeId, arms: Vec<(NodeId, NodeId)>, default: NodeId) -> Outcome {
        let (mut kept, mut default) = (Vec::with_capacity(arms.len()), default);
        for (condition, value) in arms {
            match self.constant(condition) {
                Some(never) if never.is_zero() => {}
                Some(_) => {
                    default = value;
                    break;
                }
                None => kept.push((condition, value)),
            }
        }
        while kept.last().is_some_and(|&(_, value)| value == default) {
            kept.pop();
        }
        // Each part of a long choice may become a net.
        while kept.len() > MOST_ARMS {
            let arms = kept.split_off((kept.len() - 1) / MOST_ARMS * MOST_ARMS);
            default = self.add(id, self.width(id), Op::Select { arms, default });
        }
        match kept[..] {
            [] => Same(default),
            [(select, on_true)] => self.mux(select, on_true, default),
            _ => Is(Op::Select { arms: kept, default }),
        }
    }

    /// Each part of a long `case` becomes a net, which is the default of the previous part.
    pub(super) fn case(
        &mut self,
        id: NodeId,
        subject: NodeId,
        mut arms: Vec<(Bits, NodeId)>,
        mut default: NodeId,
    ) -> Outcome {
        while arms.len() > MOST_KEYS {
            let arms = arms.split_off((arms.len() - 1) / MOST_KEYS * MOST_KEYS);
            default = self.add(id, self.width(id), Op::Case { subject, arms, default });
        }
        Is(Op::Case { subject, arms, default })
    }

    pub(super) fn extend(&self, of: NodeId, signed: bool, width: u32) -> Outcome {
        match self.constant(of) {
            _ if self.width(of) == width => Same(of),
            Some(value) if signed => Is(Op::Const(value.sext(width))),
            Some(value) => Is(Op::Const(value.resize(width))),
            None => match self.module.node(of) {
                Node { op: Op::Extend { of: inner, signed: false }, name: None, .. } if !signed => {
                    Is(Op::Extend { of: *inner, signed })
                }
                _ => Is(Op::Extend { of, signed }),
            },
        }
    }

    /// A slice of a concatenation is a slice of its parts: the whole needs no name.
    pub(super) fn slice(&mut self, id: NodeId, of: NodeId, low: u32, width: u32) -> Outcome {
        if width == self.width(of) {
            return Same(of);
        }
        if let Some(value) = self.constant(of) {
            return Is(Op::Const(value.slice(low..low + width)));
        }
        let node = self.module.node(of);
        if node.name.is_some() {
            return Is(Op::Slice { of, low });
        }
        match &node.op {
            &Op::Slice { of: inner, low: base } => self.slice(id, inner, base + low, width),
            &Op::Extend { of: inner, .. } if low + width <= self.width(inner) => self.slice(id, inner, low, width),
            &Op::Extend { of: inner, signed: false } => match self.width(inner) {
                inner_width if low >= inner_width => Is(Op::Const(Bits::zero(width))),
                inner_width => {
                    let kept = self.add(id, inner_width - low, Op::Slice { of: inner, low });
                    self.extend(kept, false, width)
                }
            },
            Op::Concat(parts) => {
                let parts = parts.clone();
                self.slice_of_parts(id, parts, low, width)
            }
            _ => Is(Op::Slice { of, low }),
        }
    }

    fn slice_of_parts(&mut self, id: NodeId, parts: Vec<NodeId>, low: u32, width: u32) -> Outcome {
        let (mut base, mut taken) = (0, Vec::new());
        for part in parts.into_iter().rev() {
            let end = base + self.width(part);
            let (from, to) = (low.max(base), (low + width).min(end));
            if (from, to) == (low, low + width) {
                return self.slice(id, part, low - base, width);
            }
            if from < to {
                taken.insert(0, self.add(id, to - from, Op::Slice { of: part, low: from - base }));
            }
            base = end;
        }
        self.concat(id, taken)
    }

    pub(super) fn concat(&mut self, id: NodeId, mut parts: Vec<NodeId>) -> Outcome {
        if let [part] = parts[..] {
            return Same(part);
        }
        let values: Option<Vec<Bits>> = parts.iter().rev().map(|&part| self.constant(part)).collect();
        if let Some(values) = values {
            return Is(Op::Const(Bits::join(&values)));
        }
        while parts.len() > MOST_PARTS {
            parts = parts.chunks(MOST_PARTS).map(|parts| self.joined(id, parts)).collect::<Vec<_>>();
        }
        Is(Op::Concat(parts))
    }

    fn joined(&mut self, id: NodeId, parts: &[NodeId]) -> NodeId {
        let width = parts.iter().map(|&part| self.width(part)).sum();
        self.add(id, width, Op::Concat(parts.to_vec()))
    }
}

/// The negated relation.
fn opposite(relation: Relation) -> Relation {
    match relation {
        Relation::Eq => Relation::Ne,
        Relation::Ne => Relation::Eq,
        Relation::Lt => Relation::Ge,
        Relation::Ge => Relation::Lt,
        Relation::Gt => Relation::Le,
        Relation::Le => Relation::Gt,
    }
}
