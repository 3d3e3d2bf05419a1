//! Names of modules, and of types and fields in Rust.

use std::collections::HashMap;
use tilewright_circuit::{Mistake, Problem};

use crate::check::{foreign, pads};
use crate::elaboration::Elaboration;
pub(crate) use tilewright_circuit::names::{bits_text, illegal, is_legal, is_reserved, is_reserved_in_cpp, port_name};

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
