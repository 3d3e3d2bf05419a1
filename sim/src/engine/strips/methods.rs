//! A method of the builder for each operation on one value or two.

use super::builder::Builder;
use super::operation::{Binary, Operation, Unary};
use super::value::{Type, Value};

macro_rules! binary {
    ($($name:ident is $operation:ident: $doc:literal,)*) => {
        impl Builder {
            $(#[doc = $doc] pub fn $name(&mut self, x: Value, y: Value) -> Value {
                self.both(Binary::$operation, x, y)
            })*
        }
    };
}

binary! {
    add is Add: "The sum.",
    sub is Sub: "The difference.",
    mul is Mul: "The product.",
    div is Div: "The quotient of unsigned integers.",
    and is And: "The ones of both.",
    or is Or: "The ones of either.",
    xor is Xor: "The ones of one of them alone.",
    shl is Shl: "A shift to the left.",
    shr is Shr: "A shift to the right with zeros.",
    sar is Sar: "A shift to the right with the sign.",
    min is Min: "The lesser one of unsigned integers.",
    mul_float is MulFloat: "The product of floats.",
}

macro_rules! by_constant {
    ($($name:ident is $operation:ident: $doc:literal,)*) => {
        impl Builder {
            $(#[doc = $doc] pub fn $name(&mut self, x: Value, y: i64) -> Value {
                self.with_constant(Binary::$operation, x, y)
            })*
        }
    };
}

by_constant! {
    add_constant is Add: "The sum with a constant.",
    mul_constant is Mul: "The product with a constant.",
    and_constant is And: "The ones that a constant has too.",
    shl_constant is Shl: "A shift to the left by a constant.",
    shr_constant is Shr: "A shift to the right by a constant, with zeros.",
    rotate_left is RotateLeft: "A rotation to the left.",
}

macro_rules! unary {
    ($($name:ident is $operation:ident: $doc:literal,)*) => {
        impl Builder {
            $(#[doc = $doc] pub fn $name(&mut self, of: Value) -> Value {
                let ty = self.type_of(of);
                self.to(Unary::$operation, ty, of)
            })*
        }
    };
}

unary! {
    not is Not: "All bits inverted.",
    neg is Neg: "The negative.",
    count_ones is CountOnes: "The number of ones.",
}

macro_rules! converted {
    ($($name:ident is $operation:ident: $doc:literal,)*) => {
        impl Builder {
            $(#[doc = $doc] pub fn $name(&mut self, ty: Type, of: Value) -> Value {
                self.to(Unary::$operation, ty, of)
            })*
        }
    };
}

converted! {
    zero_extend is ZeroExtend: "With zeros above.",
    sign_extend is SignExtend: "With the sign above.",
    splat is Splat: "An integer in all lanes.",
    lowest is Lowest: "An integer in the lowest lane, zeros above.",
    floats is ToFloat: "Floats of signed integers.",
    integers is ToInteger: "Integers of floats that are powers of two up to 2^31, or below 2^31.",
    high_bits is HighBits: "The highest bit of each lane.",
}

impl Builder {
    /// The lower bits. Those of what was extended from so many are itself.
    pub fn truncate(&mut self, ty: Type, of: Value) -> Value {
        match *self.operation(of) {
            Operation::Unary(Unary::ZeroExtend | Unary::SignExtend, narrow) if self.type_of(narrow) == ty => narrow,
            Operation::Constant(number) => {
                let ones = i64::MAX >> (63 - ty.element());
                self.constant(ty, number & ones)
            }
            _ => self.to(Unary::Truncate, ty, of),
        }
    }

    /// The same bits as another vector; the lowest ones, if that has fewer.
    pub fn cast(&mut self, ty: Type, of: Value) -> Value {
        if self.type_of(of) == ty { of } else { self.to(Unary::Cast, ty, of) }
    }

    /// Bytes of a table by the numbers in a vector; zero for numbers from 16 on.
    pub fn swizzle(&mut self, table: Value, numbers: Value) -> Value {
        let ty = self.type_of(numbers);
        self.value(Operation::Binary(Binary::Swizzle, table, numbers), ty)
    }

    /// Bytes of a table by the numbers in a vector, which are below 16.
    pub fn look_up(&mut self, table: Value, numbers: Value) -> Value {
        let ty = self.type_of(numbers);
        self.value(Operation::Binary(Binary::LookUp, table, numbers), ty)
    }

    /// Whether any bit of a vector is 1.
    pub fn any_bit(&mut self, of: Value) -> Value {
        self.to(Unary::AnyBit, Type::I8, of)
    }

    /// The lower lanes of a vector, each twice as wide.
    pub fn widen_low(&mut self, signed: bool, of: Value) -> Value {
        let ty = self.type_of(of).widened();
        self.to(Unary::WidenLow { signed }, ty, of)
    }

    /// The upper lanes of a vector, each twice as wide.
    pub fn widen_high(&mut self, signed: bool, of: Value) -> Value {
        let ty = self.type_of(of).widened();
        self.to(Unary::WidenHigh { signed }, ty, of)
    }

    /// The lanes of two vectors, each half as wide and limited to what fits.
    pub fn narrow(&mut self, signed: bool, low: Value, high: Value) -> Value {
        let ty = self.type_of(low).narrowed();
        self.value(Operation::Binary(Binary::Narrow { signed }, low, high), ty)
    }
}
