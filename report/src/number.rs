//! Numbers as a page shows them. Files of data have all digits.

/// A number with four significant digits, or all digits of a whole one.
pub fn shown(value: f64) -> String {
    let size = value.abs();
    if !value.is_finite() {
        return "–".to_owned();
    }
    let text = if size != 0.0 && !(1e-3..1e15).contains(&size) {
        scientific(size)
    } else if size.fract() == 0.0 || size >= 1e4 {
        grouped(&format!("{size:.0}"))
    } else {
        significant(size, 4)
    };
    if value < 0.0 { format!("\u{2212}{text}") } else { text }
}

/// A difference in percent, or a factor, with two significant digits, so that it is never shown as 0.
pub fn percent(value: f64) -> String {
    if value >= 100.0 { grouped(&format!("{value:.0}")) } else { significant(value, 2) }
}

/// A number without zeros at the end.
fn significant(size: f64, digits: i32) -> String {
    if size == 0.0 {
        return "0".to_owned();
    }
    let rounded: f64 = format!("{size:.*e}", (digits - 1) as usize).parse().expect("a printed number is one");
    format!("{rounded}")
}

/// Narrow spaces between thousands, from five digits on.
fn grouped(digits: &str) -> String {
    if digits.len() < 5 {
        return digits.to_owned();
    }
    let groups: Vec<&[u8]> = digits.as_bytes().rchunks(3).rev().collect();
    groups.iter().map(|group| String::from_utf8_lossy(group)).collect::<Vec<_>>().join("\u{202f}")
}

/// `1.5 × 10⁻⁷`.
fn scientific(size: f64) -> String {
    let text = format!("{size:.3e}");
    let (factor, exponent) = text.split_once('e').expect("a number in this notation has an exponent");
    let factor = significant(factor.parse().expect("a printed number is one"), 4);
    format!("{factor} × 10{}", raised(exponent))
}

/// Digits as superscripts.
pub fn raised(digits: &str) -> String {
    let one = |c: char| match c {
        '-' => '⁻',
        c => ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'][c.to_digit(10).unwrap_or(0) as usize],
    };
    digits.chars().map(one).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_well() {
        let cases = [
            (0.0, "0"),
            (-0.5, "\u{2212}0.5"),
            (1.8044, "1.804"),
            (23.3351, "23.34"),
            (9999.0, "9999"),
            (12345.6, "12\u{202f}346"),
            (1_398_100.0, "1\u{202f}398\u{202f}100"),
            (0.000_000_15, "1.5 × 10⁻⁷"),
            (1e20, "1 × 10²⁰"),
            (f64::NAN, "–"),
        ];
        for (value, text) in cases {
            assert_eq!(shown(value), text);
        }
    }

    #[test]
    fn a_difference_never_reads_as_none() {
        assert_eq!([0.000_123, 3.16, 25.0, 141.4].map(percent), ["0.00012", "3.2", "25", "141"]);
    }
}
