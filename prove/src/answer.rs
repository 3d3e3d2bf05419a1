//! The solver's values.

use tilewright_hdl::Bits;

/// A value such as `true`, `#b01` or `#x1f`, the lowest bit first; `None` if the text is none.
pub fn bits(text: &str) -> Option<Vec<bool>> {
    if let Some(digits) = text.strip_prefix("#b") {
        return Some(digits.chars().rev().map(|digit| digit == '1').collect());
    }
    if let Some(digits) = text.strip_prefix("#x") {
        let digits: Option<Vec<u32>> = digits.chars().rev().map(|digit| digit.to_digit(16)).collect();
        return Some(digits?.into_iter().flat_map(|digit| (0..4).map(move |bit| digit >> bit & 1 == 1)).collect());
    }
    match text {
        "true" => Some(vec![true]),
        "false" => Some(vec![false]),
        _ => None,
    }
}

/// Bits, the lowest first, as a value.
pub fn value(bits: &[bool]) -> Bits {
    let limb = |bits: &[bool]| bits.iter().rev().fold(0, |limb, bit| limb << 1 | u64::from(*bit));
    Bits::from_limbs(bits.len() as u32, &bits.chunks(64).map(limb).collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_of_all_forms_are_read() {
        let read = ["#b01", "#x1f", "true"].map(|text| value(&bits(text).unwrap()));
        assert_eq!(read, [Bits::new(2, 1), Bits::new(8, 31), Bits::new(1, 1)]);
        assert_eq!(bits("(error \"line 1\")"), None);
    }

    #[test]
    fn a_value_may_be_wider_than_a_word() {
        let mut bits = vec![false; 70];
        (bits[0], bits[69]) = (true, true);
        assert_eq!(value(&bits), Bits::from_limbs(70, &[1, 32]));
    }
}
