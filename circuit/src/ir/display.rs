//! The text that a circuit displays, and the values in it.

use super::{Kind, NodeId};
use crate::bits::Bits;

/// A value in the text of a [`Display`](super::Directive::Display).
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = tilewright_sim::shown! { |m, i| in { take: bit(), level: bits(8).signed() } out { taken: bit() }
/// m.display(i.take, "taken at level {}", &[i.level]);
/// #     ShownOut { taken: i.take }
/// # };
/// let (top, property) = (design.top(), &design.top().properties[0]);
/// assert_eq!(property.values, [ir::Shown { node: top.inputs[1].node, kind: ir::Kind::Signed }]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shown {
    /// The value, of the shape of the property's condition.
    pub node: NodeId,
    /// The meaning of the value's bits.
    pub kind: Kind,
}

/// A piece of the text of a [`Display`](super::Directive::Display).
///
/// ```
/// # use tilewright_hdl::*;
/// let pieces = ir::Piece::of("{{x}} is {:x}").unwrap();
/// assert_eq!(pieces, [ir::Piece::Text("{x} is ".into()), ir::Piece::Value(ir::Format::Hexadecimal)]);
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Piece {
    /// Text, as it is.
    Text(String),
    /// The next value, in this form.
    Value(Format),
}

/// The form of a value in a text.
///
/// ```
/// # use tilewright_hdl::*;
/// let value = Bits::new(8, 0xfe);
/// let all = [ir::Format::Plain, ir::Format::Hexadecimal, ir::Format::Binary];
/// assert_eq!(all.map(|format| format.write(&value, ir::Kind::Signed)), ["-2", "fe", "11111110"]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// `{}`: a decimal number, with a sign if the value is signed. A code is shown by its name, or as `?` if it has
    /// none.
    Plain,
    /// `{:x}`: hexadecimal digits without leading zeros.
    Hexadecimal,
    /// `{:b}`: binary digits without leading zeros.
    Binary,
}

impl Piece {
    /// The pieces of a text. Its values are `{}`, `{:x}` and `{:b}`, and its braces are `{{` and `}}`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// assert_eq!(ir::Piece::of("level {:o}").unwrap_err(), "`{:o}` is no form of a value");
    /// ```
    ///
    /// # Errors
    ///
    /// The reason why this is no such text.
    pub fn of(text: &str) -> Result<Vec<Piece>, String> {
        let (mut pieces, mut plain, mut rest) = (Vec::new(), String::new(), text);
        while let Some(at) = rest.find(['{', '}']) {
            plain += &rest[..at];
            let brace = &rest[at..=at];
            rest = &rest[at + 1..];
            if let Some(behind) = rest.strip_prefix(brace) {
                (plain, rest) = (plain + brace, behind);
                continue;
            }
            let end = rest.find('}').filter(|_| brace == "{");
            let Some(end) = end else { return Err(format!("a `{brace}` stands alone")) };
            let format = match &rest[..end] {
                "" => Format::Plain,
                ":x" => Format::Hexadecimal,
                ":b" => Format::Binary,
                other => return Err(format!("`{{{other}}}` is no form of a value")),
            };
            if !plain.is_empty() {
                pieces.push(Piece::Text(std::mem::take(&mut plain)));
            }
            pieces.push(Piece::Value(format));
            rest = &rest[end + 1..];
        }
        plain += rest;
        if !plain.is_empty() {
            pieces.push(Piece::Text(plain));
        }
        Ok(pieces)
    }
}

impl Format {
    /// The value in this form.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// assert_eq!(ir::Format::Plain.write(&Bits::ones(100), ir::Kind::Number), "1267650600228229401496703205375");
    /// ```
    pub fn write(self, value: &Bits, kind: Kind) -> String {
        match (self, kind) {
            (Format::Hexadecimal, _) => short(&format!("{value:x}")),
            (Format::Binary, _) => {
                short(&(0..value.width()).rev().map(|bit| if value.bit(bit) { '1' } else { '0' }).collect::<String>())
            }
            (Format::Plain, Kind::Code(names)) => {
                value.to_u64().and_then(|number| names.name(number)).unwrap_or("?").to_owned()
            }
            (Format::Plain, Kind::Signed) if value.bit(value.width() - 1) => {
                // One bit more, for the least number.
                let wide = value.sext(value.width() + 1).not();
                format!("-{}", decimal(&increment(wide.limbs())))
            }
            (Format::Plain, _) => decimal(value.limbs()),
        }
    }
}

/// The digits without leading zeros.
fn short(digits: &str) -> String {
    let short = digits.trim_start_matches('0');
    if short.is_empty() { "0".to_owned() } else { short.to_owned() }
}

/// The number plus 1.
fn increment(limbs: &[u64]) -> Vec<u64> {
    let mut carries = true;
    let add = |limb: &u64| {
        let (sum, carry) = limb.overflowing_add(u64::from(carries));
        carries = carry;
        sum
    };
    limbs.iter().map(add).collect()
}

fn decimal(limbs: &[u64]) -> String {
    /// The greatest number of decimal digits that fits a limb.
    const DIGITS: (u128, usize) = (10_u128.pow(19), 19);
    let (mut limbs, mut groups) = (limbs.to_vec(), Vec::new());
    while limbs.iter().any(|limb| *limb != 0) {
        let mut rest = 0;
        for limb in limbs.iter_mut().rev() {
            let all = rest << u64::BITS | u128::from(*limb);
            (*limb, rest) = ((all / DIGITS.0) as u64, all % DIGITS.0);
        }
        groups.push(rest);
    }
    short(&groups.iter().rev().map(|group| format!("{group:0width$}", width = DIGITS.1)).collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_any_width_are_decimal() {
        let plain = |value: &Bits, kind| Format::Plain.write(value, kind);
        for value in [0_u128, 9, 10, u128::from(u64::MAX), 10_u128.pow(19), 10_u128.pow(19) - 1, u128::MAX] {
            assert_eq!(plain(&Bits::from_u128(128, value), Kind::Number), value.to_string());
        }
        for value in [0_i128, -1, 5, i128::from(i64::MIN), i128::MIN, i128::MAX] {
            assert_eq!(plain(&Bits::from_i128(128, value), Kind::Signed), value.to_string());
        }
        assert_eq!([0, 1].map(|value| plain(&Bits::new(1, value), Kind::Signed)), ["0", "-1"]);
    }

    #[test]
    fn texts_have_pieces_or_are_refused() {
        let value = Piece::Value;
        let found = Piece::of("{}{:b} {{}} {:x}").unwrap();
        let text = Piece::Text(" {} ".to_owned());
        assert_eq!(found, [value(Format::Plain), value(Format::Binary), text, value(Format::Hexadecimal)]);
        assert_eq!(Piece::of("").unwrap(), []);
        for (text, problem) in
            [("{", "a `{` stands alone"), ("a } b", "a `}` stands alone"), ("{x}", "`{x}` is no form of a value")]
        {
            assert_eq!(Piece::of(text).unwrap_err(), problem);
        }
    }
}
