//! Constants: in the radix of the description, otherwise decimal if the number counts, and hexadecimal if its bits
//! are a pattern.

use tilewright_circuit::{Bits, Radix};

/// The meaning of a constant where it is used.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Style {
    /// A number, as in a sum.
    Count,
    /// Bits, as in a mask.
    Pattern,
}

/// Larger numbers are patterns wherever they are used.
const LARGEST_COUNT: u64 = 99_999;

/// Wider values are not printed in binary.
const WIDEST_BINARY: u32 = 64;

/// A sized literal.
pub fn literal(value: &Bits, style: Style) -> String {
    let width = value.width();
    match value.to_u64() {
        _ if value.radix() == Radix::Binary && width <= WIDEST_BINARY => format!("{width}'b{value:b}"),
        _ if width > 1 && value.radix() == Radix::Hex => pattern(value),
        _ if width == 1 => format!("1'b{value:b}"),
        Some(number) if width < 4 || (style == Style::Count && number <= LARGEST_COUNT) => format!("{width}'d{number}"),
        _ => pattern(value),
    }
}

/// A sized literal of a signed number, in decimal unless the description writes it in another radix. The least number
/// of a width stays a pattern: without its sign it is too large for the width.
pub fn signed(value: &Bits) -> Option<String> {
    let width = value.width();
    let number = value.to_i128().filter(|_| value.radix() == Radix::Any && width > 1)?;
    let magnitude = u64::try_from(number.unsigned_abs()).ok().filter(|number| *number <= LARGEST_COUNT)?;
    let is_least = number < 0 && value.slice(0..width - 1).is_zero();
    let sign = if number < 0 { "-" } else { "" };
    (!is_least).then(|| format!("{sign}{width}'sd{magnitude}"))
}

/// The most digits of a literal: Icarus rejects a literal of more than 16,383 characters.
const LONGEST: usize = 8192;

/// A value in hexadecimal: one literal, or several side by side if it would be too long.
pub fn pattern(value: &Bits) -> String {
    let (width, digits) = (value.width() as usize, format!("{value:x}"));
    if digits.len() <= LONGEST {
        return format!("{width}'h{digits}");
    }
    // The first literal has the remainder; the others have whole digits.
    let (first, rest) = digits.split_at((digits.len() - 1) % LONGEST + 1);
    let rest = rest.as_bytes().chunks(LONGEST).map(|part| std::str::from_utf8(part).expect("digits are ASCII"));
    let head = format!("{}'h{first}", width - 4 * (digits.len() - first.len()));
    let parts: Vec<String> = [head].into_iter().chain(rest.map(|part| format!("{}'h{part}", 4 * LONGEST))).collect();
    format!("{{{}}}", parts.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn signed_numbers_have_a_sign_if_their_magnitude_fits() {
        let text = |width, number| signed(&Bits::from_i128(width, number));
        assert_eq!(text(8, -3).as_deref(), Some("-8'sd3"));
        assert_eq!(text(8, 127).as_deref(), Some("8'sd127"));
        assert_eq!(text(8, -127).as_deref(), Some("-8'sd127"));
        assert_eq!(text(200, -99_999).as_deref(), Some("-200'sd99999"));
        assert_eq!([text(8, -128), text(1, -1), text(1, 0), text(40, -100_000)], [const { None }; 4]);
        assert_eq!(signed(&Bits::from_i128(8, -3).shown_in(Radix::Hex)), None);
    }

    #[test]
    fn a_long_value_is_several_literals_of_its_width_together() {
        for width in [32_768, 32_769, 32_772, 65_536, 66_177] {
            let value = Bits::ones(width).concat(&Bits::new(4, 5));
            let text = pattern(&value);
            let parts: Vec<(u32, &str)> = text
                .trim_matches(['{', '}'])
                .split(", ")
                .map(|part| part.split_once("'h").unwrap())
                .map(|(width, digits)| (width.parse().unwrap(), digits))
                .collect();
            assert!(parts.iter().all(|(width, digits)| digits.len() == width.div_ceil(4) as usize), "{width}");
            assert!(parts.iter().all(|(_, digits)| digits.len() <= LONGEST), "{width}");
            assert_eq!(parts.iter().map(|part| part.0).sum::<u32>(), width + 4);
            let digits: String = parts.iter().map(|part| part.1).collect();
            assert_eq!(digits, format!("{value:x}"));
        }
        assert_eq!(pattern(&Bits::new(12, 0xabc)), "12'habc");
    }
}
