//! Text and numbers of a user's file or command line in a message: short, and without control sequences for a terminal.

use std::path::Path;

/// The most characters of a name or a word in a message.
const WORD: usize = 60;
/// The most characters of a path in a message.
const PATH: usize = 1000;

/// The text in backticks, escaped like [`escape`]; longer texts are cut to their first 60 characters.
pub fn quote(text: &str) -> String {
    format!("`{}`", brief(text, WORD))
}

/// Like [`quote`], for bytes that need not be UTF-8: others are written as in Rust, `\xe9`.
pub(crate) fn quote_bytes(bytes: &[u8]) -> String {
    // Enough bytes for the characters that are shown.
    let chunks = bytes[..bytes.len().min(4 * WORD + 4)].utf8_chunks();
    let text: String =
        chunks.flat_map(|chunk| [chunk.valid().to_owned(), chunk.invalid().escape_ascii().to_string()]).collect();
    quote(&text)
}

/// The text with everything that changes its display on a terminal written as in Rust: `\u{1b}` for the escape
/// character.
pub fn escape(text: &str) -> String {
    let mut shown = String::with_capacity(text.len());
    for c in text.chars() {
        match is_obeyed(c) {
            true => shown.extend(c.escape_default()),
            false => shown.push(c),
        }
    }
    shown
}

/// The first `most` characters of the text, escaped.
pub(crate) fn brief(text: &str, most: usize) -> String {
    match text.char_indices().nth(most) {
        Some((end, _)) => format!("{}…", escape(&text[..end])),
        None => escape(text),
    }
}

/// A path for a message.
pub(crate) fn shown(path: &Path) -> String {
    brief(&path.to_string_lossy(), PATH)
}

/// A number for a message: one with hundreds of digits as a power of ten.
pub(crate) fn number(number: f64) -> String {
    let plain = number == 0.0 || (1e-6..1e6).contains(&number.abs()) || !number.is_finite();
    if plain { number.to_string() } else { format!("{number:e}") }
}

/// Control characters, line ends, and characters that reverse the direction of writing.
fn is_obeyed(c: char) -> bool {
    c.is_control()
        || matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_terminal_obeys_is_escaped_and_nothing_else() {
        assert_eq!(escape("a\u{1b}[2J\tb\u{9b}\u{7f}"), "a\\u{1b}[2J\\tb\\u{9b}\\u{7f}");
        assert_eq!(escape("\u{202e}\u{2069}\u{61c}\u{200f}\u{2028}"), "\\u{202e}\\u{2069}\\u{61c}\\u{200f}\\u{2028}");
        assert_eq!(escape("Würfel \\ 立方体 'a' \u{2027}\u{202f}"), "Würfel \\ 立方体 'a' \u{2027}\u{202f}");
    }

    #[test]
    fn long_text_is_cut_at_a_character() {
        assert_eq!(quote("é".repeat(60).as_str()), format!("`{}`", "é".repeat(60)));
        assert_eq!(quote("é".repeat(61).as_str()), format!("`{}…`", "é".repeat(60)));
        assert_eq!(quote(""), "``");
    }
}
