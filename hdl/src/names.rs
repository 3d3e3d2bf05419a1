//! Names that are legal in Verilog and in waves.

use std::collections::{HashMap, HashSet};
use std::sync::LazyLock;

use crate::check::{foreign, pads};
use crate::elaboration::Elaboration;
use crate::loc::Loc;
use crate::mistake::Mistake;
use crate::problem::Problem;

/// The reserved words of Verilog (1364-2005) and SystemVerilog (1800-2017), and the package `std` that SystemVerilog
/// always has.
const RESERVED: &str = include_str!("reserved_words.txt");

/// The words of C++ that Verilator refuses as the name of a port.
const RESERVED_IN_CPP: &str = include_str!("reserved_cpp.txt");

/// Whether `name` is a word of C++.
pub(crate) fn is_reserved_in_cpp(name: &str) -> bool {
    static WORDS: LazyLock<HashSet<&str>> = LazyLock::new(|| RESERVED_IN_CPP.split_whitespace().collect());
    WORDS.contains(name)
}

/// Whether `name` is a word of Verilog or SystemVerilog.
pub(crate) fn is_reserved(name: &str) -> bool {
    static WORDS: LazyLock<HashSet<&str>> = LazyLock::new(|| RESERVED.split_whitespace().collect());
    WORDS.contains(name)
}

/// Whether `name` is letters, digits and `_`, and does not start with a digit.
pub(crate) fn is_legal(name: &str) -> bool {
    let mut chars = name.chars();
    chars.next().is_some_and(|c| c.is_ascii_alphabetic() || c == '_')
        && chars.all(|c| c.is_ascii_alphanumeric() || c == '_')
}

/// The identifier without the `r#` of a raw one.
#[doc(hidden)]
pub const fn unraw(identifier: &str) -> &str {
    match identifier.as_bytes() {
        [b'r', b'#', ..] => identifier.split_at(2).1,
        _ => identifier,
    }
}

/// The last part of a type's path, without its generic arguments.
pub(crate) fn short(type_name: &'static str) -> &'static str {
    let plain = type_name.split('<').next().unwrap_or(type_name);
    plain.rsplit("::").next().unwrap_or(plain)
}

/// Reports different blocks whose modules have one name.
pub(crate) fn check_module_names(e: &mut Elaboration) {
    let mut problems = Vec::new();
    let mut taken: HashMap<&str, usize> = HashMap::with_capacity(e.done.len());
    for (i, module) in e.done.iter().enumerate() {
        if let Some(&other) = taken.get(module.name.as_str()) {
            let (first, name) = (&e.done[other], &module.name);
            let message = match first.parameters == module.parameters {
                true => format!("two different blocks print as `{}` and are both called `{name}`", module.parameters),
                false => format!("`{}` and `{}` are both called `{name}`", first.parameters, module.parameters),
            };
            let problem = Problem::new(Mistake::ModuleNamedTwice, e.instantiated[i], message)
                .note(format!("`{}` is described", module.parameters), module.loc)
                .note("the other one is instantiated", e.instantiated[other])
                .note("the other one is described", first.loc);
            problems.push(
                problem.help("distinguish them by `name(self) = ..` in `block!`, or in the block's `Debug` text"),
            );
        } else {
            problems.extend(illegal("a module", &module.name, module.loc));
        }
        taken.entry(&module.name).or_insert(i);
    }
    for (i, module) in e.done.iter().enumerate() {
        let Some(foreign) = &module.foreign else { continue };
        if let Some(&described) = taken.get(foreign.module.as_str()) {
            let message = format!(
                "`{}` is a foreign module, and the module of `{}`",
                foreign.module, e.done[described].parameters
            );
            let problem = Problem::new(Mistake::ModuleNamedTwice, foreign.loc, message)
                .note("the foreign module is instantiated", e.instantiated[i])
                .note(format!("`{}` is described", e.done[described].parameters), e.done[described].loc);
            problems.push(problem.help("give the block another name, by `name = ..` in `block!`"));
        }
    }
    // What is fed wrongly is not reported once more.
    if problems.is_empty() && e.problems.is_empty() {
        problems.extend(foreign::made_clocks(&e.done));
        problems.extend(pads::check(&e.done));
    }
    problems.into_iter().for_each(|problem| e.report(problem));
}

/// The problem of a name that Verilog does not take, if it is one.
pub(crate) fn illegal(kind: &str, name: &str, loc: Loc) -> Option<Problem> {
    let is_wrong = !is_legal(name) || is_reserved(name);
    let problem = || Problem::new(Mistake::IllegalName, loc, format!("`{name}` cannot be the name of {kind}"));
    let help = "a name consists of letters, digits and `_`, and is not a reserved word of Verilog";
    is_wrong.then(|| problem().help(help))
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
