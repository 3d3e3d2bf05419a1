//! Signed values: a type of their own, so that mixing them with unsigned ones does not compile.

use crate::elaboration;
use crate::ir::{Binary, Op, Relation, Shape, Shift};
use crate::loc::Loc;
use crate::operand::{Literal, ShiftAmount, Value};
use crate::signal::{Signal, bits_text};

/// A value in two's complement. Made by [`Signal::signed`]; [`Signed::bits`] leads back.
#[derive(Debug, Clone, Copy)]
#[must_use]
pub struct Signed(pub(crate) Signal);

/// What may stand on the right of a signed operator: a signed signal, or an integer, negative ones included.
pub trait SignedOperand {
    #[doc(hidden)]
    fn signed_value(self) -> Value;
}

impl SignedOperand for Signed {
    fn signed_value(self) -> Value {
        Value::Signal(self.0)
    }
}

macro_rules! signed_integers {
    ($($ty:ty)*) => {$(
        impl SignedOperand for $ty {
            fn signed_value(self) -> Value {
                Value::Literal(Literal::Integer(self as i128))
            }
        }
    )*};
}
signed_integers!(i8 i16 i32 i64 i128);

impl Signed {
    /// The width in bits, the sign included.
    pub fn width(self) -> u32 {
        self.0.width
    }

    /// The same bits as an unsigned signal.
    pub fn bits(self) -> Signal {
        self.0
    }

    /// The sign bit: 1 for a negative value.
    #[track_caller]
    pub fn is_negative(self) -> Signal {
        self.0.msb()
    }

    /// Widened with the sign bit to `width` bits.
    #[track_caller]
    pub fn sext(self, width: u32) -> Signed {
        Signed(self.0.sext(width))
    }

    /// The lowest `width` bits, read as two's complement.
    #[track_caller]
    pub fn trunc(self, width: u32) -> Signed {
        Signed(self.0.trunc(width))
    }

    /// Names the net.
    #[track_caller]
    pub fn named(self, name: &str) -> Signed {
        Signed(self.0.named(name))
    }

    #[track_caller]
    fn right(self, right: impl SignedOperand, operator: &str) -> Signal {
        match right.signed_value() {
            Value::Literal(literal) => literal.sized(self.0.width, true),
            signal => signal.with_width_of(self.0, operator),
        }
    }

    #[track_caller]
    fn relate(self, relation: Relation, right: impl SignedOperand) -> Signal {
        let right = self.right(right, relation.method());
        self.0.compare(relation, true, right)
    }

    #[track_caller]
    pub(crate) fn binary(self, op: Binary, right: impl SignedOperand) -> Signed {
        let right = self.right(right, op.symbol());
        Signed(self.0.binary(op, right))
    }

    /// 1 bit: equal.
    #[track_caller]
    pub fn eq(self, right: impl SignedOperand) -> Signal {
        self.relate(Relation::Eq, right)
    }

    /// 1 bit: not equal.
    #[track_caller]
    pub fn ne(self, right: impl SignedOperand) -> Signal {
        self.relate(Relation::Ne, right)
    }

    /// 1 bit: less than.
    #[track_caller]
    pub fn lt(self, right: impl SignedOperand) -> Signal {
        self.relate(Relation::Lt, right)
    }

    /// 1 bit: less than or equal.
    #[track_caller]
    pub fn le(self, right: impl SignedOperand) -> Signal {
        self.relate(Relation::Le, right)
    }

    /// 1 bit: greater than.
    #[track_caller]
    pub fn gt(self, right: impl SignedOperand) -> Signal {
        self.relate(Relation::Gt, right)
    }

    /// 1 bit: greater than or equal.
    #[track_caller]
    pub fn ge(self, right: impl SignedOperand) -> Signal {
        self.relate(Relation::Ge, right)
    }

    /// The product; its width is the sum of the operands' widths.
    #[track_caller]
    pub fn times(self, right: Signed) -> Signed {
        Signed(self.0.product(Binary::MulSigned, right.0))
    }
}

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

impl Literal {
    /// The literal in `width` bits; one that does not fit is a problem, and is cut.
    #[track_caller]
    pub(crate) fn sized(self, width: u32, signed: bool) -> Signal {
        let loc = Loc::caller();
        let (bits, fits) = match &self {
            Literal::Exact(bits) => (bits.resize(width), bits.width() == width),
            Literal::Integer(value) => {
                let bits = crate::Bits::from_i128(width, *value);
                let back = if signed { bits.to_i128() } else { bits.to_u128().and_then(|v| v.try_into().ok()) };
                (bits, back == Some(*value))
            }
        };
        elaboration::with(|e| {
            if !fits {
                let kind = if signed { "signed" } else { "unsigned" };
                let message = format!("`{self}` does not fit in {}, {kind}", bits_text(width));
                e.report(crate::Problem::new(loc, message).help("an integer takes the width of the signal it meets"));
            }
            Signal::make_in(e, Op::Const(bits), width, Shape::Plain, loc)
        })
    }
}
