//! Instances, with every port connected by name.

use super::foreign::instantiate;
use super::layout::{range, with_place};
use super::printer::Printer;
use tilewright_hdl::ir::{Instance, Module};

impl Printer<'_> {
    /// The nets for the outputs of plain instances.
    pub fn output_nets(&self) -> Vec<String> {
        let module = self.module;
        let outputs = module.instances.iter().filter(|instance| instance.shape.is_plain()).flat_map(|i| &i.outputs);
        let declare = |id| {
            let declaration = format!("wire {}{};", range(module.width(id)), self.name(id));
            with_place(declaration, module.node(id).loc)
        };
        outputs.copied().filter(|&id| !self.is_port(id)).map(declare).collect()
    }

    /// The instances that are not arrays.
    pub fn instances(&mut self) -> Vec<String> {
        let mut out = Vec::new();
        for instance in self.module.instances.iter().filter(|instance| instance.shape.is_plain()) {
            out.extend(self.plain_instance(instance));
            out.push(String::new());
        }
        out
    }

    fn plain_instance(&mut self, instance: &Instance) -> Vec<String> {
        let child = self.design.module(instance.module);
        let mut connections = self.clock_connections(instance, child);
        for (port, &input) in child.inputs.iter().zip(&instance.inputs) {
            connections.push((port.name.clone(), self.value(input)));
        }
        for (port, &output) in child.outputs.iter().zip(&instance.outputs) {
            connections.push((port.name.clone(), self.name(output).to_string()));
        }
        instantiate(child, &instance.name, &connections, Some(instance.loc))
    }

    /// The clocks and resets of an instance.
    pub fn clock_connections(&mut self, instance: &Instance, child: &Module) -> Vec<(String, String)> {
        let mut connections = Vec::new();
        for (clock, &driver) in child.clocks.iter().zip(&instance.clocks) {
            connections.push((clock.port.clone(), self.clock_port(driver)));
            if let Some(reset) = &clock.reset {
                connections.push((reset.clone(), self.reset_port(driver)));
            }
        }
        connections
    }
}
