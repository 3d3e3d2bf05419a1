//! Small edits of a circuit, such as mistakes are: whether a block's tests find them says how much the tests see.
//!
//! A [`Mutant`] is one module with one edit. It is known by a sentence that does not depend on the block's parameters,
//! as the tests of a block build it in many sizes: the command makes the list of mutants from one size, and a test that runs
//! with [`VARIABLE`] set to such a sentence simulates every size with the same edit. Only a simulator that is built with its
//! feature `mutation` looks at the variable.

mod nodes;
mod objects;
mod same;
mod site;

use std::fmt;
use tilewright_hdl::Loc;
use tilewright_hdl::ir::{Design, Module};

/// The variable of the environment with the sentence of the mutant that is to be simulated.
pub const VARIABLE: &str = "TILEWRIGHT_MUTANT";

/// A module with one edit. It prints as the sentence that it is known by.
#[derive(Debug, Clone)]
pub struct Mutant {
    /// The type of the block.
    pub block: String,
    /// What is edited: its name, or what it is.
    pub what: String,
    /// Where the description made it.
    pub loc: Loc,
    /// What the edit does.
    pub change: String,
    /// How many such edits of such things there are before this one at that place.
    pub nth: usize,
    /// The module after the edit.
    pub module: Module,
}

impl fmt::Display for Mutant {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Mutant { block, what, loc, change, nth, .. } = self;
        write!(f, "{block}, {loc}, {what}: {change}")?;
        if *nth > 0 { write!(f, ", number {}", nth + 1) } else { Ok(()) }
    }
}

/// The type of the block that a module was made from.
pub fn block(module: &Module) -> &str {
    module.parameters.split([' ', '(', '{']).next().unwrap_or_default()
}

/// Every mutant of a module, in an order that is always the same. Some break a rule of circuits. Those are left out that are plainly
/// the same circuit: where two conditions never hold together, as they need other codes of one state, and beside constants.
pub fn mutants(module: &Module) -> Vec<Mutant> {
    let mut sites = site::Sites::of(module);
    nodes::edit(&mut sites);
    objects::edit(&mut sites);
    sites.into_mutants()
}

/// The design with the mutant of that sentence in the place of its module; `None` if no module has it, or if the edit breaks a rule.
pub fn mutated(design: &Design, sentence: &str) -> Option<Design> {
    let is_of = |module: &Module| sentence.strip_prefix(block(module)).is_some_and(|rest| rest.starts_with(", "));
    let mut modules = design.modules().to_vec();
    let mut found = false;
    for module in modules.iter_mut().filter(|module| is_of(module)) {
        if let Some(mutant) = mutants(module).into_iter().find(|mutant| mutant.to_string() == sentence) {
            *module = mutant.module;
            found = true;
        }
    }
    if found { Design::new(modules).ok() } else { None }
}

/// The design, or its mutant if [`VARIABLE`] names one.
pub fn from_environment(design: &Design) -> Design {
    let sentence = std::env::var(VARIABLE).ok();
    sentence.and_then(|sentence| mutated(design, &sentence)).unwrap_or_else(|| design.clone())
}
