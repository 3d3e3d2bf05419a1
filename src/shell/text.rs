//! Text from outside, such as names in files, made safe for a terminal.

use tilewright_scenes::escape;

/// The longest word that is shown whole, and the parts that are shown of a longer one: its begin and its end.
const WORD: usize = 300;
const WORD_ENDS: (usize, usize) = (200, 80);

/// The longest line that is shown whole, and the part that is shown of a longer one.
const LINE: usize = 3000;
const LINE_ENDS: (usize, usize) = (2000, 800);

/// The text without control characters, and with long words and lines shortened. It keeps its line breaks.
pub fn legible(text: &str) -> String {
    text.split('\n').map(one_line).collect::<Vec<_>>().join("\n")
}

/// As [`legible`], on one line.
pub fn one_line(text: &str) -> String {
    let plain = escape(text);
    let words: Vec<String> = plain.split(' ').map(|word| cut(word, WORD, WORD_ENDS)).collect();
    cut(&words.join(" "), LINE, LINE_ENDS)
}

/// JSON without raw control characters. Above 0x7e they are legal in JSON, and control some terminals.
pub fn legible_json(json: &str) -> String {
    let escape = |c: char| match c.is_control() && c != '\n' {
        true => format!("\\u{:04x}", u32::from(c)),
        false => c.to_string(),
    };
    json.chars().map(escape).collect()
}

/// A text of more than `most` characters with its middle left out.
fn cut(text: &str, most: usize, (begin, end): (usize, usize)) -> String {
    // As many characters take at least as many bytes.
    let count = if text.len() > most { text.chars().count() } else { 0 };
    if count <= most {
        return text.to_owned();
    }
    let at = |place: usize| text.char_indices().nth(place).map_or(text.len(), |(byte, _)| byte);
    format!("{}[..]{}", &text[..at(begin)], &text[at(count - end)..])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_steers_a_terminal_is_shown_instead() {
        assert_eq!(legible("a \u{1b}]0;b\u{7}\nc\td\u{9b}e"), "a \\u{1b}]0;b\\u{7}\nc\\td\\u{9b}e");
        assert_eq!(one_line("a\nb\r \u{202e}c"), "a\\nb\\r \\u{202e}c");
        assert_eq!(legible("müde: größer, 日本"), "müde: größer, 日本");
        assert_eq!(legible_json("{\n\"a\": \"\u{9b}\u{7f}ü\"}"), "{\n\"a\": \"\\u009b\\u007fü\"}");
    }

    #[test]
    fn a_long_word_keeps_both_ends_and_the_words_beside_it() {
        let long = format!("x.obj:2: `{}e` is no number: write one", "ü".repeat(10_000_000));
        let shown = legible(&long);
        assert!(shown.starts_with("x.obj:2: `üü") && shown.ends_with("üe` is no number: write one"), "{shown}");
        assert!(shown.chars().count() < 400, "{shown}");
        let shown = legible(&"a b ".repeat(1_000_000));
        assert!(shown.len() < LINE && shown.contains("[..]"), "{shown}");
        let fits = "p/".repeat(150);
        assert_eq!(legible(&fits), fits);
    }
}
