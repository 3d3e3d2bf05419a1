//! The names of operations and types in text.

use std::fmt::{self, Display};

use super::operation::{Binary, Comparison, Load, Unary};
use super::value::Type;

/// The names of one kind of operation.
pub(in crate::engine) type Names<T> = &'static [(T, &'static str)];

/// The name of an operation.
pub(super) fn name<T: Copy + PartialEq>(names: Names<T>, of: T) -> &'static str {
    names.iter().find(|(it, _)| *it == of).expect("every operation has a name").1
}

/// The operation with a name.
pub(super) fn named<T: Copy>(names: Names<T>, text: &str) -> Option<T> {
    names.iter().find(|(_, name)| *name == text).map(|(it, _)| *it)
}

/// Whether a place is a multiple of its size, and how a load fills its type.
pub(in crate::engine) const LOADS: Names<(Load, bool)> = &[
    ((Load::Whole, true), "load"),
    ((Load::Whole, false), "load_unaligned"),
    ((Load::ZeroExtended, true), "load_zero_extended"),
    ((Load::ZeroExtended, false), "load_zero_extended_unaligned"),
    ((Load::SignExtended, true), "load_sign_extended"),
    ((Load::SignExtended, false), "load_sign_extended_unaligned"),
];

pub(super) const STORES: Names<bool> = &[(true, "store"), (false, "store_unaligned")];

pub(in crate::engine) const UNARIES: Names<Unary> = &[
    (Unary::Not, "not"),
    (Unary::Neg, "neg"),
    (Unary::CountOnes, "count_ones"),
    (Unary::ZeroExtend, "zero_extend"),
    (Unary::SignExtend, "sign_extend"),
    (Unary::Truncate, "truncate"),
    (Unary::Cast, "cast"),
    (Unary::Splat, "splat"),
    (Unary::Lowest, "lowest"),
    (Unary::WidenLow { signed: false }, "widen_low"),
    (Unary::WidenLow { signed: true }, "widen_low_signed"),
    (Unary::WidenHigh { signed: false }, "widen_high"),
    (Unary::WidenHigh { signed: true }, "widen_high_signed"),
    (Unary::HighBits, "high_bits"),
    (Unary::AnyBit, "any_bit"),
    (Unary::ToFloat, "floats"),
    (Unary::ToInteger, "integers"),
];

pub(in crate::engine) const BINARIES: Names<Binary> = &[
    (Binary::Add, "add"),
    (Binary::Sub, "sub"),
    (Binary::Mul, "mul"),
    (Binary::Div, "div"),
    (Binary::And, "and"),
    (Binary::Or, "or"),
    (Binary::Xor, "xor"),
    (Binary::Shl, "shl"),
    (Binary::Shr, "shr"),
    (Binary::Sar, "sar"),
    (Binary::RotateLeft, "rotate_left"),
    (Binary::Min, "min"),
    (Binary::Narrow { signed: false }, "narrow"),
    (Binary::Narrow { signed: true }, "narrow_signed"),
    (Binary::Swizzle, "swizzle"),
    (Binary::LookUp, "look_up"),
    (Binary::MulFloat, "mul_float"),
];

pub(in crate::engine) const COMPARISONS: Names<Comparison> = &[
    (Comparison::Equal, "eq"),
    (Comparison::NotEqual, "ne"),
    (Comparison::SignedLessThan, "slt"),
    (Comparison::SignedLessThanOrEqual, "sle"),
    (Comparison::SignedGreaterThan, "sgt"),
    (Comparison::SignedGreaterThanOrEqual, "sge"),
    (Comparison::UnsignedLessThan, "ult"),
    (Comparison::UnsignedLessThanOrEqual, "ule"),
    (Comparison::UnsignedGreaterThan, "ugt"),
    (Comparison::UnsignedGreaterThanOrEqual, "uge"),
];

impl Display for Type {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}{}", if self.is_float() { "f" } else { "i" }, self.element())?;
        if self.is_vector() { write!(f, "x{}", self.lanes()) } else { Ok(()) }
    }
}
