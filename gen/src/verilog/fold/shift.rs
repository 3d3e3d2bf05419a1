//! Shifts: by a constant they become slices; a very wide amount is truncated, because some tools accept no wider
//! ones.

use super::Fold;
use super::Outcome::{self, Op as Is, Same};
use tilewright_circuit::Bits;
use tilewright_circuit::ir::{Binary, NodeId, Op, Shift, Unary};

/// Wider shift amounts are truncated, with the fill if a dropped bit is set.
const WIDEST_AMOUNT: u32 = 16;

impl Fold {
    pub(super) fn shift(&mut self, id: NodeId, shift: Shift, a: NodeId, amount: NodeId) -> Outcome {
        let width = self.width(a);
        if let Some(amount) = self.constant(amount) {
            let amount = amount.to_u64().map_or(width, |amount| amount.min(u64::from(width)) as u32);
            return self.shift_by(id, shift, a, amount);
        }
        if self.constant(a).is_some_and(|value| value.is_zero()) {
            return Same(a);
        }
        if let Some((inner, amount)) = self.twice_shifted(id, shift, a, amount) {
            return self.shift(id, shift, inner, amount);
        }
        let amount_width = self.width(amount);
        if amount_width <= WIDEST_AMOUNT || width >= 1 << WIDEST_AMOUNT {
            return Is(Op::Shift(shift, a, amount));
        }
        let high = self.add(id, amount_width - WIDEST_AMOUNT, Op::Slice { of: amount, low: WIDEST_AMOUNT });
        let beyond = self.add(id, 1, Op::Unary(Unary::AnyOne, high));
        let low = self.add(id, WIDEST_AMOUNT, Op::Slice { of: amount, low: 0 });
        let shifted = self.add(id, width, Op::Shift(shift, a, low));
        let filling = self.shift_by(id, shift, a, width);
        let filling = self.settle(id, width, filling);
        self.mux(beyond, filling, shifted)
    }

    /// For a value that is already shifted in the same direction: the original, and the sum of both amounts.
    /// Verilator 5.048 merges two shifts, also across nets, and loses the carry of the amounts.
    fn twice_shifted(&mut self, id: NodeId, shift: Shift, mut a: NodeId, amount: NodeId) -> Option<(NodeId, NodeId)> {
        while let Op::Wire(of) | Op::QuasiStatic(of, _) = self.module.node(a).op {
            a = of;
        }
        match self.module.node(a).op {
            Op::Shift(same, inner, first) if same == shift && shift != Shift::RightSigned => {
                let width = self.width(first).max(self.width(amount)) + 1;
                let [first, amount] = [first, amount].map(|of| self.add(id, width, Op::Extend { of, signed: false }));
                Some((inner, self.add(id, width, Op::Binary(Binary::Add, first, amount))))
            }
            _ => None,
        }
    }

    /// The node of an outcome.
    fn settle(&mut self, of: NodeId, width: u32, outcome: Outcome) -> NodeId {
        match outcome {
            Same(id) => id,
            Is(op) => self.add(of, width, op),
        }
    }

    fn shift_by(&mut self, id: NodeId, shift: Shift, a: NodeId, amount: u32) -> Outcome {
        let width = self.width(a);
        if amount == 0 {
            return Same(a);
        }
        if let Some(value) = self.constant(a) {
            return Is(Op::Const(shifted(&value, shift, amount.min(width))));
        }
        if amount >= width {
            if shift != Shift::RightSigned {
                return Is(Op::Const(Bits::zero(width)));
            }
            let sign = self.add(id, 1, Op::Slice { of: a, low: width - 1 });
            return if width == 1 { Same(a) } else { Is(Op::Repeat(sign, width)) };
        }
        let low = if shift == Shift::Left { 0 } else { amount };
        let kept = self.add(id, width - amount, Op::Slice { of: a, low });
        match shift {
            Shift::Left => {
                let zeros = self.add(id, amount, Op::Const(Bits::zero(amount)));
                Is(Op::Concat(vec![kept, zeros]))
            }
            Shift::Right => self.extend(kept, false, width),
            Shift::RightSigned => self.extend(kept, true, width),
        }
    }
}

/// A constant shifted by up to its width.
fn shifted(value: &Bits, shift: Shift, amount: u32) -> Bits {
    let width = value.width();
    match shift {
        Shift::Left | Shift::Right if amount == width => Bits::zero(width),
        Shift::Left => value.slice(0..width - amount).concat(&Bits::zero(amount)),
        Shift::Right => value.slice(amount..width).resize(width),
        Shift::RightSigned => value.slice(amount.min(width - 1)..width).sext(width),
    }
}
