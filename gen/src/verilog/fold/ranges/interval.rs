//! An interval of values, and the results of operators on it.

use tilewright_circuit::Bits;
use tilewright_circuit::ir::Binary;

/// The values from `low` to `high`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Range {
    pub low: u64,
    pub high: u64,
}

impl Range {
    pub fn one(value: u64) -> Range {
        Range { low: value, high: value }
    }

    pub fn of_width(width: u32) -> Range {
        Range { low: 0, high: highest(width) }
    }

    pub fn of_constant(value: &Bits) -> Range {
        value.to_u64().map_or(Range::of_width(64), Range::one)
    }

    pub fn with(self, other: Range) -> Range {
        Range { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// The intersection, if it is not empty.
    pub fn within(self, other: Range) -> Option<Range> {
        let (low, high) = (self.low.max(other.low), self.high.min(other.high));
        (low <= high).then_some(Range { low, high })
    }

    /// Without a value, which must be an end of the range.
    pub fn without(self, value: u64) -> Option<Range> {
        match self {
            Range { low, high } if low == high && low == value => None,
            Range { low, high } if low == value => Some(Range { low: low + 1, high }),
            Range { low, high } if high == value => Some(Range { low, high: high - 1 }),
            range => Some(range),
        }
    }
}

pub fn highest(width: u32) -> u64 {
    if width >= 64 { u64::MAX } else { (1 << width) - 1 }
}

/// All bits up to the highest one of a value.
fn mask(value: u64) -> u64 {
    highest(64 - value.leading_zeros())
}

/// The results of an operator on all values of two intervals; `width` is the range of the result's width.
pub fn of_binary(operator: Binary, a: Range, b: Range, width: Range) -> Range {
    match operator {
        Binary::And => Range { low: 0, high: a.high.min(b.high) },
        Binary::Or => Range { low: a.low.max(b.low), high: mask(a.high | b.high) },
        Binary::Xor => Range { low: 0, high: mask(a.high | b.high) },
        Binary::Add if a.high + b.high <= width.high => Range { low: a.low + b.low, high: a.high + b.high },
        Binary::Sub if a.low >= b.high => Range { low: a.low - b.high, high: a.high - b.low },
        // As wide as both together, so that it fits.
        Binary::Mul => Range { low: a.low * b.low, high: a.high * b.high },
        _ => width,
    }
}
