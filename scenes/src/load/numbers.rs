//! Numbers in text files.

use super::lines::At;
use crate::error::SceneError;
use crate::quote::{number as shown_number, quote_bytes};

/// Finite numbers; their count must be one of `counts`.
pub(super) fn numbers<const N: usize>(
    at: At,
    keyword: &str,
    words: &[impl AsRef<[u8]>],
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
        let value = number(at, keyword, word.as_ref())?;
        if let Some(place) = values.get_mut(i) {
            *place = value;
        }
    }
    Ok(values)
}

/// A number as programs write it: `1.5`, `+1`, `-2e-3`, `1e+003`.
pub(super) fn parsed(word: &[u8]) -> Option<f64> {
    std::str::from_utf8(word).ok()?.parse().ok()
}

/// Below 1e30, so that a camera can frame anything made of such numbers.
fn number(at: At, keyword: &str, word: &[u8]) -> Result<f64, SceneError> {
    match parsed(word) {
        Some(value) if value.abs() < 1e30 => Ok(value),
        Some(_) => {
            let problem = format!("`{keyword}` with the number {}", quote_bytes(word));
            Err(at.error(problem, "give finite numbers below 1e30"))
        }
        None => {
            let problem = format!("{} after `{keyword}` is not a number", quote_bytes(word));
            Err(at.error(problem, "write it as in 1.5 or -2e-3"))
        }
    }
}

/// Checks that a vertex has no weight but 1.
pub(super) fn check_weight(at: At, weight: f64) -> Result<(), SceneError> {
    match weight == 1.0 {
        true => Ok(()),
        false => Err(at.error(
            format!("`v` with the weight {}", shown_number(weight)),
            "remove it: weights belong to free-form surfaces",
        )),
    }
}
