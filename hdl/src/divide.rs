//! The message for `a / b` and `a % b`.

use crate::compare::Comparison;
use crate::register::Reg;
use crate::signal::Signal;
use crate::wire::Wire;
use std::ops::{Div, Rem};

/// Never implemented: a divider takes many clocks or much logic, so no operator makes one.
#[diagnostic::on_unimplemented(
    message = "signals are not divided by `/` or `%`",
    label = "no operator makes a divider",
    note = "by a power of two, a quotient is `a >> n` and a remainder `a.trunc(n)`; by other numbers, instantiate `Divider` of tilewright-blocks"
)]
pub trait DividesInOneClock {}

/// Two implementations, so that rustc does not take one of them as intended.
#[diagnostic::do_not_recommend]
impl DividesInOneClock for Comparison<[(); 0]> {}
#[diagnostic::do_not_recommend]
impl DividesInOneClock for Comparison<[(); 1]> {}

macro_rules! not_divided {
    ($($ty:ty)*) => {$(
        impl<R> Div<R> for $ty
        where
            Comparison<R>: DividesInOneClock,
        {
            type Output = Signal;

            fn div(self, _: R) -> Signal {
                unreachable!("nothing divides")
            }
        }

        impl<R> Rem<R> for $ty
        where
            Comparison<R>: DividesInOneClock,
        {
            type Output = Signal;

            fn rem(self, _: R) -> Signal {
                unreachable!("nothing divides")
            }
        }
    )*};
}

not_divided!(Signal Reg Wire);
