//! The names that a crate can have.

use crate::shell::{Exit, Failure};

/// The keywords of Rust, those of later editions included, which cannot name a crate.
const KEYWORDS: [&str; 51] = [
    "abstract", "as", "async", "await", "become", "box", "break", "const", "continue", "crate", "do", "dyn", "else",
    "enum", "extern", "false", "final", "fn", "for", "gen", "if", "impl", "in", "let", "loop", "macro", "match", "mod",
    "move", "mut", "override", "priv", "pub", "ref", "return", "self", "static", "struct", "super", "trait", "true",
    "try", "type", "typeof", "unsafe", "unsized", "use", "virtual", "where", "while", "yield",
];

/// Names of crates that exist already: Rust's own, and those that the new crate needs.
const TAKEN: [&str; 8] =
    ["alloc", "core", "proc-macro", "std", "test", "tilewright-gen", "tilewright-hdl", "tilewright-sim"];

/// The most letters, as in file systems and registries.
const LONGEST: usize = 64;

/// Checks that a crate can have that name.
///
/// # Errors
/// It cannot.
pub fn check(name: &str) -> Result<(), Failure> {
    let is_letter = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-' || c == '_';
    let begins = name.starts_with(|c: char| c.is_ascii_lowercase());
    let problem = if !begins || !name.chars().all(is_letter) {
        "cannot name a crate: give lower-case letters, digits, `-` and `_`, a letter first"
    } else if name.len() > LONGEST {
        "is too long for the name of a crate: give 64 characters at most"
    } else if KEYWORDS.contains(&name) {
        "is a keyword of Rust: give another name"
    } else if TAKEN.contains(&name.replace('_', "-").as_str()) {
        "is the name of an existing crate: give another name"
    } else {
        return Ok(());
    };
    Err(Failure::new(Exit::BadInput, format!("`{name}` {problem}")))
}
