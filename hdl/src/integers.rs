//! Integers: their types, as left operands, and as factors.

use crate::elaboration;
use crate::operand::{Literal, Operand, Value};
use crate::register::Reg;
use crate::signal::Signal;
use crate::wire::Wire;
use std::fmt::Display;
use std::ops::{Add, BitAnd, BitOr, BitXor, Mul, Sub};
use tilewright_circuit::Mistake;
use tilewright_circuit::ir::{Binary, Kind};

/// A number known while the block is built: any of Rust's integer types but `u128`, or a `bool`, which is 0 or 1.
///
/// ```
/// # use tilewright_hdl::*;
/// # tilewright_sim::example(|m| {
/// fn page(number: impl Integer, pages: impl Integer) -> Signal {
///     lit(below(pages), number)
/// }
/// m.assert(page(3u8, 12usize).eq(page(3, 12)), "no conversion between integer types");
/// # });
/// ```
#[diagnostic::on_unimplemented(
    message = "a `{Self}` is not an integer",
    note = "a number that is known while the block is built is accepted here, of any integer type but `u128`, or a `bool`"
)]
pub trait Integer: Copy + Display {
    /// The number.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// assert_eq!((7u8.integer(), (-7).integer()), (7, -7));
    /// ```
    fn integer(self) -> i128;
}

/// A count; negative numbers are invalid.
#[track_caller]
pub(crate) fn not_negative(number: impl Integer) -> u128 {
    match u128::try_from(number.integer()) {
        Ok(count) => count,
        Err(_) => elaboration::mistake(Mistake::NegativeCount, format!("a number of {number}"), "it must be 0 or more"),
    }
}

/// Like [`not_negative`], but saturates at the largest `u32`.
#[track_caller]
pub(crate) fn count(number: impl Integer) -> u32 {
    u32::try_from(not_negative(number)).unwrap_or(u32::MAX)
}

/// Calls a macro with all integer types.
macro_rules! for_integers {
    ($what:ident) => {
        $what! { i8 i16 i32 i64 i128 isize u8 u16 u32 u64 usize }
    };
}
pub(crate) use for_integers;

macro_rules! integer {
    ($($ty:ty)*) => {$(
        impl Integer for $ty {
            fn integer(self) -> i128 {
                self as i128
            }
        }
    )*};
}
for_integers!(integer);
integer!(bool);

macro_rules! on_the_left {
    ($ty:ty, $right:ty: $($trait:ident $method:ident $op:ident),*) => {
        $(
            /// The integer takes the width of the signal: `5 - x`.
            impl $trait<$right> for $ty {
                type Output = Signal;

                #[track_caller]
                fn $method(self, right: $right) -> Signal {
                    let right = Signal::from(right);
                    self.operand().with_width_of(right, Binary::$op.symbol()).binary(Binary::$op, right)
                }
            }
        )*

        /// The integer has the fewest bits that can represent it, as in `x * 3`.
        impl Mul<$right> for $ty {
            type Output = Signal;

            #[track_caller]
            fn mul(self, right: $right) -> Signal {
                Signal::from(right).times_any(self)
            }
        }
    };
}

macro_rules! integers {
    ($($ty:ty)*) => {$(
        on_the_left!($ty, Signal: Add add Add, Sub sub Sub, BitAnd bitand And, BitOr bitor Or, BitXor bitxor Xor);
        on_the_left!($ty, Reg: Add add Add, Sub sub Sub, BitAnd bitand And, BitOr bitor Or, BitXor bitxor Xor);
        on_the_left!($ty, Wire: Add add Add, Sub sub Sub, BitAnd bitand And, BitOr bitor Or, BitXor bitxor Xor);
    )*};
}
for_integers!(integers);

impl Signal {
    /// The product with a signal or an integer. An integer has the fewest bits that can represent it: `x * 3` is 2
    /// bits wider than `x`.
    #[track_caller]
    pub(crate) fn times_any(self, right: impl Operand) -> Signal {
        match right.operand().cut_to(self.width) {
            Value::Signal(right) | Value::Low(right) => self.times(right),
            Value::Literal(Literal::Integer(value, radix)) => {
                let needed = 128 - if value < 0 { (!value).leading_zeros() } else { value.leading_zeros() };
                let width = if self.kind == Kind::Signed { needed + 1 } else { needed.max(1) };
                self.times(Literal::Integer(value, radix).sized(width, self.kind))
            }
            Value::Literal(Literal::Exact(bits)) => {
                let width = bits.width();
                self.times(Literal::Exact(bits).sized(width, self.kind))
            }
            Value::Literal(code) => code.for_signal(self, Binary::Mul.symbol()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[should_panic(expected = "a number of -1 [T112], at ")]
    fn nothing_is_counted_by_a_negative_number() {
        let _ = count(-1);
    }

    #[test]
    fn what_is_too_large_is_the_largest() {
        assert_eq!((count(7i128), count(u64::MAX), count(i128::MAX)), (7, u32::MAX, u32::MAX));
    }
}
