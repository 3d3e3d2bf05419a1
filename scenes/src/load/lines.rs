//! The statements of OBJ and MTL files, in bytes, and errors that name their lines.
//!
//! A name is all bytes up to the end of the line, whatever encoding they are in. Elsewhere a number sign begins a comment, and a backslash
//! at the end of a line continues it.

use crate::error::SceneError;
use crate::quote::shown;
use std::borrow::Cow;
use std::path::Path;

/// A line's number and its file, for errors.
#[derive(Clone, Copy)]
pub(super) struct At<'a> {
    pub(super) path: &'a Path,
    pub(super) line: usize,
}

impl At<'_> {
    pub(super) fn error(self, problem: impl Into<String>, remedy: impl Into<String>) -> SceneError {
        SceneError::Line { path: self.path.to_owned(), line: self.line, problem: problem.into(), remedy: remedy.into() }
    }

    /// A sentence with its place.
    pub(super) fn warning(self, sentence: &str) -> String {
        format!("{}:{}: {sentence}", shown(self.path), self.line)
    }
}

/// A statement of one line, or of several continued lines.
pub(super) struct Statement<'a> {
    /// The number of its first line, counted from 1.
    pub(super) line: usize,
    /// Without blanks before it.
    text: Cow<'a, [u8]>,
    /// The length of the keyword in bytes.
    keyword: usize,
}

/// Statements that give a name, besides the many that begin with `map_`.
const NAMING: [&str; 16] = [
    "newmtl",
    "usemtl",
    "mtllib",
    "o",
    "g",
    "usemap",
    "maplib",
    "call",
    "csh",
    "shadow_obj",
    "trace_obj",
    "bump",
    "disp",
    "decal",
    "refl",
    "norm",
];

impl Statement<'_> {
    /// The first word, in lower case, as programs differ in that.
    pub(super) fn keyword(&self) -> Cow<'_, str> {
        let keyword = self.spelled();
        if keyword.bytes().any(|byte| byte.is_ascii_uppercase()) {
            keyword.to_ascii_lowercase().into()
        } else {
            keyword
        }
    }

    /// The first word as the file has it.
    pub(super) fn spelled(&self) -> Cow<'_, str> {
        String::from_utf8_lossy(&self.text[..self.keyword])
    }

    /// The rest as a name, trimmed.
    pub(super) fn name(&self) -> &[u8] {
        trimmed(&self.text[self.keyword..])
    }

    /// The rest as words, up to a comment.
    pub(super) fn words(&self) -> impl Iterator<Item = &[u8]> {
        let mut has_ended = false;
        let words = self.name().split(|&byte| is_blank(byte)).filter(|word| !word.is_empty());
        let words = words.map_while(move |word| {
            let end = word.iter().position(|&byte| byte == b'#').filter(|_| !is_no_number(word));
            let whole = !has_ended;
            has_ended |= end.is_some();
            whole.then(|| &word[..end.unwrap_or(word.len())])
        });
        words.filter(|word| !word.is_empty())
    }

    /// Whether a backslash at its end continues it.
    fn is_continued(&self) -> bool {
        let keyword = self.keyword();
        !(keyword.starts_with('#') || keyword.starts_with("map_") || NAMING.contains(&&*keyword))
    }
}

/// The statements of a text, without empty lines and lines with only a comment.
pub(super) fn statements(text: &[u8]) -> impl Iterator<Item = Statement<'_>> {
    let ends_in_cr = ends_in_cr(text);
    let mut lines = (1..).zip(text.split(move |&byte| byte == b'\n' || ends_in_cr && byte == b'\r'));
    let statements = std::iter::from_fn(move || {
        let (line, text) = lines.next()?;
        // Files that were joined from several have a byte order mark in the middle.
        let text = trimmed(text.strip_prefix(b"\xef\xbb\xbf").unwrap_or(text));
        let keyword = text.iter().position(|&byte| is_blank(byte)).unwrap_or(text.len());
        let mut statement = Statement { line, text: text.into(), keyword };
        if text.ends_with(b"\\") && statement.is_continued() && !text.contains(&b'#') {
            let mut whole = text[..text.len() - 1].to_vec();
            for (_, next) in lines.by_ref() {
                let next = trimmed(next);
                let goes_on = next.ends_with(b"\\") && !next.contains(&b'#');
                whole.push(b' ');
                whole.extend(if goes_on { &next[..next.len() - 1] } else { next });
                if !goes_on {
                    break;
                }
            }
            statement = Statement { line, keyword: keyword.min(whole.len()), text: whole.into() };
        }
        Some(statement)
    });
    statements.filter(|statement| statement.keyword > 0 && statement.text[0] != b'#')
}

/// Whether CR alone ends lines, as on old Macs. A stray CR in a file with other line endings does not.
fn ends_in_cr(text: &[u8]) -> bool {
    let ends = text.iter().filter(|&&byte| byte == b'\n').count();
    let alone = |pair: &[u8]| pair[0] == b'\r' && !matches!(pair[1], b'\n' | b'\r');
    text.windows(2).filter(|pair| alone(pair)).count() > ends
}

/// Blanks between words; 1A ends DOS files.
pub(super) fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | b'\r' | 0x0b | 0x0c | 0x1a)
}

/// Trims blanks at both ends.
pub(super) fn trimmed(text: &[u8]) -> &[u8] {
    let begin = text.iter().position(|&byte| !is_blank(byte)).unwrap_or(text.len());
    let end = text.iter().rposition(|&byte| !is_blank(byte)).map_or(begin, |last| last + 1);
    &text[begin..end]
}

/// Whether a program wrote this for a number that it did not have: `nan`, `-nan(ind)`, `1.#QNAN`.
pub(super) fn is_no_number(word: &[u8]) -> bool {
    let word = word.to_ascii_lowercase();
    let word = word.strip_prefix(b"-").or(word.strip_prefix(b"+")).unwrap_or(&word);
    ["nan", "1.#ind", "1.#qnan", "1.#snan"].iter().any(|begin| word.starts_with(begin.as_bytes()))
}
