//! Name tables: one for a module, one for each scope within it. A name of an inner scope hides that of the module, so
//! no name is used twice among those visible from one place.

use super::border::port_of_pad;
use std::collections::{BTreeMap, BTreeSet};
use tilewright_circuit::ir::{Design, Module, Shape};

/// The name of the instance in each lane of an array, unless it is taken.
pub const LANE: &str = "lane";

/// The names in use in a module. Verilog distinguishes them by case, but people and some tools do not.
#[derive(Default)]
pub struct Names {
    module: BTreeSet<String>,
    /// The names of its instances, which must not be hidden in it: linters reject that.
    own: BTreeSet<String>,
    /// The names of all scopes within. A new name of the module must not be one of them: it would be hidden there.
    inner: BTreeSet<String>,
    /// Of all these, the names that are not instances. An instance of the module must not have one of them: it would
    /// be hidden in it.
    declared: BTreeSet<String>,
    /// The labels of loops whose lanes are read by name, here and in all modules within.
    labels: BTreeSet<String>,
    /// For each name that was requested more than once, the number to try next.
    numbers: BTreeMap<String, u32>,
}

/// The names of one scope within a module, such as a lane of an array.
#[derive(Default)]
pub struct Scope {
    own: BTreeSet<String>,
    /// The names of the scopes within. A new name of this one must not be one of them: it would be hidden there.
    inner: BTreeSet<String>,
}

impl Names {
    /// Every name that the module declares, and its own. `printed` has the names of the earlier modules of the
    /// design, which include all that it instantiates.
    pub fn of(design: &Design, module: &Module, printed: &[Names]) -> Names {
        let clocks = module.clocks.iter().flat_map(|clock| [Some(&clock.port), clock.reset.as_ref()]).flatten();
        let ports = module.inputs.iter().map(|port| &port.name).chain(module.outputs.iter().map(|port| &port.name));
        let nodes = module.nodes.iter().filter_map(|node| node.name.as_ref());
        let memories = module.memories.iter().map(|memory| &memory.name);
        let instances = module.instances.iter().map(|instance| &instance.name);
        let all = design.modules().iter().flat_map(|parent| &parent.instances);
        let own = all.filter(|instance| design.module(instance.module).name == module.name);
        // In its lanes, an array has one of two names.
        let lane = |shape: Shape| if shape.is_plain() { None } else { Some(LANE) };
        let own = own.flat_map(|instance| [Some(instance.name.as_str()), lane(instance.shape)]).flatten();
        let within = module.instances.iter().flat_map(|instance| &printed[instance.module.0 as usize].labels);
        let pads = module.instances.iter();
        let pads = pads.filter_map(|pad| port_of_pad(design.module(pad.module), module, pad)).collect::<Vec<_>>();
        let declared: Vec<&String> = clocks.chain(ports).chain(&pads).chain(nodes).chain(memories).collect();
        let mut names = Names {
            declared: declared.iter().map(|name| name.to_lowercase()).collect(),
            own: own.chain([module.name.as_str()]).map(str::to_lowercase).collect(),
            labels: within.cloned().collect(),
            ..Names::default()
        };
        declared.into_iter().chain(instances).for_each(|name| names.take(name));
        names
    }

    /// Marks a name as used.
    pub fn take(&mut self, name: &str) {
        self.module.insert(name.to_lowercase());
    }

    /// Whether the name is in use in the module itself, or is its own.
    pub fn contains(&self, name: &str) -> bool {
        let name = name.to_lowercase();
        self.module.contains(&name) || self.own.contains(&name)
    }

    /// Whether the module would hide an instance of it with this name.
    pub fn hides(&self, name: &str) -> bool {
        self.declared.contains(&name.to_lowercase())
    }

    /// The requested name, or the first of `wanted_2`, `wanted_3` ... that is free in the module and that no scope
    /// within hides. It is in use from now on.
    pub fn fresh(&mut self, wanted: &str) -> String {
        let mut name = wanted.to_string();
        while self.contains(&name) || self.inner.contains(&name.to_lowercase()) {
            let number = self.numbers.entry(wanted.to_string()).or_insert(2);
            name = format!("{wanted}_{number}");
            *number += 1;
        }
        self.take(&name);
        self.declared.insert(name.to_lowercase());
        name
    }

    /// The requested name, or the first of `prefix_wanted`, `prefix_wanted_2` ... that is free in the scope and hides
    /// nothing of the module. It is in use in that scope from now on.
    pub fn fresh_in(&mut self, scope: &mut Scope, prefix: &str, wanted: &str) -> String {
        let name = self.instance_in(scope, prefix, wanted);
        self.declared.insert(name.to_lowercase());
        name
    }

    /// Like [`Self::fresh_in`], for an instance.
    pub fn instance_in(&mut self, scope: &mut Scope, prefix: &str, wanted: &str) -> String {
        let numbered = (2..).map(|number| format!("{prefix}_{wanted}_{number}"));
        let names = [wanted.to_string(), format!("{prefix}_{wanted}")].into_iter().chain(numbered);
        let is_seen = |name: &str| scope.own.contains(name) || scope.inner.contains(name);
        let is_free = |name: &String| !is_seen(&name.to_lowercase()) && !self.contains(name);
        let name = { names }.find(is_free).expect("some number is free");
        scope.own.insert(name.to_lowercase());
        self.inner.insert(name.to_lowercase());
        name
    }

    /// Like [`Self::fresh_in`], for the names of a block in the scope, or in the module: other blocks may have the
    /// same names.
    pub fn local_in<const N: usize>(
        &mut self,
        scope: Option<&mut Scope>,
        prefix: &str,
        wanted: [&str; N],
    ) -> [String; N] {
        let mut none = Scope::default();
        let around = scope.unwrap_or(&mut none);
        let mut block = Scope { own: around.own.clone(), inner: BTreeSet::new() };
        let names = wanted.map(|wanted| self.fresh_in(&mut block, prefix, wanted));
        around.inner.extend(names.iter().map(|name| name.to_lowercase()));
        names
    }

    /// A fresh name for a loop whose lanes are read through it. No such loop in a module within has the same name:
    /// when Verilator has inlined the lanes of that loop, it looks for them around the module.
    pub fn fresh_label(&mut self, wanted: &str) -> String {
        let mut name = self.fresh(wanted);
        while !self.labels.insert(name.to_lowercase()) {
            name = self.fresh(wanted);
        }
        name
    }

    /// Like [`Self::fresh_label`], for a loop in a scope.
    pub fn fresh_label_in(&mut self, scope: &mut Scope, prefix: &str, wanted: &str) -> String {
        let mut name = self.fresh_in(scope, prefix, wanted);
        while !self.labels.insert(name.to_lowercase()) {
            name = self.fresh_in(scope, prefix, wanted);
        }
        name
    }

    /// Like [`Self::fresh_label`], for an array, whose name belongs to the module already.
    pub fn array_label(&mut self, array: &str) -> String {
        if self.labels.insert(array.to_lowercase()) { array.to_string() } else { self.fresh_label(array) }
    }

    /// Whether a loop in a module within has this label.
    pub fn is_label(&self, name: &str) -> bool {
        self.labels.contains(&name.to_lowercase())
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

    #[test]
    fn a_scope_hides_no_name_of_a_block_in_it() {
        let (mut names, mut lane) = (Names::default(), Scope::default());
        assert_eq!(names.fresh_in(&mut lane, "lane", "i"), "i");
        assert_eq!(names.local_in(Some(&mut lane), "word", ["i", "j"]), ["word_i", "j"]);
        assert_eq!(names.local_in(Some(&mut lane), "word", ["i", "j"]), ["word_i", "j"], "blocks beside each other");
        assert_eq!(names.fresh_in(&mut lane, "lane", "word_i"), "lane_word_i", "the block has that name");
        assert_eq!(names.local_in(None, "word", ["k", "k"]), ["k", "word_k"]);
        assert_eq!(names.fresh("k"), "k_2");
    }

    #[test]
    fn no_loop_is_taken_for_one_around_it() {
        let (mut names, mut lane) = (Names::default(), Scope::default());
        names.labels.extend(["row", "cell", "sum_tree"].map(String::from));
        names.take("cell");
        names.take("pixel");
        assert_eq!(names.fresh_label("row"), "row_2");
        assert_eq!([names.array_label("cell"), names.array_label("pixel")], ["cell_2", "pixel"]);
        assert_eq!(names.fresh_label_in(&mut lane, "lane", "sum_tree"), "lane_sum_tree");
        assert!(names.is_label("ROW_2") && names.is_label("pixel") && names.is_label("lane_sum_tree"));
    }
}
