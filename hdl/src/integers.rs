//! Integers on the left of an operator, and as factors.

use crate::ir::{Binary, Kind};
use crate::operand::{Literal, Operand, Value};
use crate::register::Reg;
use crate::signal::Signal;
use crate::wire::Wire;
use std::ops::{Add, BitAnd, BitOr, BitXor, Mul, Sub};

macro_rules! on_the_left {
    ($ty:ty, $right:ty: $($trait:ident $method:ident $op:ident),*) => {$(
        /// The integer takes the width of the signal: `5 - x`.
        impl $trait<$right> for $ty {
            type Output = Signal;

            #[track_caller]
            fn $method(self, right: $right) -> Signal {
                let right = Signal::from(right);
                self.operand().with_width_of(right, Binary::$op.symbol()).binary(Binary::$op, right)
            }
        }
    )*};
}

macro_rules! integers {
    ($($ty:ty)*) => {$(
        on_the_left!($ty, Signal: Add add Add, Sub sub Sub, BitAnd bitand And, BitOr bitor Or, BitXor bitxor Xor);
        on_the_left!($ty, Reg: Add add Add, Sub sub Sub, BitAnd bitand And, BitOr bitor Or, BitXor bitxor Xor);
        on_the_left!($ty, Wire: Add add Add, Sub sub Sub, BitAnd bitand And, BitOr bitor Or, BitXor bitxor Xor);

        impl Mul<Signal> for $ty {
            type Output = Signal;

            #[track_caller]
            fn mul(self, right: Signal) -> Signal {
                right.times_any(self)
            }
        }
    )*};
}
integers!(i32 u32 u64 usize);

impl Signal {
    /// The product with a signal, or with an integer, which has as many bits as it needs: `x * 3` is 2 bits wider than `x`.
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
