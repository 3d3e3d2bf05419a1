//! Comma-separated values (RFC 4180, with plain line ends).

/// A file of these rows, after a row with the names of the columns.
pub fn csv(rows: impl IntoIterator<Item = Vec<String>>) -> Vec<u8> {
    rows.into_iter()
        .map(|row| row.iter().map(|cell| quoted(cell)).collect::<Vec<_>>().join(",") + "\n")
        .collect::<String>()
        .into()
}

/// A number with all its digits; an empty cell if it is not finite.
pub fn cell(value: f64) -> String {
    if value.is_finite() { value.to_string() } else { String::new() }
}

fn quoted(cell: &str) -> String {
    match cell.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", cell.replace('"', "\"\"")),
        false => cell.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_would_end_a_cell_is_quoted() {
        let rows = [vec!["a,b".to_owned(), "say \"yes\"".to_owned()], vec!["plain".to_owned(), cell(0.1)]];
        assert_eq!(String::from_utf8(csv(rows)).unwrap(), "\"a,b\",\"say \"\"yes\"\"\"\nplain,0.1\n");
    }
}
