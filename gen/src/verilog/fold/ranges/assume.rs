//! Conclusions from a condition about the nodes that it is computed from.

use super::interval::Range;
use super::{Ranges, WIDEST};
use tilewright_circuit::ir::{Binary, NodeId, Op, Relation, Unary};

impl Ranges<'_> {
    /// The range of a node if a condition has the value `so`; `None` if it never has.
    pub fn where_it_is(&mut self, condition: NodeId, so: bool, id: NodeId, depth: u32) -> Option<Range> {
        let mark = self.before.len();
        let range = if self.assume(condition, so, depth) { self.range(id, depth) } else { None };
        self.forget(mark);
        range
    }

    pub fn forget(&mut self, mark: usize) {
        for (id, range) in self.before.drain(mark..).rev() {
            match range {
                Some(range) => _ = self.known.insert(id, range),
                None => _ = self.known.remove(&id),
            }
        }
    }

    /// Assumes that a condition has the value `so`; returns whether that is possible.
    pub fn assume(&mut self, condition: NodeId, so: bool, depth: u32) -> bool {
        if !self.narrow(condition, Some(Range::one(so.into()))) {
            return false;
        }
        if depth == 0 {
            return true;
        }
        match self.module.node(condition).op {
            Op::Wire(of) | Op::QuasiStatic(of, _) => self.assume(of, so, depth - 1),
            Op::Unary(Unary::Not, of) => self.assume(of, !so, depth - 1),
            Op::Binary(Binary::And, a, b) if so => self.assume(a, so, depth - 1) && self.assume(b, so, depth - 1),
            Op::Binary(Binary::Or, a, b) if !so => self.assume(a, so, depth - 1) && self.assume(b, so, depth - 1),
            Op::Compare { relation, signed, operands } => {
                self.assume_relation(relation, signed, operands, so, depth - 1)
            }
            _ => true,
        }
    }

    fn assume_relation(&mut self, relation: Relation, signed: bool, [a, b]: [NodeId; 2], so: bool, depth: u32) -> bool {
        let (Some(left), Some(right)) = (self.range(a, depth), self.range(b, depth)) else { return false };
        let is_wide = self.module.width(a) > WIDEST;
        if is_wide || signed && !matches!(relation, Relation::Eq | Relation::Ne) {
            return true;
        }
        // `a < b`, and `a <= b`.
        let less = |this: &mut Self, (a, left): (NodeId, Range), (b, right): (NodeId, Range), apart: u64| {
            let below = right.high.checked_sub(apart).map(|high| Range { low: 0, high });
            let above = left.low.checked_add(apart).map(|low| Range { low, high: u64::MAX });
            this.narrow(a, below) && this.narrow(b, above)
        };
        let (a, b) = ((a, left), (b, right));
        match (relation, so) {
            (Relation::Eq, true) | (Relation::Ne, false) => {
                self.narrow(a.0, Some(right)) && self.narrow(b.0, Some(left))
            }
            (Relation::Ne, true) | (Relation::Eq, false) => {
                let other = |one: Range, of: Range| if of.low == of.high { one.without(of.low) } else { Some(one) };
                self.narrow(a.0, other(left, right)) && self.narrow(b.0, other(right, left))
            }
            (Relation::Lt, true) | (Relation::Ge, false) => less(self, a, b, 1),
            (Relation::Le, true) | (Relation::Gt, false) => less(self, a, b, 0),
            (Relation::Gt, true) | (Relation::Le, false) => less(self, b, a, 1),
            (Relation::Ge, true) | (Relation::Lt, false) => less(self, b, a, 0),
        }
    }

    /// Assumes that a node's value is in a range; returns whether that is possible.
    pub fn narrow(&mut self, mut id: NodeId, range: Option<Range>) -> bool {
        let Some(range) = range else { return false };
        loop {
            let now = self.known.get(&id).copied();
            let Some(both) = now.unwrap_or(self.all[id.0 as usize]).within(range) else { return false };
            self.before.push((id, now));
            self.known.insert(id, both);
            match self.module.node(id).op {
                Op::Wire(of) | Op::QuasiStatic(of, _) | Op::Extend { of, signed: false } => id = of,
                _ => return true,
            }
        }
    }
}
