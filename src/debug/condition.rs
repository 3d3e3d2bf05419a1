//! A condition on a net, as a user types it.

use super::nets::Net;
use std::cmp::Ordering;
use tilewright_hdl::Bits;
use tilewright_hdl::ir::Kind;

/// A net compared with a number.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Condition {
    /// The name of the net.
    pub net: String,
    relation: Relation,
    number: Number,
    is_signed: bool,
}

/// The longest relations first, so that `<=` is not taken for `<`.
const RELATIONS: [(&str, Relation); 7] = [
    ("==", Relation::Is),
    ("!=", Relation::IsNot),
    ("<=", Relation::AtMost),
    (">=", Relation::AtLeast),
    ("<", Relation::Below),
    (">", Relation::Above),
    ("=", Relation::Is),
];

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Relation {
    Is,
    IsNot,
    AtMost,
    AtLeast,
    Below,
    Above,
}

/// A number with its sign apart.
type Number = (bool, u128);

impl Condition {
    /// Reads `used == 3`, `state != Idle`, `x < -5`, or `valid` alone, which means that it is not 0.
    ///
    /// # Errors
    /// A sentence that says what to type.
    pub fn parse(text: &str, nets: &[Net]) -> Result<Condition, String> {
        let text = text.trim();
        let found = RELATIONS.iter().find_map(|(sign, relation)| Some((text.split_once(sign)?, *relation)));
        let ((name, value), relation) = found.unwrap_or(((text, "0"), Relation::IsNot));
        let (name, value) = (name.trim(), value.trim());
        if name.is_empty() {
            return Err("type a condition such as `used == 3`".to_owned());
        }
        let net = nets.iter().find(|net| net.name == name);
        let net = net.ok_or_else(|| format!("there is no net `{name}`: / finds one by a part of its name"))?;
        let number = number(value, net.kind).ok_or_else(|| format!("`{value}` is {}", expected(net)))?;
        Ok(Condition { net: name.to_owned(), relation, number, is_signed: net.kind == Kind::Signed })
    }

    /// Whether it is true of a value of the net.
    pub fn holds(&self, value: &Bits) -> bool {
        let value = match self.is_signed {
            true => value.to_i128().map(|value| (value < 0, value.unsigned_abs())),
            false => value.to_u128().map(|value| (false, value)),
        };
        // What has more than 128 bits is greater than any number.
        let ordering = value.map_or(Ordering::Greater, |value| compare(value, self.number));
        match self.relation {
            Relation::Is => ordering.is_eq(),
            Relation::IsNot => ordering.is_ne(),
            Relation::AtMost => ordering.is_le(),
            Relation::AtLeast => ordering.is_ge(),
            Relation::Below => ordering.is_lt(),
            Relation::Above => ordering.is_gt(),
        }
    }
}

fn compare((is_negative, size): Number, (other_is_negative, other): Number) -> Ordering {
    match (is_negative, other_is_negative) {
        (false, false) => size.cmp(&other),
        (true, true) => other.cmp(&size),
        (is_negative, _) => {
            if is_negative {
                Ordering::Less
            } else {
                Ordering::Greater
            }
        }
    }
}

/// A number in decimal, with 0x in hexadecimal or with 0b in binary, or the name of a code.
fn number(text: &str, kind: Kind) -> Option<Number> {
    if let Kind::Code(names) = kind
        && let Some(place) = names.codes.iter().position(|code| *code == text)
    {
        return Some((false, u128::from(names.values[place])));
    }
    let (is_negative, size) = text.strip_prefix('-').map_or((false, text), |size| (true, size));
    let (digits, radix) = match (size.strip_prefix("0x"), size.strip_prefix("0b")) {
        (Some(digits), _) => (digits, 16),
        (_, Some(digits)) => (digits, 2),
        _ => (size, 10),
    };
    let size = digits.bytes().all(|digit| digit.is_ascii_hexdigit()).then(|| u128::from_str_radix(digits, radix));
    let size = size?.ok()?;
    Some((is_negative && size > 0, size))
}

/// What a value of the net can be compared with.
fn expected(net: &Net) -> String {
    match net.kind {
        Kind::Code(names) => format!("no number and no code of {}: there are {}", names.of, names.codes.join(", ")),
        _ => "no number: give 12, 0xc or 0b1100".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn nets() -> Vec<Net> {
        let net = |name: &str, kind| Net { name: name.to_owned(), width: 8, kind, source: None };
        vec![net("used", Kind::Number), net("u_a[3].x", Kind::Signed)]
    }

    fn holds(text: &str, values: [i64; 4]) -> [bool; 4] {
        let condition = Condition::parse(text, &nets()).unwrap();
        values.map(|value| condition.holds(&Bits::from_i128(8, value.into())))
    }

    #[test]
    fn each_relation_compares_numbers_of_any_radix_with_their_signs() {
        let values = [2, 3, 4, 0];
        assert_eq!(holds("used == 3", values), [false, true, false, false]);
        assert_eq!(holds("used=0b11", values), [false, true, false, false]);
        assert_eq!(holds(" used != 0x3 ", values), [true, false, true, true]);
        assert_eq!(holds("used<=3", values), [true, true, false, true]);
        assert_eq!(holds("used >= 3", values), [false, true, true, false]);
        assert_eq!(holds("used < 3", values), [true, false, false, true]);
        assert_eq!(holds("used > 3", values), [false, false, true, false]);
        assert_eq!(holds("used", values), [true, true, true, false]);
        assert_eq!(holds("u_a[3].x < -2", [-3, -2, 0, 5]), [true, false, false, false]);
        assert_eq!(holds("used < 200", [-3, 5, 0, 100]), [false, true, true, true]);
    }

    #[test]
    fn what_is_no_condition_is_said_with_a_remedy() {
        let problem = |text| Condition::parse(text, &nets()).unwrap_err();
        assert_eq!(problem("== 3"), "type a condition such as `used == 3`");
        assert_eq!(problem("usde == 3"), "there is no net `usde`: / finds one by a part of its name");
        for text in ["used == three", "used == ", "used == +3", "used < 0x"] {
            assert!(problem(text).ends_with("no number: give 12, 0xc or 0b1100"), "{text}");
        }
    }
}
