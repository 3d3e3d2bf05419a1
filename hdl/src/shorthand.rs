//! Shorthands for combinations of other operations.

use std::ops::{AddAssign, BitAndAssign, BitOrAssign, BitXorAssign, SubAssign};
use tilewright_circuit::Mistake;

use crate::elaboration;
use crate::integers::Integer;
use crate::module::Module;
use crate::operand::{IntoSignal, Operand};
use crate::select::{concat, condition};
use crate::shaping::level;
use crate::signal::Signal;
use crate::width::{IntoWidth, bit};
use tilewright_circuit::ir::{Binary, Op, Unary};

macro_rules! assignments {
    ($($trait:ident $method:ident $op:tt)*) => {$(
        /// For a variable that takes one signal after another, as in a loop over stages.
        impl<R: Operand> $trait<R> for Signal {
            #[track_caller]
            fn $method(&mut self, right: R) {
                *self = *self $op right;
            }
        }
    )*};
}
assignments!(AddAssign add_assign +  SubAssign sub_assign -  BitAndAssign bitand_assign &  BitOrAssign bitor_assign |  BitXorAssign bitxor_assign ^);

impl Signal {
    /// `width` bits from bit `low` on: `word.part(36, 12)` is Verilog's `word[36 +: 12]`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let word = lit(12, 0xabc);
    /// m.assert(word.part(4, 8).eq(0xab), "8 bits from bit 4 on");
    /// m.assert(word.part(0, below(16)).eq(0xc), "as wide as an index into 16 things");
    /// # });
    /// ```
    #[track_caller]
    pub fn part(self, low: impl Integer, width: impl IntoWidth) -> Signal {
        self.between(low.integer(), width.into_width().bits().into())
    }

    /// The bits rotated left by `places`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let word = lit(8, 0b1100_0001);
    /// m.assert(word.rotate_left(1).eq(0b1000_0011), "the top bit comes back");
    /// m.assert(word.rotate_left(9).eq(word.rotate_left(1)), "a rotation by 8 changes nothing");
    /// # });
    /// ```
    #[track_caller]
    pub fn rotate_left(self, places: impl Integer) -> Signal {
        self.rotated(places_in(self.width(), places))
    }

    /// The bits rotated right by `places`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let word = lit(8, 0b1100_0001);
    /// m.assert(word.rotate_right(1).eq(0b1110_0000), "the bottom bit comes back");
    /// m.assert(word.rotate_right(3).rotate_left(3).eq(word), "there and back");
    /// # });
    /// ```
    #[track_caller]
    pub fn rotate_right(self, places: impl Integer) -> Signal {
        self.rotated((self.width() - places_in(self.width(), places)) % self.width())
    }

    /// Rotates to the left by fewer places than there are bits.
    #[track_caller]
    fn rotated(self, places: u32) -> Signal {
        if places == 0 {
            return self.bits();
        }
        let kept = self.width() - places;
        concat(&[self.part(0, kept), self.part(kept, places)])
    }

    /// 1 bit: `other` is true, or this is false. It is meant for properties, as in
    /// `m.assert(take.implies(!full), ..)`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// def!(count = m.reg(4).reset(0));
    /// count.when(count.ne(9), count + 1);
    /// let full = count.eq(9);
    /// m.assert(full.implies(!count.bit(1)), "9 has no bit 1");
    /// m.assert(lit(1, 0).implies(full), "false implies anything");
    /// # });
    /// ```
    #[track_caller]
    pub fn implies(self, other: impl IntoSignal) -> Signal {
        let (this, other) = (condition(self, "implies"), condition(other.into(), "implies"));
        let [this, other] = level([this, other], "implies");
        let not = Signal::make(Op::Unary(Unary::Not, this.id()), 1, this.shape);
        Signal::make(Op::Binary(Binary::Or, not.id(), other.id()), 1, this.shape)
    }
}

/// `places` modulo the width.
#[track_caller]
fn places_in(width: u32, places: impl Integer) -> u32 {
    let places = places.integer();
    if places < 0 {
        elaboration::mistake(
            Mistake::NegativeRotation,
            format!("a rotation by {places} places"),
            "`rotate_left` and `rotate_right` take 0 or more",
        );
    }
    (places % i128::from(width)) as u32
}

impl Module {
    /// A bit that toggles at each edge where `turns`, 1 bit, is high, and is 0 after a reset; for example, which of
    /// two buffers is in front.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// def!(count = m.reg(2).reset(0));
    /// count.next(count + 1);
    /// def!(front = m.toggle(count.eq(2)));
    /// m.assert(front.implies(!m.rose(front) | count.eq(3)), "it toggles after the edge");
    /// # });
    /// assert_eq!(example.values("front"), [0, 0, 0, 1, 1, 1, 1, 0]);
    /// ```
    #[track_caller]
    pub fn toggle(self, name: &str, turns: impl IntoSignal) -> Signal {
        let held = self.reg(name, bit()).reset(0);
        *held.when(turns, !held)
    }
}
