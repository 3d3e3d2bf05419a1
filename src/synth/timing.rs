//! The report of nextpnr, and its table of what a device has.

use serde::Deserialize;
use std::collections::BTreeMap;

/// The report.
#[derive(Deserialize)]
pub struct Timing {
    fmax: BTreeMap<String, Fmax>,
    critical_paths: Vec<Path>,
}

#[derive(Deserialize)]
struct Fmax {
    achieved: f64,
    constraint: f64,
}

#[derive(Deserialize)]
struct Path {
    from: String,
    to: String,
    path: Vec<Step>,
}

/// A step of a path: through a cell, or along a net.
#[derive(Deserialize)]
pub struct Step {
    /// In nanoseconds.
    pub delay: f64,
    pub net: Option<String>,
    pub to: Pin,
}

#[derive(Deserialize)]
pub struct Pin {
    pub cell: String,
}

/// A clock: its net, the frequency that it reaches in MHz, and the path that limits it.
pub struct Clocked<'a> {
    pub net: &'a str,
    pub mhz: f64,
    /// The frequency that it was to reach.
    pub wanted: f64,
    pub path: &'a [Step],
}

impl Timing {
    /// # Errors
    /// It is not what nextpnr writes.
    pub fn read(json: &[u8]) -> Result<Timing, String> {
        serde_json::from_slice(json).map_err(|error| error.to_string())
    }

    /// The clocks, by the names of their nets.
    pub fn clocks(&self) -> impl Iterator<Item = Clocked<'_>> {
        self.fmax.iter().map(|(net, fmax)| {
            let edge = |text: &str| text.strip_prefix("posedge ").or(text.strip_prefix("negedge ")) == Some(net);
            let path = self.critical_paths.iter().find(|path| edge(&path.from) && edge(&path.to));
            Clocked { net, mhz: fmax.achieved, wanted: fmax.constraint, path: path.map_or(&[], |path| &path.path) }
        })
    }
}

/// A row of the utilisation in nextpnr's log.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    pub name: String,
    pub used: u64,
    pub available: u64,
}

/// The rows of the utilisation in what nextpnr has printed so far; none if it is not complete.
pub fn utilisation(log: &str) -> Vec<Row> {
    let rest = log.split("Device utilisation:\n").nth(1).unwrap_or_default();
    let Some((table, _)) = rest.split_once("\n\n") else { return Vec::new() };
    table.lines().filter_map(row).collect()
}

fn row(line: &str) -> Option<Row> {
    let (name, rest) = line.strip_prefix("Info:")?.split_once(':')?;
    let (used, rest) = rest.split_once('/')?;
    let available = rest.split_whitespace().next()?;
    Some(Row { name: name.trim().to_owned(), used: used.trim().parse().ok()?, available: available.parse().ok()? })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_utilisation_is_read_when_it_is_complete() {
        let log = "Info: x\n\nInfo: Device utilisation:\nInfo: \t         ICESTORM_LC:   576/ 5280    10%\nInfo: \t  SB_IO:     0/   96     0%\n";
        assert_eq!(utilisation(log), []);
        let rows = utilisation(&format!("{log}\nInfo: Placed 0 cells\n"));
        let row = Row { name: "ICESTORM_LC".to_owned(), used: 576, available: 5280 };
        assert_eq!((&rows[0], rows.len()), (&row, 2));
    }
}
