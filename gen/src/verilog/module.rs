//! A whole module, in this sequence: header, ports, state names, registers and memories, nets, instances, always
//! blocks, outputs, properties, and unread nets.

use std::collections::BTreeSet;

use super::foreign::MODELS;
use super::group::UNREAD;
use super::layout::{broken, prose, range, with_place, wrapped};
use super::plan::Form;
use super::printer::Printer;
use super::text::{attribute, mark};
use tilewright_circuit::ir::{Latency, Module, NodeId, Op, Register};

/// The text of a folded module; `described` is the module before folding.
pub fn print(printer: &mut Printer, described: &Module, latency: Option<&Latency>) -> String {
    let mut body = Body::default();
    let nets = printer.nets();
    let groups = printer.groups();
    let instances = printer.instances();
    let memories = printer.memory_declarations();
    let contents = printer.memory_contents();
    let memory_ports = printer.memory_ports();
    let registers = printer.registers();
    let outputs = printer.output_assigns();
    let properties = printer.plain_properties();
    let properties = printer.properties(&properties);
    body.section(printer.register_declarations(false));
    body.section(memories);
    body.section(contents);
    body.section(printer.output_nets());
    body.section(nets.before);
    let genvars = printer.lanes.genvars.iter().take(printer.lanes.used);
    body.section(genvars.map(|genvar| format!("genvar {genvar};")).collect());
    body.section(groups);
    body.section(instances);
    body.section(nets.after);
    body.section(memory_ports);
    body.section(registers);
    body.section(outputs);
    body.section(printer.stop_task());
    body.section(properties);
    body.section(printer.unused());
    let mut whole = Body::default();
    whole.section(printer.border.declarations());
    whole.section(printer.states.declarations(&body.lines));
    whole.lines.extend(body.lines);
    let body = printer.fill_in_unread(whole.lines);
    let header = header(described, latency);
    format!("{header}{}{body}endmodule\n`default_nettype wire\n", super::ports::print(printer))
}

/// The lines between the ports and `endmodule`; a blank line separates sections.
#[derive(Default)]
struct Body {
    lines: Vec<String>,
}

impl Body {
    fn section(&mut self, mut lines: Vec<String>) {
        while lines.last().is_some_and(String::is_empty) {
            lines.pop();
        }
        if !lines.is_empty() {
            self.lines.push(String::new());
            self.lines.extend(lines);
        }
    }
}

fn header(module: &Module, latency: Option<&Latency>) -> String {
    let mut lines = vec![module.name.clone()];
    let about = &module.about;
    if !about.summary.is_empty() {
        lines.push(String::new());
        lines.extend(prose(&about.summary, 90));
    }
    lines.push(String::new());
    let latency = match latency {
        None => about.latency.clone(),
        Some(counted) if about.latency.is_empty() || about.latency.parse() == Ok(counted.clocks) => counted.to_string(),
        Some(counted) => format!("{counted}; {}", about.latency),
    };
    let facts = [("Parameters", &module.parameters), ("Latency", &latency), ("Source", &about.source)];
    for (title, text) in facts.into_iter().filter(|(_, text)| !text.is_empty()) {
        // On one line: the text after a line break would be Verilog.
        let words: Vec<&str> = text.split_whitespace().collect();
        lines.push(format!("{title:11} {}", words.join(" ")));
    }
    lines.push(format!("{:11} {}:{}", "Described", module.loc.file(), module.loc.line()));
    if let Some(foreign) = &module.foreign {
        let title = if module.unmodelled { "Stub of" } else { "Model of" };
        lines.push(format!("{title:11} {}, in whose place it is if {MODELS} is defined", foreign.module));
    }
    lines.extend(quasi_static(module));
    let comment = |line: &String| if line.is_empty() { "//\n".to_string() } else { format!("// {line}\n") };
    format!("{}`default_nettype none\n\n", lines.iter().map(comment).collect::<String>())
}

/// The reasons why other clocks may sample quasi-static signals.
fn quasi_static(module: &Module) -> Vec<String> {
    // The input of a synchronizer need not be stable.
    let synchronizers = module.registers.iter().filter(|register| register.is_synchronizer);
    let entering: BTreeSet<NodeId> = synchronizers.map(|register| register.next).collect();
    let mut lines = Vec::new();
    for (id, node) in (0..).map(NodeId).zip(&module.nodes) {
        let Op::QuasiStatic(of, reason) = &node.op else { continue };
        let what = node.name.as_ref().or(module.node(*of).name.as_ref());
        let what = what.map(|name| format!("{name}: ")).unwrap_or_default();
        let words: Vec<&str> = reason.split_whitespace().collect();
        let line = format!("{:11} {what}{} ({}:{})", "Stable", words.join(" "), node.loc.file(), node.loc.line());
        if !entering.contains(&id) && lines.last() != Some(&line) {
            lines.push(line);
        }
    }
    lines
}

impl Printer<'_> {
    /// Whether the name of a node is assigned in an always block.
    pub fn is_variable(&self, id: NodeId) -> bool {
        match self.module.node(id).op {
            Op::Register(_) => true,
            Op::Read(memory, port) => {
                let names = &self.reads[memory.0 as usize][port as usize];
                names.as_ref().is_some_and(|names| names.raw.is_none())
            }
            _ => self.plan.form(id) == Form::Block,
        }
    }

    /// The attributes of a register, before its declaration: that of a synchronizer, so that its registers stay
    /// unchanged and close together, and those of the description.
    pub fn attributes(&self, id: NodeId) -> String {
        let Op::Register(register) = self.module.node(id).op else { return String::new() };
        let Register { is_synchronizer, attributes, .. } = &self.module.registers[register.0 as usize];
        let synchronizes = is_synchronizer.then(|| "ASYNC_REG = \"TRUE\"".to_string());
        mark(synchronizes.into_iter().chain(attributes.iter().map(attribute)).collect())
    }

    /// The declarations of the registers used only by properties, or of the others.
    pub fn register_declarations(&self, stated: bool) -> Vec<String> {
        let module = self.module;
        let inner = self.plain_registers(stated).into_iter().map(|index| module.registers[index].node);
        let inner = inner.filter(|&id| !self.is_port(id));
        let declare = |id: NodeId| {
            let mark = self.attributes(id);
            let declaration = format!("{mark}reg {}{};", range(module.width(id)), self.name(id));
            with_place(declaration, module.node(id).loc)
        };
        inner.map(declare).collect()
    }

    fn output_assigns(&mut self) -> Vec<String> {
        let module = self.module;
        let mut out = Vec::new();
        for output in &module.outputs {
            if self.names[output.node.0 as usize].as_ref() != Some(&output.name) {
                let value = self.value(output.node);
                out.push(format!("assign {} = {value};", output.name));
            }
        }
        out
    }

    /// All bits that the text does not read, in one reduction whose name linters recognise.
    fn unused(&mut self) -> Vec<String> {
        let module = self.module;
        let mut items: Vec<String> = Vec::new();
        for clock in &module.clocks {
            let ports = [Some(&clock.port), clock.reset.as_ref()].into_iter().flatten();
            items.extend(ports.filter(|port| !self.usage.clocks.contains(*port)).cloned());
        }
        for id in (0..module.nodes.len() as u32).map(NodeId) {
            if !self.is_declared(id) || self.is_port(id) {
                continue;
            }
            items.extend(self.unread_parts(id, self.name(id)));
        }
        let plain = module.memories.iter().filter(|memory| memory.shape.is_plain());
        let unread = plain.filter(|memory| !self.usage.memories.contains(&memory.name));
        items.extend(unread.map(|memory| format!("{}[0]", memory.name)));
        if items.is_empty() {
            return Vec::new();
        }
        items.insert(0, "1'b0".to_string());
        let name = self.taken.fresh("_unused_ok");
        vec![format!("wire {name} = &{{{}}};", wrapped(&items, 8).replace('\n', "\n    "))]
    }

    /// The unread parts of a net called `name`.
    pub fn unread_parts(&self, id: NodeId, name: &str) -> Vec<String> {
        let width = self.module.width(id);
        let text = |(low, count)| match count {
            _ if count == width => name.to_string(),
            1 => format!("{name}[{low}]"),
            _ => format!("{name}[{}:{low}]", low + count - 1),
        };
        self.usage.unread(id, width).into_iter().map(text).collect()
    }

    /// The properties without lanes.
    fn plain_properties(&self) -> Vec<usize> {
        let properties = self.module.properties.iter().enumerate();
        let plain = properties.filter(|(_, property)| self.module.shape(property.condition).is_plain());
        plain.map(|(index, _)| index).collect()
    }

    fn is_declared(&self, id: NodeId) -> bool {
        let node = self.module.node(id);
        if !node.shape.is_plain() {
            return false;
        }
        match node.op {
            Op::Register(register) => !self.stated[register.0 as usize],
            Op::Input(_) | Op::Output(..) => true,
            Op::Read(memory, port) => {
                let read = &self.module.memories[memory.0 as usize].reads[port as usize];
                read.node == id && (read.clock.is_some() || self.plan.is_net(id))
            }
            _ => self.plan.is_net(id),
        }
    }

    /// Indents the body, and lists the unread bits of its lanes at the end of each group.
    fn fill_in_unread(&mut self, lines: Vec<String>) -> String {
        let mut out = String::new();
        for line in lines {
            let group = line.trim_start().strip_prefix(UNREAD).and_then(|group| group.trim().parse().ok());
            let line = match group {
                None => Some(line),
                Some(group) => {
                    let indent = line.len() - line.trim_start().len();
                    self.tie_lanes(group).map(|tie| format!("{:indent$}{tie}", ""))
                }
            };
            for line in line.into_iter().flat_map(broken) {
                match &line[..] {
                    "" => out.push('\n'),
                    line if line.starts_with('`') => out.push_str(&format!("{line}\n")),
                    line => out.push_str(&format!("    {line}\n")),
                }
            }
        }
        out
    }
}
