//! The full description of a block, at the default values of its parameters.

use crate::shell::Failure;
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use tilewright_hdl::Shape;
use tilewright_hdl::catalog::Entry;
use tilewright_hdl::ir::{Clock, Kind, Latency, Module, NodeId};

/// A block.
#[derive(Serialize)]
pub struct BlockItem {
    name: &'static str,
    summary: &'static str,
    /// The machine that it is a part of, if it belongs to one.
    machine: Option<&'static str>,
    /// What it does, as in its Verilog.
    description: String,
    scenario: &'static str,
    /// Clocks from its inputs to its outputs, as a count if there is one number.
    latency: String,
    /// The paper.
    source: String,
    /// The file and line of its description.
    described: String,
    clocks: Vec<ClockItem>,
    inputs: Vec<PortItem>,
    outputs: Vec<PortItem>,
    parameters: Vec<ParameterItem>,
}

#[derive(Serialize)]
struct ClockItem {
    port: String,
    reset: Option<String>,
    /// The description of its scenario.
    picoseconds: Option<u64>,
}

#[derive(Serialize)]
struct PortItem {
    name: String,
    /// Bits per lane.
    width: u32,
    /// The number of lanes.
    lanes: u32,
    /// Its kind and its shape, such as `signed, 4 lanes`.
    form: String,
    /// The comment of the port, after those of the records that begin with it.
    meaning: String,
}

#[derive(Serialize)]
struct ParameterItem {
    name: &'static str,
    default: u64,
    min: u64,
    max: u64,
    meaning: &'static str,
}

impl BlockItem {
    /// An entry of that machine's catalogue.
    ///
    /// # Errors
    /// The block cannot be elaborated, which would be a mistake in the catalogue.
    pub fn of(machine: Option<&'static str>, entry: &'static Entry) -> Result<BlockItem, Failure> {
        let values = entry.values([])?;
        let design = entry.design(&values)?;
        let (top, counted) = (design.top(), design.latencies().pop().flatten());
        let parameters = entry.parameters.iter().map(|it| ParameterItem {
            name: it.name,
            default: it.default,
            min: it.min,
            max: it.max,
            meaning: it.meaning,
        });
        let inputs = top.inputs.iter().map(|port| (port.name.as_str(), port.path.as_str(), port.node, None));
        let outputs =
            top.outputs.iter().map(|port| (port.name.as_str(), port.path.as_str(), port.node, Some(port.kind)));
        Ok(BlockItem {
            name: entry.name,
            summary: entry.summary,
            machine,
            description: words(&top.about.summary),
            scenario: entry.scenario(&values)?.about,
            latency: latency(&top.about.latency, counted),
            source: words(&top.about.source),
            described: format!("{}:{}", top.loc.file(), top.loc.line()),
            clocks: top.clocks.iter().map(ClockItem::of).collect(),
            inputs: ports(top, inputs, &top.about.inputs),
            outputs: ports(top, outputs, &top.about.outputs),
            parameters: parameters.collect(),
        })
    }
}

/// As in the header of the Verilog.
fn latency(stated: &str, counted: Option<Latency>) -> String {
    match counted {
        None => words(stated),
        Some(counted) if stated.is_empty() || stated.parse() == Ok(counted.clocks) => counted.to_string(),
        Some(counted) => format!("{counted}; {}", words(stated)),
    }
}

/// On one line.
fn words(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

impl ClockItem {
    fn of(clock: &Clock) -> ClockItem {
        ClockItem {
            port: clock.port.clone(),
            reset: clock.reset.clone(),
            picoseconds: clock.period.map(|period| period.picoseconds()),
        }
    }
}

/// Ports of one direction, each with its comment. The comment of a record stands at its first port.
fn ports<'a>(
    module: &Module,
    ports: impl Iterator<Item = (&'a str, &'a str, NodeId, Option<Kind>)>,
    about: &BTreeMap<String, String>,
) -> Vec<PortItem> {
    let mut said = BTreeSet::new();
    let port = |(name, path, node, kind): (&str, &str, NodeId, Option<Kind>)| {
        let ends = path.match_indices('.').map(|(at, _)| at).chain([path.len()]);
        let keys = ends.map(|end| without_numbers(&path[..end]));
        let meaning: Vec<String> =
            keys.filter_map(|key| Some(words(about.get(&key).filter(|_| said.insert(key.clone()))?))).collect();
        let node = module.node(node);
        PortItem {
            name: name.to_owned(),
            width: node.width,
            lanes: node.shape.lanes(),
            form: form(kind.unwrap_or(node.kind), node.shape),
            meaning: meaning.join(" "),
        }
    };
    ports.map(port).collect()
}

/// The kind and the shape of a port; nothing for a plain number.
fn form(kind: Kind, shape: Shape) -> String {
    let kind = Some(kind).filter(|kind| *kind != Kind::Number).map(|kind| kind.to_string());
    let shape = Some(shape).filter(|shape| !shape.is_plain()).map(|shape| shape.to_string());
    kind.into_iter().chain(shape).collect::<Vec<_>>().join(", ")
}

/// A path without the numbers of elements: the comment of a list is that of each element.
fn without_numbers(path: &str) -> String {
    let names = path.split('.').filter(|name| !name.starts_with(|c: char| c.is_ascii_digit()));
    names.collect::<Vec<_>>().join(".")
}

impl fmt::Display for BlockItem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = self.name;
        writeln!(f, "{name}: {}\n\n{}\n", self.summary, self.description)?;
        for (title, text) in [
            ("Scenario", self.scenario),
            ("Latency", &self.latency),
            ("Source", &self.source),
            ("Described", &self.described),
        ] {
            if !text.is_empty() {
                writeln!(f, "{title:9}  {text}")?;
            }
        }
        for ClockItem { port, reset, picoseconds } in &self.clocks {
            let reset = reset.as_ref().map_or_else(String::new, |reset| format!(", reset by {reset}"));
            let period = picoseconds.map_or_else(String::new, |it| format!(", {} ns", it as f64 / 1000.0));
            writeln!(f, "{:9}  {port}{period}{reset}", "Clock")?;
        }
        write_ports(f, "Inputs", &self.inputs)?;
        write_ports(f, "Outputs", &self.outputs)?;
        if !self.parameters.is_empty() {
            writeln!(f, "\nParameters")?;
        }
        let settings = self.parameters.iter().map(|it| format!("--set {}={}", it.name, it.default));
        let settings: Vec<String> = settings.collect();
        let wide = settings.iter().map(String::len).max().unwrap_or(0);
        for (setting, ParameterItem { min, max, meaning, .. }) in settings.iter().zip(&self.parameters) {
            writeln!(f, "  {setting:wide$}  {min} to {max}: {meaning}")?;
        }
        writeln!(f, "\n  tilewright wave {name}\n  tilewright verilog {name} -o out/")
    }
}

fn write_ports(f: &mut fmt::Formatter<'_>, heading: &str, ports: &[PortItem]) -> fmt::Result {
    if ports.is_empty() {
        return Ok(());
    }
    writeln!(f, "\n{heading}, in bits")?;
    let wide = ports.iter().map(|port| port.name.len()).max().unwrap_or(0);
    let digits = ports.iter().map(|port| port.width.to_string().len()).max().unwrap_or(0);
    for PortItem { name, width, form, meaning, .. } in ports {
        let form = if form.is_empty() { String::new() } else { format!(" ({form})") };
        writeln!(f, "  {}", format!("{name:wide$}  {width:>digits$}{form}  {meaning}").trim_end())?;
    }
    Ok(())
}
