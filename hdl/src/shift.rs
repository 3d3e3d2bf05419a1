//! Shifts, by a signal and by a constant.

use crate::ir::{Op, Shift};
use crate::operand::ShiftAmount;
use crate::shaping::level;
use crate::signal::Signal;

impl Signal {
    #[track_caller]
    pub(crate) fn shift(self, shift: Shift, amount: Signal) -> Signal {
        let [left, amount] = level([self, amount], shift.symbol());
        Signal::make(Op::Shift(shift, left.id(), amount.id()), left.width, left.shape).kept_as(left.kind)
    }

    /// Shifted by a constant: wiring, not a shifter.
    #[track_caller]
    pub(crate) fn shift_by(self, shift: Shift, amount: u32) -> Signal {
        let kept = self.width.saturating_sub(amount);
        let shifted = match (shift, kept) {
            (_, kept) if kept == self.width => self,
            (Shift::Left, 0) | (Shift::Right, 0) => crate::lit(self.width, 0),
            (Shift::RightSigned, 0) => self.msb().repeat(self.width),
            (Shift::Left, _) => crate::concat(&[self.trunc(kept), crate::lit(amount, 0)]),
            (Shift::Right, _) => self.slice(amount..self.width).zext(self.width),
            (Shift::RightSigned, _) => self.slice(amount..self.width).sext(self.width),
        };
        // Not of the node, which may be an operand itself.
        Signal { kind: self.kind, ..shifted }
    }
}

impl ShiftAmount for Signal {
    #[track_caller]
    fn shift(self, operand: Signal, shift: Shift) -> Signal {
        operand.shift(shift, self)
    }
}
