//! Which names a crate can have.

use crate::shell::{Exit, Failure};

/// The words of Rust's grammar, those of later editions among them, which no crate can be called.
const KEYWORDS: [&str; 51] = [
    "abstract", "as", "async", "await", "become", "box", "break", "const", "continue", "crate", "do", "dyn", "else",
    "enum", "extern", "false", "final", "fn", "for", "gen", "if", "impl", "in", "let", "loop", "macro", "match", "mod",
    "move", "mut", "override", "priv", "pub", "ref", "return", "self", "static", "struct", "super", "trait", "true",
    "try", "type", "typeof", "unsafe", "unsized", "use", "virtual", "where", "while", "yield",
];

/// Crates that are there already: Rust's own, and those that the new one needs.
const TAKEN: [&str; 8] =
    ["alloc", "core", "proc-macro", "std", "test", "tilewright-gen", "tilewright-hdl", "tilewright-sim"];

/// The most letters: as file systems and registries have it.
const LONGEST: usize = 64;

/// That a crate can have that name.
///
/// # Errors
/// It cannot.
pub fn check(name: &str) -> Result<(), Failure> {
    let is_letter = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-' || c == '_';
    let begins = name.starts_with(|c: char| c.is_ascii_lowercase());
    let problem = if !begins || !name.chars().all(is_letter) {
        "is no crate's name: give lower-case letters, digits, `-` and `_`, a letter first"
    } else if name.len() > LONGEST {
        "is too long for a crate's name: give 64 letters at most"
    } else if KEYWORDS.contains(&name) {
        "is a word of Rust, and no crate's name: give another one"
    } else if TAKEN.contains(&name.replace('_', "-").as_str()) {
        "is the name of a crate that there is: give another one"
    } else {
        return Ok(());
    };
    Err(Failure::new(Exit::BadInput, format!("`{name}` {problem}")))
}
