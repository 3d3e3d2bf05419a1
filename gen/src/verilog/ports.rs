//! The ports of a module with their documentation: of a port, after it; of a record of ports, above its first one.

use std::collections::{BTreeMap, BTreeSet};

use super::border::Border;
use super::foreign::MODELS;
use super::layout::{prose, range};
use super::printer::Printer;
use tilewright_circuit::ir::{Design, Module};

/// A port's documentation is after it if it ends at this column, otherwise above it.
const COLUMNS: usize = 120;

struct Port<'a> {
    direction: String,
    width: u32,
    name: &'a str,
    /// Its path in the block's bundle; a clock has none.
    path: &'a str,
    /// The documentation of the ports of its direction.
    about: &'a BTreeMap<String, String>,
}

/// The module's head: `module NAME (..);`.
pub fn print(printer: &Printer) -> String {
    let border = &printer.border;
    let (of_models, shared): (Vec<Port>, Vec<Port>) =
        ports(printer).into_iter().partition(|port| border.model_only.contains(port.name));
    let about = &printer.module.about.inputs;
    let inouts: Vec<Port> = border.inouts.iter().map(|(name, width)| inout(name, *width, about)).collect();
    let mut text = Text::of([&of_models, &inouts, &shared]);
    let more = !shared.is_empty();
    if !of_models.is_empty() {
        text.line(format!("`ifdef {MODELS}"));
        text.ports(&of_models, more);
        if !inouts.is_empty() {
            text.line("`else".to_string());
            text.ports(&inouts, more);
        }
        text.line("`endif".to_string());
    }
    text.ports(&shared, false);
    format!("module {} (\n{});\n", printer.module.name, text.text)
}

/// The lines of ports.
struct Text<'a> {
    text: String,
    /// The width of the longest range.
    range: usize,
    /// The columns of the longest declaration.
    longest: usize,
    /// The documentation that has been printed.
    said: BTreeSet<(&'a str, String)>,
}

impl<'a> Text<'a> {
    fn of(all: [&[Port<'a>]; 3]) -> Text<'a> {
        let range = all.into_iter().flatten().map(|port| range(port.width).len()).max().unwrap_or(0);
        let mut text = Text { text: String::new(), range, longest: 0, said: BTreeSet::new() };
        text.longest = all.into_iter().flatten().map(|port| text.declare(port).len() + 1).max().unwrap_or(0);
        text
    }

    fn line(&mut self, line: String) {
        self.text.push_str(&line);
        self.text.push('\n');
    }

    fn declare(&self, port: &Port) -> String {
        let range_width = self.range;
        format!("    {} {:range_width$}{}", port.direction, range(port.width), port.name)
    }

    /// The ports with their documentation, and whether more follow.
    fn ports(&mut self, ports: &[Port<'a>], more: bool) {
        for (index, port) in ports.iter().enumerate() {
            let comma = if more || index + 1 < ports.len() { "," } else { "" };
            let mut line = format!("{}{comma}", self.declare(port));
            let ends = port.path.match_indices('.').map(|(at, _)| at).chain([port.path.len()]);
            for end in ends {
                let key = without_numbers(&port.path[..end]);
                let words = port.about.get(&key);
                let Some(words) = words.filter(|_| self.said.insert((port.kind(), key))) else { continue };
                let above = prose(words, COLUMNS - "    // ".len());
                match &above[..] {
                    [words] if end == port.path.len() && self.longest + words.len() + 4 <= COLUMNS => {
                        line = format!("{line:width$} // {words}", width = self.longest);
                    }
                    lines => lines.iter().for_each(|words| self.text.push_str(&format!("    // {words}\n"))),
                }
            }
            self.line(line);
        }
    }
}

impl Port<'_> {
    /// Input, output or inout: each kind has documentation of its own.
    fn kind(&self) -> &'static str {
        ["input", "inout"].into_iter().find(|kind| self.direction.starts_with(kind)).unwrap_or("output")
    }
}

fn inout<'a>(name: &'a str, width: u32, about: &'a BTreeMap<String, String>) -> Port<'a> {
    Port { direction: "inout  wire".to_string(), width, name, path: name, about }
}

fn ports<'a>(printer: &'a Printer) -> Vec<Port<'a>> {
    let module = printer.module;
    let mut ports = Vec::new();
    let about = &module.about.inputs;
    let input = |width, name, path| Port { direction: "input  wire".to_string(), width, name, path, about };
    for clock in &module.clocks {
        ports.push(input(1, &clock.port, ""));
        ports.extend(clock.reset.iter().map(|reset| input(1, reset, "")));
    }
    ports.extend(module.inputs.iter().map(|port| input(module.width(port.node), &port.name, &port.path)));
    for port in &module.outputs {
        let own = printer.is_port(port.node) && printer.names[port.node.0 as usize].as_ref() == Some(&port.name);
        let direction = match own && printer.is_variable(port.node) {
            true => format!("{}output reg ", printer.attributes(port.node)),
            false => "output wire".to_string(),
        };
        let (width, about) = (module.width(port.node), &module.about.outputs);
        ports.push(Port { direction, width, name: &port.name, path: &port.path, about });
    }
    if module.foreign.is_none() {
        bring_together(&mut ports);
    }
    ports
}

/// The ports of a module without models, with their widths.
pub fn of_chip(module: &Module, design: &Design) -> Vec<(String, u32)> {
    let border = Border::of(design, module);
    let clocks = module.clocks.iter().flat_map(|clock| [Some(&clock.port), clock.reset.as_ref()]).flatten();
    let inputs = module.inputs.iter().map(|port| (&port.name, module.width(port.node)));
    let outputs = module.outputs.iter().map(|port| (&port.name, module.width(port.node)));
    let all = clocks.map(|name| (name, 1)).chain(inputs).chain(outputs);
    let shared = all.filter(|(name, _)| !border.model_only.contains(*name)).map(|(name, width)| (name.clone(), width));
    border.inouts.iter().cloned().chain(shared).collect()
}

/// Moves the `ready` of each stream whose name the description gives behind its `valid`, as standards list them.
fn bring_together(ports: &mut Vec<Port>) {
    let is_given = |port: &Port| port.name != port.path.replace('.', "_");
    let streams = ports.iter().filter(|port| is_given(port)).filter_map(|port| port.path.strip_suffix(".ready"));
    for stream in streams.map(str::to_owned).collect::<Vec<_>>() {
        let at = |ports: &[Port], end: &str| {
            ports.iter().position(|port| port.path.strip_suffix(end).is_some_and(|path| path == stream))
        };
        let Some(ready) = at(ports, ".ready") else { continue };
        let moved = ports.remove(ready);
        let place = at(ports, ".valid").map_or(ready, |valid| valid + 1);
        ports.insert(place, moved);
    }
}

/// A path without the numbers of elements: the documentation of a list is that of each element.
fn without_numbers(path: &str) -> String {
    let names = path.split('.').filter(|name| !name.starts_with(|c: char| c.is_ascii_digit()));
    names.collect::<Vec<_>>().join(".")
}
