//! What may stand on the right of an operator: signals, registers, wires, and integers.

use crate::bits::Bits;
use crate::ir::{Binary, Shift};
use crate::register::{Reg, StateReg};
use crate::signal::Signal;
use crate::signed::{Signed, SignedOperand};
use crate::wire::Wire;
use std::fmt;

/// Anything that can be read as an unsigned value.
pub trait Operand {
    #[doc(hidden)]
    fn operand(self) -> Value;
}

#[doc(hidden)]
#[derive(Debug, Clone)]
pub enum Value {
    /// A signal, with its width.
    Signal(Signal),
    /// A number, which takes the width of what it meets.
    Literal(Literal),
}

#[doc(hidden)]
#[derive(Debug, Clone)]
pub enum Literal {
    /// A number that must fit where it stands.
    Integer(i128),
    /// A value that must have just the width of where it stands.
    Exact(Bits),
}

impl fmt::Display for Literal {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Literal::Integer(value) => write!(f, "{value}"),
            Literal::Exact(bits) => write!(f, "{bits}"),
        }
    }
}

impl Operand for Signal {
    fn operand(self) -> Value {
        Value::Signal(self)
    }
}

impl Operand for Bits {
    fn operand(self) -> Value {
        Value::Literal(Literal::Exact(self))
    }
}

macro_rules! integers {
    ($($ty:ty)*) => {$(
        impl Operand for $ty {
            fn operand(self) -> Value {
                Value::Literal(Literal::Integer(self as i128))
            }
        }
    )*};
}
integers!(u8 u16 u32 u64 usize i32 i64 bool);

/// Reads as its value.
impl<S> Operand for StateReg<S> {
    fn operand(self) -> Value {
        Value::Signal(*self)
    }
}

macro_rules! binary_operators {
    ($ty:ty: $($trait:ident $method:ident $op:ident),*) => {$(
        impl<R: Operand> std::ops::$trait<R> for $ty {
            type Output = Signal;
            #[track_caller]
            fn $method(self, right: R) -> Signal {
                Signal::from(self).binary(Binary::$op, right)
            }
        }
    )*};
}

/// What may stand on the right of `<<` and `>>`: a constant, which costs nothing, or a signal, which is a shifter.
pub trait ShiftAmount {
    #[doc(hidden)]
    fn shift(self, operand: Signal, shift: Shift) -> Signal;
}

macro_rules! constant_shift_amounts {
    ($($ty:ty)*) => {$(
        impl ShiftAmount for $ty {
            #[track_caller]
            fn shift(self, operand: Signal, shift: Shift) -> Signal {
                let Ok(amount) = u32::try_from(self) else { panic!("a shift by {self} bits: an amount is 0 or more") };
                operand.shift_by(shift, amount)
            }
        }
    )*};
}
constant_shift_amounts!(i32 u64 usize);

impl ShiftAmount for u32 {
    #[track_caller]
    fn shift(self, operand: Signal, shift: Shift) -> Signal {
        operand.shift_by(shift, self)
    }
}

impl ShiftAmount for Signal {
    #[track_caller]
    fn shift(self, operand: Signal, shift: Shift) -> Signal {
        operand.shift(shift, self)
    }
}

macro_rules! operators {
    ($($ty:ty)*) => {$(
        binary_operators!($ty: Add add Add, Sub sub Sub, BitAnd bitand And, BitOr bitor Or, BitXor bitxor Xor);

        /// Every bit inverted.
        impl std::ops::Not for $ty {
            type Output = Signal;
            #[track_caller]
            fn not(self) -> Signal {
                Signal::from(self).inverted()
            }
        }

        /// The unsigned product; its width is the sum of the operands' widths.
        impl<R: Into<Signal>> std::ops::Mul<R> for $ty {
            type Output = Signal;
            #[track_caller]
            fn mul(self, right: R) -> Signal {
                Signal::from(self).times(right.into())
            }
        }

        /// Towards the most significant bit, filled with zeros.
        impl<R: ShiftAmount> std::ops::Shl<R> for $ty {
            type Output = Signal;
            #[track_caller]
            fn shl(self, amount: R) -> Signal {
                amount.shift(Signal::from(self), Shift::Left)
            }
        }

        /// Towards the least significant bit, filled with zeros.
        impl<R: ShiftAmount> std::ops::Shr<R> for $ty {
            type Output = Signal;
            #[track_caller]
            fn shr(self, amount: R) -> Signal {
                amount.shift(Signal::from(self), Shift::Right)
            }
        }
    )*};
}

macro_rules! reads_as_signal {
    ($($ty:ty)*) => {$(
        impl From<$ty> for Signal {
            fn from(handle: $ty) -> Signal {
                *handle
            }
        }

        impl Operand for $ty {
            fn operand(self) -> Value {
                Value::Signal(*self)
            }
        }

        impl ShiftAmount for $ty {
            #[track_caller]
            fn shift(self, operand: Signal, shift: Shift) -> Signal {
                operand.shift(shift, *self)
            }
        }
    )*};
}

reads_as_signal!(Reg Wire);
operators!(Signal Reg Wire);

macro_rules! signed_operators {
    ($($trait:ident $method:ident $op:ident),*) => {$(
        impl<R: SignedOperand> std::ops::$trait<R> for Signed {
            type Output = Signed;
            #[track_caller]
            fn $method(self, right: R) -> Signed {
                self.binary(Binary::$op, right)
            }
        }
    )*};
}
signed_operators!(Add add Add, Sub sub Sub);

/// The product; its width is the sum of the operands' widths.
impl std::ops::Mul for Signed {
    type Output = Signed;
    #[track_caller]
    fn mul(self, right: Signed) -> Signed {
        self.times(right)
    }
}

/// The negative, modulo 2 to the width.
impl std::ops::Neg for Signed {
    type Output = Signed;
    #[track_caller]
    fn neg(self) -> Signed {
        Signed(crate::lit(self.width(), 0)) - self
    }
}

/// Towards the most significant bit, filled with zeros.
impl<R: ShiftAmount> std::ops::Shl<R> for Signed {
    type Output = Signed;
    #[track_caller]
    fn shl(self, amount: R) -> Signed {
        Signed(amount.shift(self.0, Shift::Left))
    }
}

/// Towards the least significant bit, filled with the sign.
impl<R: ShiftAmount> std::ops::Shr<R> for Signed {
    type Output = Signed;
    #[track_caller]
    fn shr(self, amount: R) -> Signed {
        Signed(amount.shift(self.0, Shift::RightSigned))
    }
}
