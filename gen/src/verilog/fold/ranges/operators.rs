//! The range of a node from those of its operands.

use super::interval::{Range, highest, of_binary};
use super::{Ranges, WIDEST};
use tilewright_circuit::ir::{NodeId, Op, Shift, Unary};

impl Ranges<'_> {
    /// The range of a node under the assumptions; `None` if these are contradictory.
    pub fn range(&mut self, id: NodeId, depth: u32) -> Option<Range> {
        let all = self.all[id.0 as usize];
        self.work = self.work.saturating_sub(1);
        let range = match depth {
            0 => all,
            _ if self.work == 0 => all,
            _ if self.module.width(id) > WIDEST => all,
            depth => self.of_operator(id, depth - 1)?.within(all)?,
        };
        match self.known.get(&id) {
            Some(known) => range.within(*known),
            None => Some(range),
        }
    }

    pub fn of_operator(&mut self, id: NodeId, depth: u32) -> Option<Range> {
        let module = self.module;
        let node = module.node(id);
        let width = Range::of_width(node.width);
        let lanes = |this: &Self, parts: &[NodeId]| {
            parts.iter().map(|part| this.all[part.0 as usize]).reduce(Range::with).unwrap_or(width)
        };
        Some(match &node.op {
            Op::Const(value) => Range::of_constant(value),
            Op::Register(_) => self.all[id.0 as usize],
            Op::Wire(of) | Op::QuasiStatic(of, _) => self.range(*of, depth)?,
            Op::Unary(Unary::Not, of) => {
                let of = self.range(*of, depth)?;
                Range { low: width.high - of.high, high: width.high - of.low }
            }
            Op::Binary(operator, a, b) => {
                let (a, b) = (self.range(*a, depth)?, self.range(*b, depth)?);
                of_binary(*operator, a, b, width)
            }
            Op::Shift(Shift::Right, a, amount) => {
                let (a, amount) = (self.range(*a, depth)?, self.range(*amount, depth)?);
                let by = |value: u64, amount: u64| if amount > 63 { 0 } else { value >> amount };
                Range { low: by(a.low, amount.high), high: by(a.high, amount.low) }
            }
            Op::Mux { select, on_true, on_false } => {
                let on_true = self.where_it_is(*select, true, *on_true, depth);
                let on_false = self.where_it_is(*select, false, *on_false, depth);
                [on_true, on_false].into_iter().flatten().reduce(Range::with)?
            }
            Op::Select { arms, default } => self.of_choice(arms, *default, depth)?,
            Op::Case { subject, arms, default } => {
                let mut taken = self.range(*default, depth);
                for (key, arm) in arms {
                    let mark = self.before.len();
                    let arm = if self.narrow(*subject, Some(Range::of_constant(key))) {
                        self.range(*arm, depth)
                    } else {
                        None
                    };
                    self.forget(mark);
                    taken = [taken, arm].into_iter().flatten().reduce(Range::with);
                }
                taken?
            }
            Op::Slice { of, low } if module.width(*of) <= WIDEST => {
                let of = self.range(*of, depth)?;
                let (from, to) = (of.low >> low, of.high >> low);
                if to <= width.high { Range { low: from, high: to } } else { width }
            }
            Op::Concat(parts) => {
                let mut all = Range::one(0);
                for &part in parts {
                    let (part, width) = (self.range(part, depth)?, module.width(part));
                    all = Range { low: all.low << width | part.low, high: all.high << width | part.high };
                }
                all
            }
            Op::Extend { of, signed } => {
                let inner = self.range(*of, depth)?;
                if *signed && inner.high > highest(module.width(*of) - 1) { width } else { inner }
            }
            // An assumption about this lane says nothing about another lane.
            Op::Broadcast { of, .. } | Op::Lane { of, .. } | Op::Map { of, edge: None, .. } => lanes(self, &[*of]),
            Op::Map { of, edge: Some(edge), .. } => lanes(self, &[*of, *edge]),
            Op::Stack { parts, .. } | Op::Interleave { parts, .. } => lanes(self, parts),
            Op::Pick { of, .. } => lanes(self, &[*of]).with(Range::one(0)),
            _ => width,
        })
    }

    pub fn of_choice(&mut self, arms: &[(NodeId, NodeId)], default: NodeId, depth: u32) -> Option<Range> {
        let (mark, mut taken, mut is_reached) = (self.before.len(), None::<Range>, true);
        for &(condition, value) in arms {
            let arm = self.where_it_is(condition, true, value, depth);
            taken = [taken, arm].into_iter().flatten().reduce(Range::with);
            is_reached = self.assume(condition, false, depth);
            if !is_reached {
                break;
            }
        }
        let last = if is_reached { self.range(default, depth) } else { None };
        self.forget(mark);
        [taken, last].into_iter().flatten().reduce(Range::with)
    }
}
