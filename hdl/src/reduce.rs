//! Reductions: one value of all elements along an axis.

use crate::along::Along;
use crate::signal::Signal;
use tilewright_circuit::Bits;
use tilewright_circuit::ir::{Kind, Op, Reduction};

impl Along {
    #[track_caller]
    fn reduce(self, by: Reduction) -> Signal {
        self.dropped(Op::Reduce { by, of: self.of.id(), axis: self.axis })
    }

    /// Bitwise and of all elements.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let resident = constants(bits(1).of(grid(2, 2)), |lane| lane != 1);
    /// m.assert(resident.rows().and_all().pack().eq(0b01), "column 0 is all ones, column 1 is not");
    /// # });
    /// ```
    #[track_caller]
    pub fn and_all(self) -> Signal {
        self.reduce(Reduction::And)
    }

    /// Bitwise or of all elements.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let wants = constants(bits(1).of(grid(2, 3)), |lane| lane < 2);
    /// m.assert(wants.columns().or_all().pack().eq(0b01), "a lane for each row: does any of its lanes request?");
    /// # });
    /// ```
    #[track_caller]
    pub fn or_all(self) -> Signal {
        self.reduce(Reduction::Or)
    }

    /// Bitwise exclusive or of all elements.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let bits = constants(bits(1).of(grid(2, 3)), |lane| lane < 4);
    /// m.assert(bits.columns().xor_all().pack().eq(0b11), "the parity of each row: three ones and one");
    /// # });
    /// ```
    #[track_caller]
    pub fn xor_all(self) -> Signal {
        self.reduce(Reduction::Xor)
    }

    /// The sum of all elements, modulo 2 to the width.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let x = constants(bits(4).of(grid(2, 3)), |lane| lane);
    /// m.assert(x.rows().sum().sum().eq(x.sum()), "along one axis, then along the other");
    /// # });
    /// ```
    #[track_caller]
    pub fn sum(self) -> Signal {
        self.reduce(Reduction::Add)
    }

    /// The smallest element; signed elements are compared in two's complement.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let x = constants(bits(4).of(grid(2, 3)), |lane| 5 - u64::from(lane));
    /// m.assert(x.columns().minimum().pack().eq(0x03), "the minima of 5, 4, 3 and of 2, 1, 0");
    /// # });
    /// ```
    #[track_caller]
    pub fn minimum(self) -> Signal {
        self.extreme(Reduction::Min)
    }

    /// The largest element; signed elements are compared in two's complement.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let x = constants(bits(4).of(grid(2, 3)), |lane| 5 - u64::from(lane));
    /// m.assert(x.rows().maximum().pack().eq(0x345), "the largest of each column, here in the upper row");
    /// # });
    /// ```
    #[track_caller]
    pub fn maximum(self) -> Signal {
        self.extreme(Reduction::Max)
    }

    #[track_caller]
    fn extreme(self, by: Reduction) -> Signal {
        if self.of.kind != Kind::Signed {
            return self.reduce(by);
        }
        // With the sign bit inverted, signed numbers compare as unsigned ones do.
        let places = self.of.width - 1;
        let sign = if places == 0 { Bits::ones(1) } else { Bits::ones(1).concat(&Bits::zero(places)) };
        let of = self.of.bits() ^ sign.clone();
        (Along { of, ..self }.reduce(by) ^ sign).kept_as(Kind::Signed)
    }
}
