//! The ports of a module with their documentation: of a port, after it; of a record of ports, above its first one.

use std::collections::{BTreeMap, BTreeSet};

use super::layout::{prose, range};
use super::printer::Printer;

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
    let module = printer.module;
    let ports = ports(printer);
    let range_width = ports.iter().map(|port| range(port.width).len()).max().unwrap_or(0);
    let declare = |port: &Port| format!("    {} {:range_width$}{}", port.direction, range(port.width), port.name);
    let longest = ports.iter().map(|port| declare(port).len() + 1).max().unwrap_or(0);
    let mut said = BTreeSet::new();
    let mut out = format!("module {} (\n", module.name);
    for (index, port) in ports.iter().enumerate() {
        let comma = if index + 1 < ports.len() { "," } else { "" };
        let mut line = format!("{}{comma}", declare(port));
        let ends = port.path.match_indices('.').map(|(at, _)| at).chain([port.path.len()]);
        for end in ends {
            let key = without_numbers(&port.path[..end]);
            let Some(words) = port.about.get(&key).filter(|_| said.insert((port.direction.starts_with("input"), key)))
            else {
                continue;
            };
            let above = prose(words, COLUMNS - "    // ".len());
            match &above[..] {
                [words] if end == port.path.len() && longest + words.len() + 4 <= COLUMNS => {
                    line = format!("{line:longest$} // {words}");
                }
                lines => lines.iter().for_each(|words| out.push_str(&format!("    // {words}\n"))),
            }
        }
        out.push_str(&line);
        out.push('\n');
    }
    out + ");\n"
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
    ports
}

/// A path without the numbers of elements: the documentation of a list is that of each element.
fn without_numbers(path: &str) -> String {
    let names = path.split('.').filter(|name| !name.starts_with(|c: char| c.is_ascii_digit()));
    names.collect::<Vec<_>>().join(".")
}
