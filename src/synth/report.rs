//! What was measured of a block, as text and as JSON.

use super::path::Point;
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt;

/// A block on a device.
#[derive(Serialize)]
pub struct Report {
    pub format: u32,
    pub block: &'static str,
    pub parameters: BTreeMap<&'static str, u64>,
    /// The top module.
    pub top: String,
    pub device: String,
    pub part: &'static str,
    /// Yosys and nextpnr, with their versions.
    pub tools: [String; 2],
    pub seed: u32,
    pub fits: bool,
    pub resources: Vec<Resource>,
    /// What there is too little of.
    pub lacking: Vec<Resource>,
    /// Nothing if it does not fit.
    pub clocks: Vec<ClockSpeed>,
    /// The files that were written.
    pub files: Vec<String>,
}

/// Something that a device has a number of.
#[derive(Serialize, Clone)]
pub struct Resource {
    pub name: String,
    pub used: u64,
    pub available: u64,
}

/// A clock and its critical path.
#[derive(Serialize)]
pub struct ClockSpeed {
    pub name: String,
    pub mhz: f64,
    /// The time of the path in cells and in wires, in nanoseconds.
    pub cells_ns: f64,
    pub wires_ns: f64,
    pub path: Vec<Point>,
}

impl Resource {
    /// The used part of what is available.
    pub fn percent(&self) -> f64 {
        100.0 * self.used as f64 / self.available.max(1) as f64
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        writeln!(f, "{} on {} ({})\n", self.top, self.device, self.part)?;
        writeln!(f, "{:14} {:>8} {:>10} {:>8}", "", "used", "available", "%")?;
        for it in &self.resources {
            writeln!(f, "{:14} {:>8} {:>10} {:>8.1}", it.name, it.used, it.available, it.percent())?;
        }
        for it in &self.lacking {
            let Resource { name, used, available } = it;
            writeln!(f, "\ndoes not fit: {} {name} too many, {used} of {available}", used - available)?;
        }
        self.clocks.iter().try_for_each(|clock| clock.fmt(f))?;
        let [yosys, nextpnr] = &self.tools;
        writeln!(
            f,
            "\nA flip-flop outside of the block is at each bit of each port, and none is counted. No port is at a pin."
        )?;
        writeln!(f, "{yosys}, {nextpnr}, seed {}", self.seed)
    }
}

impl fmt::Display for ClockSpeed {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let ClockSpeed { name, mhz, cells_ns, wires_ns, path } = self;
        writeln!(f, "\n{name}: {mhz:.1} MHz, by a path of {cells_ns:.2} ns in cells and {wires_ns:.2} ns in wires")?;
        let wide = path.iter().map(|it| it.signal.chars().count()).max().unwrap_or(0);
        for Point { ns, signal, source } in path {
            let source = source.as_deref().unwrap_or_default();
            writeln!(f, "{}", format!("{ns:>7.2}  {signal:wide$}  {source}").trim_end())?;
        }
        Ok(())
    }
}
