//! Name tables: one for a module, one for each scope within it. A name of an inner scope hides that of the module, so
//! that none is given twice in what can be seen from one place.

use std::collections::{BTreeMap, BTreeSet};
use tilewright_hdl::ir::{Design, Module, Shape};

/// What the instance in each lane of an array is called where nothing else has that name.
pub const LANE: &str = "lane";

/// The names in use in a module; Verilog tells them apart by case, people and some tools do not.
#[derive(Default)]
pub struct Names {
    module: BTreeSet<String>,
    /// The names of all scopes within, of which a new name of the module must be none: it would be hidden there.
    inner: BTreeSet<String>,
    /// For each name that was wanted more than once, the number to try next.
    numbers: BTreeMap<String, u32>,
}

/// The names of one scope within a module, such as a lane of an array.
#[derive(Default, Clone)]
pub struct Scope(BTreeSet<String>);

impl Names {
    /// Every name that the module declares, its own, and those of its instances, which linters do not want to see hidden
    /// in it.
    pub fn of(design: &Design, module: &Module) -> Names {
        let clocks = module.clocks.iter().flat_map(|clock| [Some(&clock.port), clock.reset.as_ref()]).flatten();
        let ports = module.inputs.iter().map(|port| &port.name).chain(module.outputs.iter().map(|port| &port.name));
        let nodes = module.nodes.iter().filter_map(|node| node.name.as_ref());
        let memories = module.memories.iter().map(|memory| &memory.name);
        let instances = module.instances.iter().map(|instance| &instance.name);
        let all = design.modules().iter().flat_map(|parent| &parent.instances);
        let own = all.filter(|instance| design.module(instance.module).name == module.name);
        // An array is called either in its lanes.
        let lane = |shape: Shape| if shape.is_plain() { None } else { Some(LANE) };
        let own = own.flat_map(|instance| [Some(instance.name.as_str()), lane(instance.shape)]).flatten();
        let mut names = Names::default();
        clocks.chain(ports).chain(nodes).chain(memories).chain(instances).for_each(|name| names.take(name));
        own.for_each(|name| names.take(name));
        names.take(&module.name);
        names
    }

    /// Puts a name to use.
    pub fn take(&mut self, name: &str) {
        self.module.insert(name.to_lowercase());
    }

    /// Whether the name is in use in the module itself.
    pub fn contains(&self, name: &str) -> bool {
        self.module.contains(&name.to_lowercase())
    }

    /// The wanted name, or the first of `wanted_2`, `wanted_3` ... that is free in the module and that no scope within
    /// hides; it is in use from now on.
    pub fn fresh(&mut self, wanted: &str) -> String {
        let mut name = wanted.to_string();
        while self.contains(&name) || self.inner.contains(&name.to_lowercase()) {
            let number = self.numbers.entry(wanted.to_string()).or_insert(2);
            name = format!("{wanted}_{number}");
            *number += 1;
        }
        self.take(&name);
        name
    }

    /// The wanted name, or the first of `prefix_wanted`, `prefix_wanted_2` ... that is free in the scope and hides
    /// nothing of the module; it is in use in that scope from now on.
    pub fn fresh_in(&mut self, scope: &mut Scope, prefix: &str, wanted: &str) -> String {
        let numbered = (2..).map(|number| format!("{prefix}_{wanted}_{number}"));
        let names = [wanted.to_string(), format!("{prefix}_{wanted}")].into_iter().chain(numbered);
        let is_free = |name: &String| !scope.0.contains(&name.to_lowercase()) && !self.contains(name);
        let name = { names }.find(is_free).expect("some number is free");
        scope.0.insert(name.to_lowercase());
        self.inner.insert(name.to_lowercase());
        name
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_name_hides_another() {
        let (mut names, mut lane, mut other) = (Names::default(), Scope::default(), Scope::default());
        names.take("X_0");
        assert_eq!(names.fresh("x_0"), "x_0_2");
        assert_eq!(names.fresh_in(&mut lane, "lane", "x_0"), "lane_x_0");
        assert_eq!(names.fresh_in(&mut lane, "lane", "x_0"), "lane_x_0_2");
        assert_eq!(names.fresh_in(&mut lane, "lane", "y"), "y");
        assert_eq!(names.fresh_in(&mut other, "lane", "y"), "y", "scopes beside each other do not see each other");
        assert_eq!(names.fresh("y"), "y_2", "the module's name would be hidden in both");
    }
}
