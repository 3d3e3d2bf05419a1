//! What defines a value.

use super::value::{Bytes, Value};

/// The definition of a value. Operands have the type of the result where nothing else is said.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub(in crate::engine) enum Operation {
    /// What a function, a loop or a region's end gives it.
    Parameter,
    /// An integer, in two's complement.
    Constant(i64),
    /// The address of a memory, a function or another object.
    Address(usize),
    /// The bytes of a vector, lowest lane first.
    Bytes(Bytes),
    Unary(Unary, Value),
    Binary(Binary, Value, Value),
    /// Integers compared: 1 or 0 of 8 bits, or in each lane of vectors all ones or zeros.
    Compare(Comparison, Value, Value),
    /// The second operand if the first, a flag, is 1, else the third.
    Select(Value, Value, Value),
    /// Each bit of the second operand where the mask, the first one, is 1, else of the third. All bits of a byte of the mask are equal.
    Blend(Value, Value, Value),
    /// Bytes chosen of two vectors, one after the other; as many as a vector has.
    Shuffle(Value, Value, Bytes),
    /// A number of a vector.
    Lane(Value, u8),
    /// A vector with another number in a lane.
    WithLane(Value, Value, u8),
    /// What is at an address and offset, as integers or vectors; `aligned` if the place is a multiple of its size.
    Load {
        load: Load,
        aligned: bool,
        address: Value,
        offset: i32,
    },
    /// The result of a function of the C convention: its address, and numbers.
    Call(Value, Vec<Value>),
}

/// Calls `$visit` with a reference to every value that an operation uses, mutable or not as `$iter` is.
macro_rules! each_operand {
    ($operation:expr, $iter:ident, $visit:ident) => {
        match $operation {
            Operation::Parameter | Operation::Constant(_) | Operation::Address(_) | Operation::Bytes(_) => {}
            Operation::Unary(_, x) | Operation::Lane(x, _) | Operation::Load { address: x, .. } => $visit(x),
            Operation::Binary(_, x, y)
            | Operation::Compare(_, x, y)
            | Operation::Shuffle(x, y, _)
            | Operation::WithLane(x, y, _) => [x, y].into_iter().for_each($visit),
            Operation::Select(x, y, z) | Operation::Blend(x, y, z) => [x, y, z].into_iter().for_each($visit),
            Operation::Call(function, arguments) => {
                $visit(function);
                arguments.$iter().for_each($visit);
            }
        }
    };
}

impl Operation {
    /// Visits the values that it uses, each as often as it does.
    pub fn for_each_operand(&self, mut visit: impl FnMut(Value)) {
        let mut visit = |value: &Value| visit(*value);
        each_operand!(self, iter, visit);
    }

    /// Replaces the values that it uses.
    pub fn rewrite(&mut self, mut operand: impl FnMut(Value) -> Value) {
        let mut change = |value: &mut Value| *value = operand(*value);
        each_operand!(self, iter_mut, change);
    }
}

/// How a load fills its type.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(in crate::engine) enum Load {
    /// As many bytes as the type has.
    Whole,
    /// Half as many, each number extended with zeros.
    ZeroExtended,
    /// Half as many, each number extended by its sign.
    SignExtended,
}

/// Operations on one value.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(in crate::engine) enum Unary {
    Not,
    Neg,
    /// The number of ones of an integer.
    CountOnes,
    /// An integer of fewer bits, with zeros above.
    ZeroExtend,
    /// An integer of fewer bits, with its sign above.
    SignExtend,
    /// The lower bits of an integer.
    Truncate,
    /// The same bits as another vector; the lowest ones, if that has fewer.
    Cast,
    /// An integer in all lanes.
    Splat,
    /// An integer in the lowest lane, zeros above.
    Lowest,
    /// The lower, or the upper, lanes of a vector of integers of half the size, extended with zeros or by the sign.
    WidenLow {
        signed: bool,
    },
    WidenHigh {
        signed: bool,
    },
    /// The highest bit of each lane, as an integer.
    HighBits,
    /// Whether any bit is 1, as 0 or 1 of 8 bits.
    AnyBit,
    /// Floats of signed integers.
    ToFloat,
    /// Integers of floats, all of them powers of two up to 2^31 or below 2^31.
    ToInteger,
}

/// Operations on two values.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(in crate::engine) enum Binary {
    Add,
    Sub,
    Mul,
    /// The quotient of unsigned integers.
    Div,
    And,
    Or,
    Xor,
    /// Shifts, for vectors all lanes by one integer.
    Shl,
    Shr,
    /// A shift to the right that repeats the sign.
    Sar,
    RotateLeft,
    /// The lesser one of unsigned integers.
    Min,
    /// The numbers of two vectors of integers of twice the size, limited to what fits.
    Narrow {
        signed: bool,
    },
    /// Bytes of the first operand, a table, by the numbers in the second; zero for numbers from 16 on.
    Swizzle,
    /// The same for numbers that are all below 16.
    LookUp,
    /// The product of floats.
    MulFloat,
}

/// Relations of integers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(in crate::engine) enum Comparison {
    Equal,
    NotEqual,
    SignedLessThan,
    SignedLessThanOrEqual,
    SignedGreaterThan,
    SignedGreaterThanOrEqual,
    UnsignedLessThan,
    UnsignedLessThanOrEqual,
    UnsignedGreaterThan,
    UnsignedGreaterThanOrEqual,
}
