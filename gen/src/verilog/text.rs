//! Texts within Verilog: in strings, and in attributes.

use tilewright_circuit::ir::Attribute;

/// A text within a string.
pub fn escaped(text: &str) -> String {
    let escape = |byte: u8| match byte {
        b'"' => "\\\"".to_string(),
        b'\\' => "\\\\".to_string(),
        b'\n' => "\\n".to_string(),
        b' '..=b'~' => char::from(byte).to_string(),
        byte => format!("\\{byte:03o}"),
    };
    text.bytes().map(escape).collect()
}

/// A text within a format string of `$display`.
pub fn format_text(text: &str) -> String {
    escaped(text).replace('%', "%%")
}

/// An attribute: `ram_style = "block"`.
pub fn attribute(attribute: &Attribute) -> String {
    format!("{} = \"{}\"", attribute.name, escaped(&attribute.value))
}

/// Attributes before their object; nothing if there are none.
pub fn mark(attributes: Vec<String>) -> String {
    if attributes.is_empty() { String::new() } else { format!("(* {} *) ", attributes.join(", ")) }
}

/// The words of a line outside strings and comments: identifiers, keywords, and the pieces of numbers.
pub fn words(line: &str) -> Vec<&str> {
    let (mut words, mut rest) = (Vec::new(), line);
    while let Some(first) = rest.chars().next() {
        let is_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
        let length = match first {
            '/' if rest.starts_with("//") => rest.len(),
            '"' => string_length(rest),
            c if is_word(c) => rest.find(|c| !is_word(c)).unwrap_or(rest.len()),
            c => c.len_utf8(),
        };
        if is_word(first) {
            words.push(&rest[..length]);
        }
        rest = &rest[length..];
    }
    words
}

/// The length of the string that a text begins with, with its quotes.
fn string_length(text: &str) -> usize {
    let mut is_escaped = false;
    let end = text.char_indices().skip(1).find(|&(_, c)| {
        let ends = c == '"' && !is_escaped;
        is_escaped = c == '\\' && !is_escaped;
        ends
    });
    end.map_or(text.len(), |(end, _)| end + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_of_strings_and_comments_are_none() {
        let line = r#"$write("a \"b\\", c_d, "e\\"); x <= 4'd9; // f"#;
        assert_eq!(words(line), ["write", "c_d", "x", "4", "d9"]);
        assert!(words(r#""never closed"#).is_empty());
    }

    #[test]
    fn texts_are_legal_in_a_format_string() {
        assert_eq!(format_text("100% \"of\" a\\b\n\té"), r#"100%% \"of\" a\\b\n\011\303\251"#);
    }
}
