//! A netlist in Yosys's JSON: the cells and nets of one flat module.

use super::device::FlipFlop;
use super::reach::Reach;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};

/// What Yosys writes; other modules are the cells of its library.
#[derive(Serialize, Deserialize)]
struct File {
    creator: String,
    modules: BTreeMap<String, Netlist>,
}

/// A module.
#[derive(Serialize, Deserialize)]
pub struct Netlist {
    attributes: BTreeMap<String, Value>,
    ports: BTreeMap<String, Port>,
    pub cells: BTreeMap<String, Cell>,
    pub netnames: BTreeMap<String, Net>,
}

#[derive(Serialize, Deserialize)]
struct Port {
    direction: String,
    bits: Vec<Bit>,
}

#[derive(Serialize, Deserialize)]
pub struct Cell {
    hide_name: u8,
    #[serde(rename = "type")]
    pub kind: String,
    #[serde(default)]
    parameters: BTreeMap<String, Value>,
    #[serde(default)]
    pub attributes: BTreeMap<String, Value>,
    #[serde(default)]
    pub port_directions: BTreeMap<String, String>,
    pub connections: BTreeMap<String, Vec<Bit>>,
}

#[derive(Serialize, Deserialize)]
pub struct Net {
    hide_name: u8,
    pub bits: Vec<Bit>,
    #[serde(default)]
    pub offset: i64,
    pub attributes: BTreeMap<String, Value>,
}

/// A wire, or a constant.
#[derive(Serialize, Deserialize, Clone, PartialEq, Eq, PartialOrd, Ord)]
#[serde(untagged)]
pub enum Bit {
    Wire(u64),
    Constant(String),
}

/// What the name of a flip-flop at a port begins with.
pub const AT_PORT: &str = "port ";

/// The net of the clock of a block without clocks.
pub const NO_CLOCK: &str = "clock of the ports";

impl Netlist {
    /// Reads the top module.
    ///
    /// # Errors
    /// It is not what Yosys writes.
    pub fn read(json: &[u8], top: &str) -> Result<Netlist, String> {
        let mut file: File = serde_json::from_slice(json).map_err(|error| error.to_string())?;
        file.modules.remove(top).ok_or_else(|| format!("there is no module {top}"))
    }

    pub fn write(self, top: &str) -> Vec<u8> {
        let modules = BTreeMap::from([(top.to_owned(), self)]);
        let file = File { creator: "tilewright".to_owned(), modules };
        serde_json::to_vec(&file).expect("names are keys")
    }

    /// The cells whose type begins so.
    pub fn count(&self, kind: &str) -> u64 {
        self.cells.values().filter(|cell| cell.kind.starts_with(kind)).count() as u64
    }

    /// Puts a flip-flop at each bit of each port and removes the ports, so that no path and no pin is outside of the netlist. The
    /// flip-flop has the clock of the one that it is nearest to. Ports of clocks stay as nets without a driver.
    pub fn enclose(&mut self, clocks: &[&str], flip_flop: &FlipFlop) {
        let mut next = 1 + self.wires().last().copied().unwrap_or(0);
        let first = clocks.iter().find_map(|port| self.ports.get(*port)?.bits.first().cloned());
        let first = first.unwrap_or_else(|| {
            next += 1;
            let bits = vec![Bit::Wire(next - 1)];
            let net = Net { hide_name: 0, bits: bits.clone(), offset: 0, attributes: BTreeMap::new() };
            self.netnames.insert(NO_CLOCK.to_owned(), net);
            bits[0].clone()
        });
        let mut added = Vec::new();
        // With one clock there is nothing to look for.
        let reach = (clocks.len() > 1).then(|| Reach::of(self, flip_flop.clock));
        for (name, port) in self.ports.iter().filter(|(name, _)| !clocks.contains(&name.as_str())) {
            let is_input = port.direction == "input";
            for (index, bit) in port.bits.iter().enumerate() {
                let Bit::Wire(wire) = bit else { continue };
                let clock = reach.as_ref().and_then(|reach| reach.clock(*wire, is_input)).unwrap_or(&first);
                let (data, output) =
                    if is_input { (Bit::Wire(next), bit.clone()) } else { (bit.clone(), Bit::Wire(next)) };
                next += 1;
                added.push((format!("{AT_PORT}{name}[{index}]"), register(flip_flop, clock.clone(), data, output)));
            }
        }
        self.cells.extend(added);
        self.ports.clear();
    }

    fn wires(&self) -> BTreeSet<u64> {
        let bits = self.cells.values().flat_map(|cell| cell.connections.values()).flatten();
        let named = self.netnames.values().flat_map(|net| &net.bits);
        let wire = |bit: &Bit| if let Bit::Wire(wire) = bit { Some(*wire) } else { None };
        bits.chain(named).filter_map(wire).collect()
    }
}

impl Cell {
    /// The wire at the first of these pins that the cell has.
    pub fn output(&self, pins: &[&str]) -> Option<u64> {
        let bits = pins.iter().find_map(|pin| self.connections.get(*pin))?;
        if let Bit::Wire(wire) = bits.first()? { Some(*wire) } else { None }
    }
}

/// A flip-flop without enable and reset.
fn register(flip_flop: &FlipFlop, clock: Bit, data: Bit, output: Bit) -> Cell {
    let pins =
        [(flip_flop.clock, clock, "input"), (flip_flop.data, data, "input"), (flip_flop.output, output, "output")];
    Cell {
        hide_name: 0,
        kind: flip_flop.cell.to_owned(),
        parameters: flip_flop.parameters.iter().map(|(name, it)| ((*name).to_owned(), Value::from(*it))).collect(),
        attributes: BTreeMap::new(),
        port_directions: pins.iter().map(|(pin, _, way)| ((*pin).to_owned(), (*way).to_owned())).collect(),
        connections: pins.into_iter().map(|(pin, bit, _)| (pin.to_owned(), vec![bit])).collect(),
    }
}
