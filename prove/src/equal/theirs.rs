//! The module that was written by hand: read by Yosys, and compared with the design port by port.

use super::Equivalence;
use super::complaint::Named;
use crate::Error;
use crate::model::{YOSYS, unwritable};
use crate::prepare::MOST_MEMORY;
use crate::process::run;
use crate::solver::{Halt, Patience};
use serde::Deserialize;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;
use tilewright_hdl::ir::{Module, NodeId};
use tilewright_hdl::{Design, Edge};

/// Its name among the modules that are compared.
pub const NAME: &str = "tilewright_theirs";
/// The file of its netlist.
pub const NETLIST: &str = "theirs.il";

/// The module.
pub struct Theirs {
    /// Its name.
    pub module: String,
}

#[derive(Deserialize)]
struct Json {
    modules: BTreeMap<String, Netlist>,
}

#[derive(Deserialize)]
struct Netlist {
    #[serde(default)]
    attributes: Attributes,
    ports: BTreeMap<String, Port>,
    cells: BTreeMap<String, Cell>,
    #[serde(default)]
    memories: BTreeMap<String, Memory>,
    netnames: BTreeMap<String, Net>,
}

#[derive(Deserialize)]
struct Port {
    direction: String,
    bits: Vec<Value>,
}

#[derive(Deserialize)]
struct Cell {
    #[serde(rename = "type")]
    kind: String,
    parameters: BTreeMap<String, String>,
    #[serde(default)]
    attributes: Attributes,
    connections: BTreeMap<String, Vec<Value>>,
}

#[derive(Deserialize)]
struct Memory {
    width: u64,
    size: u64,
}

#[derive(Deserialize)]
struct Net {
    #[serde(default)]
    attributes: Attributes,
}

#[derive(Deserialize, Default)]
struct Attributes {
    src: Option<String>,
}

/// A port of the design.
struct Ours<'a> {
    name: &'a str,
    direction: &'static str,
    width: u32,
}

impl Theirs {
    /// Reads the module into a netlist in the folder.
    ///
    /// # Errors
    ///
    /// Yosys is missing, the files have no such module, or it is not one that can be compared.
    pub fn read(asked: &Equivalence, design: &Design, folder: &Path, patience: &Patience) -> Result<Theirs, Halt> {
        let named = Named::of(&asked.files).map_err(Error::Refused)?;
        yosys(&named, folder, &format!("{}; tee -o modules.txt ls", named.read()), patience)?;
        let all = std::fs::read_to_string(folder.join("modules.txt")).map_err(unwritable)?;
        let module = asked.top(design, &all, &named)?.to_owned();
        let parameters: String =
            asked.parameters.iter().map(|(name, value)| format!(" -chparam {name} {value}")).collect();
        let script = format!(
            "{}; hierarchy -check -top {module}{parameters}; proc; flatten; opt_expr -keepdc; opt_clean; \
             chformal -assert -assume -live -fair -cover -remove; rename -top {NAME}; write_json theirs.json; \
             write_rtlil {NETLIST}",
            named.read()
        );
        yosys(&named, folder, &script, patience)?;
        let json = std::fs::read(folder.join("theirs.json")).map_err(unwritable)?;
        let unread =
            |error: serde_json::Error| Error::tool(YOSYS.program, format!("its netlist cannot be read: {error}"));
        let mut json: Json = serde_json::from_slice(&json).map_err(unread)?;
        let netlist = json.modules.remove(NAME).ok_or_else(|| Error::tool(YOSYS.program, "it wrote no netlist"))?;
        let check = Check { netlist: &netlist, named: &named, design, module: &module };
        check.all().map_err(Error::Refused)?;
        Ok(Theirs { module })
    }
}

/// Runs Yosys on the files. What it complains of is the user's.
fn yosys(named: &Named, folder: &Path, script: &str, patience: &Patience) -> Result<(), Halt> {
    match run(YOSYS.program, &["-q", "-p", script], folder, patience)? {
        Some((true, _)) => Ok(()),
        Some((false, output)) => match named.sentence(&output) {
            Some(sentence) => Err(Error::Refused(sentence).into()),
            None => Err(Error::tool(YOSYS.program, output).into()),
        },
        None => Err(Error::from(YOSYS).into()),
    }
}

impl Equivalence {
    /// The module to compare: the one that was asked for, the one with the design's name, or the one that no other
    /// contains. `all` lists the modules as Yosys does.
    fn top<'a>(&'a self, design: &'a Design, all: &'a str, named: &Named) -> Result<&'a str, Error> {
        let modules: Vec<&str> = all.lines().filter_map(|line| line.trim().strip_prefix("$abstract\\")).collect();
        let (own, files, list) = (design.top().name.as_str(), named.files(), modules.join(", "));
        let refused = |why: String| Err(Error::Refused(format!("{files}: {why}")));
        if modules.is_empty() {
            return refused("there is no module: give the file of one".to_owned());
        }
        if let Some(name) = &self.module {
            let is_there = modules.contains(&name.as_str());
            return if is_there {
                Ok(name)
            } else {
                refused(format!("there is no module `{name}`: choose one of {list}"))
            };
        }
        if modules.contains(&own) {
            return Ok(own);
        }
        let mut outer = modules.iter().filter(|name| !named.contain(name));
        match (outer.next(), outer.next()) {
            (Some(one), None) => Ok(one),
            _ => refused(format!("there is more than one module that no other contains: name one of {list}")),
        }
    }
}

/// The bits of a port in all its lanes.
pub fn width(module: &Module, node: NodeId) -> u32 {
    module.width(node) * module.shape(node).lanes()
}

/// The ports of a design, clocks and resets first.
fn ours(design: &Design) -> Vec<Ours<'_>> {
    let top = design.top();
    let clocks = top.clocks.iter().flat_map(|clock| [Some(&clock.port), clock.reset.as_ref()]).flatten();
    let clocks = clocks.map(|name| Ours { name, direction: "input", width: 1 });
    let inputs = top.inputs.iter().map(|it| Ours { name: &it.name, direction: "input", width: width(top, it.node) });
    let outputs = top.outputs.iter().map(|it| Ours { name: &it.name, direction: "output", width: width(top, it.node) });
    clocks.chain(inputs).chain(outputs).collect()
}

/// What is checked of the module.
struct Check<'a> {
    netlist: &'a Netlist,
    named: &'a Named,
    design: &'a Design,
    module: &'a str,
}

impl Check<'_> {
    /// # Errors
    ///
    /// A sentence.
    fn all(&self) -> Result<(), String> {
        self.ports()?;
        self.clock()?;
        let bits: u64 = self.netlist.memories.values().map(|it| it.width.saturating_mul(it.size)).sum();
        if bits > MOST_MEMORY {
            let place = self.place(&self.netlist.attributes);
            return Err(format!(
                "{place}: the memories of `{}` have {bits} bits, and a proof takes {MOST_MEMORY}: choose smaller parameters",
                self.module
            ));
        }
        Ok(())
    }

    fn ports(&self) -> Result<(), String> {
        let (ours, own) = (ours(self.design), &self.design.top().name);
        for Ours { name, direction, width } in &ours {
            let article = if *direction == "input" { "an input" } else { "an output" };
            let Some(port) = self.netlist.ports.get(*name) else {
                let place = self.place(&self.netlist.attributes);
                let module = self.module;
                return Err(format!(
                    "{place}: `{module}` has no port `{name}`, which is {article} of {} in {own}: add it, as ports are matched by name",
                    bits(*width as usize)
                ));
            };
            let place = self.place_of(name);
            if port.direction != *direction {
                let found = &port.direction;
                return Err(format!("{place}: `{name}` is {found}, and {article} in {own}: change it"));
            }
            if port.bits.len() != *width as usize {
                let [found, own_bits] = [port.bits.len(), *width as usize].map(bits);
                return Err(format!(
                    "{place}: `{name}` has {found}, and {own_bits} in {own}: change it, or give both modules parameters that go together"
                ));
            }
        }
        match self.netlist.ports.keys().find(|name| !ours.iter().any(|it| it.name == **name)) {
            Some(extra) => {
                let names: Vec<&str> = ours.iter().map(|it| it.name).collect();
                let (place, names) = (self.place_of(extra), names.join(", "));
                Err(format!("{place}: {own} has no port `{extra}`: remove or rename it; {own} has {names}"))
            }
            None => Ok(()),
        }
    }

    /// Everything is on the one clock, at its edge, and the clock is nothing else.
    fn clock(&self) -> Result<(), String> {
        let clock = self.design.top().clocks.first();
        let bit = clock.and_then(|clock| self.netlist.ports.get(&clock.port)?.bits.first());
        let name = clock.map_or("", |clock| clock.port.as_str());
        let polarity = if clock.is_some_and(|clock| clock.edge == Edge::Falling) { '0' } else { '1' };
        let is_clock = |port: &Port| port.direction == "output" && bit.is_some_and(|bit| port.bits.contains(bit));
        if let Some((output, _)) = self.netlist.ports.iter().find(|(_, port)| is_clock(port)) {
            let place = self.place_of(output);
            return Err(format!("{place}: `{output}` is the clock `{name}`: use that as a clock alone"));
        }
        for cell in self.netlist.cells.values() {
            let flag = |name: &str| cell.parameters.get(name).and_then(|value| value.chars().last());
            let place = self.place(&cell.attributes);
            if cell.kind.contains("latch") || cell.kind == "$sr" {
                return Err(format!(
                    "{place}: there is a latch: assign the value in all branches, or at an edge of the clock"
                ));
            }
            for (pin, bits) in &cell.connections {
                let is_clock = pin == "CLK" && flag("CLK_ENABLE") != Some('0');
                match (is_clock, bits.first() == bit && bit.is_some()) {
                    (true, false) if name.is_empty() => {
                        return Err(format!(
                            "{place}: there is a register, and {} has no clock",
                            self.design.top().name
                        ));
                    }
                    (true, false) => {
                        return Err(format!("{place}: this is on another clock than `{name}`: use that clock alone"));
                    }
                    (true, true) if flag("CLK_POLARITY") != Some(polarity) => {
                        return Err(format!(
                            "{place}: this is at the other edge of `{name}`: use the edge of {}",
                            self.design.top().name
                        ));
                    }
                    _ if !is_clock && bit.is_some_and(|bit| pin != "CLK" && bits.contains(bit)) => {
                        return Err(format!("{place}: `{name}` is used as a value here: use it as a clock alone"));
                    }
                    _ => {}
                }
            }
        }
        Ok(())
    }

    fn place_of(&self, port: &str) -> String {
        let none = Attributes::default();
        self.place(self.netlist.netnames.get(port).map_or(&none, |net| &net.attributes))
    }

    fn place(&self, attributes: &Attributes) -> String {
        let first = attributes.src.as_deref().and_then(|places| places.split('|').next());
        first.map_or_else(|| self.named.files(), |place| self.named.place(place))
    }
}

fn bits(count: usize) -> String {
    if count == 1 { "1 bit".to_owned() } else { format!("{count} bits") }
}
