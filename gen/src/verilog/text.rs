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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_are_legal_in_a_format_string() {
        assert_eq!(format_text("100% \"of\" a\\b\n\té"), r#"100%% \"of\" a\\b\n\011\303\251"#);
    }
}
