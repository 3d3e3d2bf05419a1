//! The rules of names: legal, not reserved, and unique.

use super::{Rules, problem};
use crate::ir::Module;
use crate::loc::Loc;
use crate::names::{is_legal, is_reserved};
use crate::problem::Problem;
use std::collections::{HashMap, HashSet};

/// Module names are unique.
pub(super) fn modules(modules: &[Module], problems: &mut Vec<Problem>) {
    let mut taken = HashSet::with_capacity(modules.len());
    for module in modules {
        let name = &module.name;
        if !is_legal(name) || is_reserved(name) {
            problems.push(problem(module.loc, format!("`{name}` cannot be the name of a module")));
        }
        if !taken.insert(name) {
            problems.push(problem(module.loc, format!("two modules are called `{name}`")));
        }
    }
}

impl Rules<'_> {
    pub(super) fn names(&mut self) {
        let module = self.module;
        let mut taken = HashMap::with_capacity(module.nodes.len());
        for clock in &module.clocks {
            [Some(&clock.port), clock.reset.as_ref()].into_iter().flatten().for_each(|port| {
                self.takes(&mut taken, port, module.loc, None);
            });
        }
        for input in &module.inputs {
            self.takes(&mut taken, &input.name, module.loc, Some(input.node.0));
        }
        for output in &module.outputs {
            self.takes(&mut taken, &output.name, module.loc, Some(output.node.0));
        }
        for (id, node) in (0..).zip(&module.nodes) {
            let Some(name) = &node.name else { continue };
            // A net may share the name of a port if it is that port's node.
            if taken.get(name.as_str()) == Some(&Some(id)) {
                continue;
            }
            self.takes(&mut taken, name, node.loc, None);
        }
        for memory in &module.memories {
            self.takes(&mut taken, &memory.name, memory.loc, None);
        }
        for instance in &module.instances {
            self.takes(&mut taken, &instance.name, instance.loc, None);
        }
    }

    /// Takes `name` for an object of this module: the node of a port, or anything else.
    fn takes<'n>(&mut self, taken: &mut HashMap<&'n str, Option<u32>>, name: &'n str, loc: Loc, port: Option<u32>) {
        let of = self.of(name);
        self.rule(is_legal(name) && !is_reserved(name), loc, || format!("{of} has a name that is not legal"));
        self.rule(taken.insert(name, port).is_none(), loc, || format!("{of} is the name of two things"));
    }
}
