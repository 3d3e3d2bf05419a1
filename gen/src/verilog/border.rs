//! The border of a chip: ports that the top has only with models, and those that it has in their place.

use std::collections::BTreeSet;

use super::foreign::MODELS;
use super::layout::range;
use tilewright_circuit::ir::{Design, Instance, Module, NodeId, Op};

/// What the ports of a module are with and without models.
#[derive(Default)]
pub struct Border {
    /// The ports with models only: made clocks, and the outsides and lines of pads.
    pub model_only: BTreeSet<String>,
    /// The `inout` ports without models, and their widths.
    pub inouts: Vec<(String, u32)>,
    /// The ports with models that are nets without, and their widths.
    nets: Vec<(String, u32)>,
}

impl Border {
    /// That of a module. Only the top has pads and instances that make clocks.
    pub fn of(design: &Design, module: &Module) -> Border {
        let mut border = Border::default();
        for instance in &module.instances {
            let child = design.module(instance.module);
            for (port, _) in made_clocks(child, module) {
                border.nets.push((port.clone(), 1));
                border.model_only.insert(port);
            }
            if let Some(port) = port_of_pad(child, module, instance) {
                let outside = instance.outside().into_iter().flatten();
                border.model_only.extend(outside.filter_map(|node| module.node(node).name.clone()));
                let line = instance.outputs[0];
                border.inouts.push((port, module.width(line)));
                let shown = module.outputs.iter().filter(|output| behind_wires(module, output.node) == line);
                for output in shown {
                    border.nets.push((output.name.clone(), module.width(line)));
                    border.model_only.insert(output.name.clone());
                }
            }
        }
        border
    }

    /// The declarations of ports that are nets without models.
    pub fn declarations(&self) -> Vec<String> {
        if self.nets.is_empty() {
            return Vec::new();
        }
        let nets = self.nets.iter().map(|(name, width)| format!("wire {}{name};", range(*width)));
        [format!("`ifndef {MODELS}")].into_iter().chain(nets).chain(["`endif".to_string()]).collect()
    }
}

/// The clocks of `module` that its instance of `child` makes: the name in `module`, and the port.
pub fn made_clocks<'a>(child: &'a Module, module: &Module) -> Vec<(String, &'a str)> {
    let made = child.foreign.iter().flat_map(|foreign| &foreign.makes);
    let used = made.filter_map(|(clock, port)| {
        let here = module.clocks.iter().find(|here| here.name == Some(clock.name))?;
        Some((here.port.clone(), port.as_str()))
    });
    used.collect()
}

/// The name of the `inout` port, if the instance is a pad.
pub fn port_of_pad(child: &Module, module: &Module, instance: &Instance) -> Option<String> {
    child.is_pad.then(|| module.pad_port(instance)).flatten()
}

fn behind_wires(module: &Module, id: NodeId) -> NodeId {
    match module.node(id).op {
        Op::Wire(of) => behind_wires(module, of),
        _ => id,
    }
}
