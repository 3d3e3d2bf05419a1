//! Instances, with every port connected by name.

use super::border::{made_clocks, port_of_pad};
use super::foreign::{MODELS, instantiate};
use super::layout::{range, with_place};
use super::literal::Style;
use super::printer::Printer;
use std::ops::Range;
use tilewright_circuit::ir::{Instance, Module, NodeId};

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
        let connections = self.connections(instance, |printer, output| printer.name(output).to_string());
        let made = made_clocks(child, self.module).into_iter().map(|(clock, port)| (port.to_string(), clock)).collect();
        match port_of_pad(child, self.module, instance) {
            Some(port) => self.pad(child, instance, &port, &connections),
            None => instantiate(child, &instance.name, (&connections, made), Some(instance.loc)),
        }
    }

    /// An instance of a pad's model, or the `inout` port that it is.
    fn pad(
        &mut self,
        child: &Module,
        instance: &Instance,
        port: &str,
        connections: &[(String, String)],
    ) -> Vec<String> {
        let line = self.name(instance.outputs[0]).to_string();
        let released = format!("{}'bz", self.module.width(instance.outputs[0]));
        let [out_value, enable] = ["out", "enable"].map(|name| {
            let mut inputs = child.inputs.iter().zip(&instance.inputs);
            let (_, &value) = inputs.find(|(port, _)| port.name == name).expect("a pad has these inputs");
            self.operand(value, Style::Count)
        });
        let mut out = vec![format!("`ifdef {MODELS}")];
        out.extend(instantiate(child, &instance.name, (connections, Vec::new()), Some(instance.loc)));
        out.push("`else".to_string());
        out.push(format!("assign {port} = {enable} ? {out_value} : {released};"));
        out.push(format!("assign {line} = {port};"));
        out.push("`endif".to_string());
        out
    }

    /// What is at the ports of an instance: clocks and resets, inputs, and what `name` gives for its outputs.
    pub fn connections(
        &mut self,
        instance: &Instance,
        mut name: impl FnMut(&mut Self, NodeId) -> String,
    ) -> Vec<(String, String)> {
        let child = self.design.module(instance.module);
        let mut connections = self.clock_connections(instance, child);
        let first = connections.len();
        for (port, &input) in child.inputs.iter().zip(&instance.inputs) {
            connections.push((port.name.clone(), self.value(input)));
        }
        let inputs = first..connections.len();
        for (port, &output) in child.outputs.iter().zip(&instance.outputs) {
            connections.push((port.name.clone(), name(self, output)));
        }
        if self.waits[instance.module.0 as usize] {
            keep_apart(&mut connections, inputs);
        }
        connections
    }

    /// The clocks and resets of an instance.
    fn clock_connections(&mut self, instance: &Instance, child: &Module) -> Vec<(String, String)> {
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

/// Puts braces around the name of a net that is at a later port too. Without them Icarus has one net for both ports,
/// and it may then take an `always @*` that reads both for another one, which reads one of them and something else.
fn keep_apart(connections: &mut [(String, String)], inputs: Range<usize>) {
    for i in inputs {
        let (before, rest) = connections.split_at_mut(i + 1);
        let value = &mut before[i].1;
        let is_name = value.ends_with(|end: char| end.is_alphanumeric() || end == '_') && !value.contains([' ', '\'']);
        if is_name && rest.iter().any(|(_, other)| other == value) {
            *value = format!("{{{value}}}");
        }
    }
}
