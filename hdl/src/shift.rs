//! Shifts, by a signal and by a constant.

use crate::operand::ShiftAmount;
use crate::shaping::level;
use crate::signal::Signal;
use tilewright_circuit::ir::{Op, Shift};

impl Signal {
    #[track_caller]
    pub(crate) fn shift(self, shift: Shift, amount: Signal) -> Signal {
        let left = self.computable(shift.symbol());
        let [left, amount] = level([left, amount], shift.symbol());
        Signal::make(Op::Shift(shift, left.id(), amount.id()), left.width, left.shape).kept_as(left.kind)
    }

    /// Shifted by a constant: wiring, not a shifter.
    #[track_caller]
    pub(crate) fn shift_by(self, shift: Shift, amount: u32) -> Signal {
        let this = self.computable(shift.symbol());
        let kept = this.width.saturating_sub(amount);
        let shifted = match (shift, kept) {
            (_, kept) if kept == this.width => this,
            (Shift::Left, 0) | (Shift::Right, 0) => crate::lit(this.width, 0).with_lanes_of(this, shift.symbol()),
            (Shift::RightSigned, 0) => this.msb().repeat(this.width),
            (Shift::Left, _) => crate::concat(&[this.trunc(kept), crate::lit(amount, 0)]),
            (Shift::Right, _) => this.slice(amount..this.width).zext(this.width),
            (Shift::RightSigned, _) => this.slice(amount..this.width).sext(this.width),
        };
        // The kind of the signal, not of the node, which may itself be the operand.
        Signal { kind: this.kind, ..shifted }
    }
}

impl ShiftAmount for Signal {
    #[track_caller]
    fn shift(self, operand: Signal, shift: Shift) -> Signal {
        operand.shift(shift, self)
    }
}
