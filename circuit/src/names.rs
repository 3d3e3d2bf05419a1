//! Names that are legal in Verilog and in waves.

use std::sync::LazyLock;

use crate::loc::Loc;
use crate::mistake::Mistake;
use crate::problem::Problem;

/// The reserved words of Verilog (1364-2005) and SystemVerilog (1800-2017), and the package `std` that SystemVerilog
/// always has.
const RESERVED: &str = include_str!("reserved_words.txt");

/// The words of C++ that Verilator refuses as the name of a port.
const RESERVED_IN_CPP: &str = include_str!("reserved_cpp.txt");

/// Words by their first letters: faster than a hash of each name that a circuit has.
struct Words([Vec<&'static str>; 256]);

impl Words {
    fn new(text: &'static str) -> Words {
        let mut words = [const { Vec::new() }; 256];
        text.split_whitespace().for_each(|word| words[usize::from(word.as_bytes()[0])].push(word));
        Words(words)
    }

    fn contain(&self, name: &str) -> bool {
        name.bytes().next().is_some_and(|first| self.0[usize::from(first)].contains(&name))
    }
}

/// Whether `name` is a word of C++.
pub fn is_reserved_in_cpp(name: &str) -> bool {
    static WORDS: LazyLock<Words> = LazyLock::new(|| Words::new(RESERVED_IN_CPP));
    WORDS.contain(name)
}

/// Whether `name` is a word of Verilog or SystemVerilog.
pub fn is_reserved(name: &str) -> bool {
    static WORDS: LazyLock<Words> = LazyLock::new(|| Words::new(RESERVED));
    WORDS.contain(name)
}

/// Whether `name` is letters, digits and `_`, and does not start with a digit.
pub fn is_legal(name: &str) -> bool {
    let mut chars = name.chars();
    chars.next().is_some_and(|c| c.is_ascii_alphabetic() || c == '_')
        && chars.all(|c| c.is_ascii_alphanumeric() || c == '_')
}

/// The problem of a name that Verilog does not take, if it is one.
pub fn illegal(kind: &str, name: &str, loc: Loc) -> Option<Problem> {
    let is_wrong = !is_legal(name) || is_reserved(name);
    let problem = || Problem::new(Mistake::IllegalName, loc, format!("`{name}` cannot be the name of {kind}"));
    let help = "a name consists of letters, digits and `_`, and is not a reserved word of Verilog";
    is_wrong.then(|| problem().help(help))
}

/// The name of a port or register: the path of its fields joined by `_`.
pub fn port_name(prefix: &str, path: &str) -> String {
    match (prefix.is_empty(), path.is_empty()) {
        (true, _) if !path.contains('.') => path.to_owned(),
        (true, _) => path.replace('.', "_"),
        (false, true) => prefix.to_owned(),
        (false, false) => [prefix, "_", &port_name("", path)].concat(),
    }
}

/// `1 bit`, `8 bits`.
pub fn bits_text(width: u32) -> String {
    if width == 1 { "1 bit".to_owned() } else { format!("{width} bits") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reserved_words_of_both_standards_are_known() {
        for word in ["module", "table", "cell", "logic", "priority", "do", "std"] {
            assert!(is_reserved(word), "{word}");
        }
        assert!(!is_reserved("patch"));
    }
}
