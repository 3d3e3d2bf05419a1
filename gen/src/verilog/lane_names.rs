//! What the text of instance arrays calls things.

use super::scope::{LANE, Names, Scope};
use std::collections::BTreeMap;
use tilewright_hdl::ir::{Design, InstanceId, Module, NodeId, Op};

/// The names that the arrays of a module need.
pub struct ArrayNames {
    /// The loop variable of every array; empty if there is none.
    pub genvar: String,
    /// The names within each array.
    pub arrays: BTreeMap<InstanceId, LaneNames>,
}

/// The names in a lane of an array.
pub struct LaneNames {
    /// The instance.
    pub instance: String,
    /// The nets of its outputs.
    pub outputs: Vec<String>,
    /// The nets of the values that are made in the lane.
    pub local: BTreeMap<NodeId, String>,
    /// The tables of constants; declared outside of the lanes, or every lane has a copy.
    pub tables: BTreeMap<NodeId, String>,
    /// All of its names.
    pub scope: Scope,
}

impl ArrayNames {
    pub fn new(design: &Design, module: &Module, taken: &mut Names) -> ArrayNames {
        let arrays = || module.instances.iter().enumerate().filter(|(_, instance)| !instance.shape.is_plain());
        let free = ["i", "j", "k", "n"].into_iter().find(|name| !taken.contains(name)).unwrap_or("lane_index");
        let genvar = if arrays().next().is_some() { taken.fresh(free) } else { String::new() };
        let arrays = arrays().map(|(index, instance)| {
            let child = design.module(instance.module);
            let mut names = LaneNames::new(child, taken);
            for (port, &input) in child.inputs.iter().zip(&instance.inputs) {
                names.name_local(module, input, &port.name, taken);
            }
            (InstanceId(index as u32), names)
        });
        ArrayNames { genvar, arrays: arrays.collect() }
    }
}

impl LaneNames {
    fn new(child: &Module, taken: &mut Names) -> LaneNames {
        let mut scope = Scope::default();
        // What is in the instance must not hide it: linters do not want that.
        let ports = child.outputs.iter().map(|port| &port.name);
        let inside: Vec<&String> = ports.chain(child.nodes.iter().filter_map(|node| node.name.as_ref())).collect();
        let hides = |name: &String| inside.iter().any(|inner| inner.eq_ignore_ascii_case(name));
        let prefixed = (0..).map(|number| format!("{}{LANE}", "u_".repeat(number)));
        let instance = { prefixed }.find(|name| !hides(name) && !taken.contains(name)).expect("some name is free");
        let instance = taken.fresh_in(&mut scope, LANE, &instance);
        let outputs = child.outputs.iter().map(|port| taken.fresh_in(&mut scope, LANE, &port.name)).collect();
        LaneNames { instance, outputs, local: BTreeMap::new(), tables: BTreeMap::new(), scope }
    }

    /// Names what is made in the lane to feed an input.
    fn name_local(&mut self, module: &Module, input: NodeId, port: &str, taken: &mut Names) {
        let mut next = Some(input);
        while let Some(id) = next.filter(|id| !self.local.contains_key(id)) {
            let (made_here, operand) = match module.node(id).op {
                Op::Map { of, .. } => (true, Some(of)),
                Op::Stack { .. } => (true, None),
                _ => (false, None),
            };
            if made_here {
                self.local.insert(id, taken.fresh_in(&mut self.scope, LANE, port));
            }
            next = operand;
        }
    }
}
