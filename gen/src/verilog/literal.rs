//! Constants: decimal where a number counts, hexadecimal where its bits make a pattern.

use tilewright_hdl::Bits;

/// What a constant stands for where it is used.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Style {
    /// A number, as in a sum.
    Count,
    /// Bits, as in a mask.
    Pattern,
}

/// Larger numbers are patterns wherever they are used.
const LARGEST_COUNT: u64 = 99_999;

/// A sized literal.
pub fn literal(value: &Bits, style: Style) -> String {
    let width = value.width();
    match value.to_u64() {
        _ if width == 1 => format!("1'b{value:b}"),
        Some(number) if width < 4 || (style == Style::Count && number <= LARGEST_COUNT) => format!("{width}'d{number}"),
        _ => format!("{width}'h{value:x}"),
    }
}
