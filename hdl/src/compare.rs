//! Comparisons, which are signed if their operands are; and the message for `a == b`.

use crate::operand::Operand;
use crate::shaping::level;
use crate::signal::Signal;
use tilewright_circuit::ir::{Kind, Op, Relation};

/// Never implemented: `==` and `<` would need their result while the circuit is described.
#[diagnostic::on_unimplemented(
    message = "signals cannot be compared by `==`, `<` and their like, which return a `bool`",
    label = "the values are not known yet",
    note = "the comparison as a signal is `a.eq(b)`, `a.ne(b)`, `a.lt(b)`, `a.le(b)`, `a.gt(b)` or `a.ge(b)`; of a code of an enum, `a.is(code)`"
)]
pub trait KnownNow {}

/// The right operand of `==`, as a type other than the left one; otherwise rustc only says that the two cannot be
/// compared.
#[derive(Debug)]
pub struct Comparison<R>(R);

/// Two implementations, so that rustc does not take one of them as intended.
#[diagnostic::do_not_recommend]
impl KnownNow for Comparison<[(); 0]> {}
#[diagnostic::do_not_recommend]
impl KnownNow for Comparison<[(); 1]> {}

/// Implements `==` and `<` of a handle in terms of [`KnownNow`]. The implementation brings methods of its own, such
/// as `eq(&self, ..)`; the handle's own methods win only if they take `&self`.
macro_rules! not_compared {
    ($ty:ty) => {
        impl<R> PartialEq<R> for $ty
        where
            $crate::compare::Comparison<R>: $crate::compare::KnownNow,
        {
            fn eq(&self, _: &R) -> bool {
                unreachable!("nothing is compared by it")
            }
        }

        impl<R> PartialOrd<R> for $ty
        where
            $crate::compare::Comparison<R>: $crate::compare::KnownNow,
        {
            fn partial_cmp(&self, _: &R) -> Option<std::cmp::Ordering> {
                unreachable!("nothing is compared by it")
            }
        }
    };
}

/// Like [`not_compared`], for a type that is read as a signal, together with the signal's comparisons.
macro_rules! compared_as_signal {
    ($ty:ty) => {
        $crate::compare::not_compared!($ty);

        #[doc(hidden)]
        impl $ty {
            $crate::compare::compared_as_signal!(eq ne lt le gt ge);
        }
    };
    ($($relation:ident)*) => {$(
        #[track_caller]
        pub fn $relation(&self, right: impl $crate::operand::Operand) -> $crate::Signal {
            $crate::Signal::$relation(self, right)
        }
    )*};
}

pub(crate) use {compared_as_signal, not_compared};

not_compared!(Signal);

impl Signal {
    #[track_caller]
    pub(crate) fn compare(self, relation: Relation, right: Signal) -> Signal {
        let signed = self.kind == Kind::Signed;
        let [left, right] = level([self, right], relation.method());
        Signal::make(Op::Compare { relation, signed, operands: [left.id(), right.id()] }, 1, left.shape)
    }

    #[track_caller]
    fn relate(self, relation: Relation, right: impl Operand) -> Signal {
        let left =
            if matches!(relation, Relation::Eq | Relation::Ne) { self } else { self.computable(relation.method()) };
        let right = right.operand().with_width_of(left, relation.method());
        left.compare(relation, right)
    }

    /// 1 bit: equal.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// def!(count = m.reg(2).reset(0));
    /// count.when(count.eq(2), 0).otherwise(count + 1);
    /// m.assert(!count.eq(3), "a number takes the width of the signal, here 2 bits");
    /// # });
    /// ```
    #[track_caller]
    pub fn eq(&self, right: impl Operand) -> Signal {
        self.relate(Relation::Eq, right)
    }

    /// 1 bit: not equal.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// def!(left = m.reg(4).reset(9));
    /// left.when(left.ne(0), left - 1);
    /// m.assert(left.ne(0).eq(left.any_one()), "not 0 means that a bit is one");
    /// # });
    /// ```
    #[track_caller]
    pub fn ne(&self, right: impl Operand) -> Signal {
        self.relate(Relation::Ne, right)
    }

    /// 1 bit: less than, in two's complement if both are signed.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// m.assert(lit(4, 0b0111).lt(0b1000), "7 < 8");
    /// m.assert(lit(4, 0b1000).signed().lt(7), "-8 < 7");
    /// # });
    /// ```
    #[track_caller]
    pub fn lt(&self, right: impl Operand) -> Signal {
        self.relate(Relation::Lt, right)
    }

    /// 1 bit: less than or equal, in two's complement if both are signed.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// def!(count = m.reg(4).reset(0));
    /// count.when(count.lt(12), count + 1);
    /// m.assert(count.le(12), "it counts up to 12 inclusive");
    /// # });
    /// ```
    #[track_caller]
    pub fn le(&self, right: impl Operand) -> Signal {
        self.relate(Relation::Le, right)
    }

    /// 1 bit: greater than, in two's complement if both are signed.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// m.assert(lit(8, 255).gt(1), "255 > 1");
    /// m.assert(!lit(8, 255).signed().gt(1), "-1 is not");
    /// # });
    /// ```
    #[track_caller]
    pub fn gt(&self, right: impl Operand) -> Signal {
        self.relate(Relation::Gt, right)
    }

    /// 1 bit: greater than or equal, in two's complement if both are signed.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # tilewright_sim::example(|m| {
    /// let sum = lit(8, 200).add_carry(lit(8, 100));
    /// m.assert(sum.ge(256), "300, in the 9 bits that a sum with its carry has");
    /// # });
    /// ```
    #[track_caller]
    pub fn ge(&self, right: impl Operand) -> Signal {
        self.relate(Relation::Ge, right)
    }
}
