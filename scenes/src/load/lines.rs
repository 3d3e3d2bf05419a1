//! The lines of OBJ and MTL files, their numbers, and errors that name them.

use crate::error::SceneError;
use crate::quote::{quote, shown};
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

/// Lines without comments, those that end in a backslash joined to the next; with the number of the first, counted from 1.
pub(super) fn logical_lines(text: &str) -> impl Iterator<Item = (usize, String)> + '_ {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut lines = (1..).zip(text.lines());
    std::iter::from_fn(move || {
        let (number, mut line) = lines.next()?;
        let mut whole = String::new();
        loop {
            let code = line.split('#').next().unwrap_or_default();
            match code.trim_end().strip_suffix('\\') {
                Some(begun) => whole.push_str(begun),
                None => {
                    whole.push_str(code);
                    return Some((number, whole));
                }
            }
            whole.push(' ');
            match lines.next() {
                Some((_, next)) => line = next,
                None => return Some((number, whole)),
            }
        }
    })
}

/// Finite numbers, as many as one of `counts` says.
pub(super) fn numbers<const N: usize>(
    at: At,
    keyword: &str,
    words: &[&str],
    counts: &[usize],
) -> Result<[f64; N], SceneError> {
    if !counts.contains(&words.len()) {
        let counts: Vec<String> = counts.iter().map(usize::to_string).collect();
        return Err(
            at.error(format!("`{keyword}` with {} numbers", words.len()), format!("give {}", counts.join(" or ")))
        );
    }
    let mut values = [0.0; N];
    for (i, word) in words.iter().enumerate() {
        let value = number(at, keyword, word)?;
        if let Some(place) = values.get_mut(i) {
            *place = value;
        }
    }
    Ok(values)
}

/// Below 1e30, so that a camera can frame whatever is made of such numbers.
fn number(at: At, keyword: &str, word: &str) -> Result<f64, SceneError> {
    match word.parse::<f64>() {
        Ok(value) if value.abs() < 1e30 => Ok(value),
        Ok(_) => {
            Err(at.error(format!("`{keyword}` with the number {}", quote(word)), "give finite numbers below 1e30"))
        }
        Err(_) => {
            Err(at.error(format!("{} after `{keyword}` is not a number", quote(word)), "write it as in 1.5 or -2e-3"))
        }
    }
}
