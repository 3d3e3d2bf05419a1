//! The names in the text of groups of lanes.

use super::groups::{Group, Groups};
use super::plan::{Form, Plan};
use super::scope::{LANE, Names, Scope};
use std::collections::BTreeMap;
use tilewright_circuit::ir::{Design, Module, NodeId, Op, Shape};

/// The names that the groups of a module need, and the loop variables of everything generated.
pub struct GroupNames {
    /// The loop variables, from the outermost on.
    pub genvars: [String; 2],
    /// The number of them that the text uses.
    pub used: usize,
    /// The label of the inner loop of a grid.
    pub column: String,
    /// For each group.
    pub groups: Vec<ScopeNames>,
}

/// The names in the scopes of a group.
pub struct ScopeNames {
    /// The label of the loop; for a grid, of the outer loop.
    pub label: String,
    /// The label of the block for values read before the group, if there are any.
    pub ahead: Option<String>,
    /// The names of its instances, by their index.
    pub instances: BTreeMap<usize, String>,
    /// The tables of constants; they are declared outside of the lanes, so that not every lane has a copy.
    pub tables: BTreeMap<NodeId, String>,
    /// All names within.
    pub scope: Scope,
}

/// The values that are made for a port of an instance, with the port's name, which they get.
pub fn port_values(design: &Design, module: &Module, plan: &Plan) -> BTreeMap<NodeId, String> {
    let mut values = BTreeMap::new();
    for instance in module.instances.iter().filter(|instance| !instance.shape.is_plain()) {
        for (port, &input) in design.module(instance.module).inputs.iter().zip(&instance.inputs) {
            let mut next = Some(input);
            while let Some(id) = next.filter(|id| !values.contains_key(id)) {
                let node = module.node(id);
                let is_made = matches!(plan.form(id), Form::Net | Form::Constants) && node.name.is_none();
                next = match node.op {
                    Op::Map { of, .. } if is_made => Some(of),
                    Op::Stack { .. } if is_made => None,
                    _ => break,
                };
                values.insert(id, port.name.clone());
            }
        }
    }
    values
}

impl GroupNames {
    /// Names the groups and, in `names`, the outputs of their instances and the values made for a port.
    pub fn new(
        design: &Design,
        module: &Module,
        groups: &Groups,
        ports: &BTreeMap<NodeId, String>,
        printed: &[Names],
        names: &mut [Option<String>],
        taken: &mut Names,
    ) -> GroupNames {
        let free = |taken: &mut Names| {
            let free = ["i", "j", "k", "n"].into_iter().find(|name| !taken.contains(name)).unwrap_or("lane_index");
            taken.fresh(free)
        };
        let has_grid = groups.groups.iter().any(|group| matches!(group.shape, Shape::Grid(..)));
        let has_lanes = module.nodes.iter().any(|node| !node.shape.is_plain());
        let genvars = if has_lanes { [free(taken), free(taken)] } else { Default::default() };
        let column = if has_grid { taken.fresh("col") } else { String::new() };
        let scope = |group| ScopeNames::new(design, module, group, groups, printed, names, taken);
        let mut scopes: Vec<ScopeNames> = groups.groups.iter().map(scope).collect();
        for (&id, port) in ports {
            let scope = groups.home(id).map(|home| &mut scopes[home].scope);
            names[id.0 as usize] = scope.map(|scope| taken.fresh_in(scope, LANE, port));
        }
        GroupNames { genvars, used: 0, column, groups: scopes }
    }
}

impl ScopeNames {
    fn new(
        design: &Design,
        module: &Module,
        group: &Group,
        groups: &Groups,
        printed: &[Names],
        names: &mut [Option<String>],
        taken: &mut Names,
    ) -> ScopeNames {
        let mut scope = Scope::default();
        let is_array = group.instances.len() == 1;
        let mut instances = BTreeMap::new();
        for &index in &group.instances {
            let instance = &module.instances[index];
            let child = design.module(instance.module);
            let inside = &printed[instance.module.0 as usize];
            let wanted = if is_array { LANE } else { &instance.name };
            let prefixed = (0..).map(|number| format!("{}{wanted}", "u_".repeat(number)));
            // No name inside the instance may hide it: linters reject that.
            let free = |name: &String| !inside.hides(name) && (!is_array || !taken.contains(name));
            let name = { prefixed }.find(free).expect("some name is free");
            let name = if is_array { taken.instance_in(&mut scope, LANE, &name) } else { name };
            instances.insert(index, name);
            for (port, output) in child.outputs.iter().zip(&instance.outputs) {
                let wanted = if is_array { port.name.clone() } else { format!("{}_{}", instance.name, port.name) };
                names[output.0 as usize] = Some(taken.fresh_in(&mut scope, LANE, &wanted));
            }
        }
        let label = match group.instances[..] {
            [index] => taken.array_label(&module.instances[index].name),
            _ => taken.fresh_label(&group_label(module, group, groups, names, taken)),
        };
        let ahead = (!group.ahead.is_empty()).then(|| taken.fresh_label(&format!("{label}_ahead")));
        ScopeNames { label, ahead, instances, tables: BTreeMap::new(), scope }
    }
}

/// `row` or `cells`; if there are several such groups, or one in a module within, with the name of something in it.
fn group_label(module: &Module, group: &Group, groups: &Groups, names: &[Option<String>], taken: &Names) -> String {
    let kind = |shape: Shape| match shape {
        Shape::Grid(..) => "cells",
        _ => "row",
    };
    let own = kind(group.shape);
    let alike = groups.groups.iter().filter(|other| other.instances.len() != 1 && kind(other.shape) == own).count();
    let registers = group.registers.iter().map(|&register| module.registers[register].node);
    let words = group.memories.iter().map(|&memory| module.memories[memory].name.clone());
    // Names of the description come first: they stay the same when something else is edited.
    let described = registers.chain(group.nets.iter().copied()).filter_map(|id| module.node(id).name.clone());
    let nets = group.nets.iter().filter_map(|id| names[id.0 as usize].clone());
    match described.chain(words).chain(nets).next() {
        Some(name) if alike > 1 || taken.is_label(own) => format!("{name}_{own}"),
        _ => own.to_string(),
    }
}
