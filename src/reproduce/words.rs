//! Numbers in sentences.

/// A number with about three digits, whole from a thousand on.
pub fn short(value: f64) -> String {
    let digits = match value.abs() {
        size if size >= 100.0 => 0,
        size if size >= 10.0 => 1,
        _ => 2,
    };
    let text = format!("{value:.digits$}");
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => grouped(&text),
    }
}

/// A share in percent: whole numbers, or with one decimal where it is small.
pub fn percent(part: f64) -> String {
    let percent = 100.0 * part;
    if percent.abs() >= 9.95 {
        format!("{percent:.0}\u{a0}%")
    } else {
        format!("{}\u{a0}%", short((10.0 * percent).round() / 10.0))
    }
}

/// A number with narrow spaces between thousands, from five digits on.
fn grouped(digits: &str) -> String {
    if digits.len() < 5 {
        return digits.to_owned();
    }
    let groups: Vec<&[u8]> = digits.as_bytes().rchunks(3).rev().collect();
    groups.iter().map(|group| String::from_utf8_lossy(group)).collect::<Vec<_>>().join("\u{202f}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_in_sentences() {
        assert_eq!(
            [0.0, 0.614, 2.5, 33.34, 99.96, 239.4, 158_432.0].map(short),
            ["0", "0.61", "2.5", "33.3", "100", "239", "158\u{202f}432"]
        );
        assert_eq!(
            [0.0, 0.0123, 0.0996, 0.734, 1.5].map(percent),
            ["0\u{a0}%", "1.2\u{a0}%", "10\u{a0}%", "73\u{a0}%", "150\u{a0}%"]
        );
    }
}
