//! A critical path in the user's names and source lines.

use super::netlist::{AT_PORT, Bit, Cell, Netlist};
use super::sources::Sources;
use super::timing::Step;
use serde::Serialize;
use std::collections::BTreeMap;

/// A place on a path.
#[derive(Debug, Serialize, PartialEq)]
pub struct Point {
    /// The time from the clock's edge until the value is there, in nanoseconds, to a picosecond.
    pub ns: f64,
    /// The signal, as the user names it, or the expression that is computed.
    pub signal: String,
    /// The line of the description, where one is known.
    pub source: Option<String>,
}

/// A name and a source line.
#[derive(Clone, PartialEq)]
struct Named {
    signal: String,
    source: Option<String>,
}

/// The user's names of wires.
pub struct Names<'a> {
    netlist: &'a Netlist,
    sources: &'a Sources<'a>,
    wires: BTreeMap<u64, Named>,
    /// The signals alone, for names that Yosys has made of them.
    signals: BTreeMap<&'a str, Named>,
}

/// The longest expression that is shown whole, in characters.
const MOST: usize = 44;

impl<'a> Names<'a> {
    pub fn of(netlist: &'a Netlist, sources: &'a Sources<'a>) -> Names<'a> {
        let mut names = Names { netlist, sources, wires: BTreeMap::new(), signals: BTreeMap::new() };
        // Signals with a line of their own first, and of those the outermost: the same wire is a port of each instance it passes.
        let mut declared: Vec<(bool, usize, &str, Named)> = Vec::new();
        for name in netlist.netnames.keys() {
            if let Some(named) = names.declared(name) {
                let depth = name.matches('.').count();
                declared.push((named.1, depth, name, named.0));
            }
        }
        declared.sort_by(|a, b| (a.0, a.1, a.2).cmp(&(b.0, b.1, b.2)));
        for (_, _, name, named) in declared {
            let net = &netlist.netnames[name];
            for (index, bit) in net.bits.iter().enumerate() {
                let Bit::Wire(wire) = bit else { continue };
                let signal = match net.bits.len() {
                    1 => named.signal.clone(),
                    _ => format!("{}[{}]", named.signal, index as i64 + net.offset),
                };
                names.wires.entry(*wire).or_insert(Named { signal, source: named.source.clone() });
            }
            names.signals.insert(name, named);
        }
        names
    }

    /// The user's name and source line of a net, if it is declared in our Verilog, and whether it is only a port.
    fn declared(&self, name: &str) -> Option<(Named, bool)> {
        let net = &self.netlist.netnames[name];
        let at = self.sources.stretch(net.attributes.get("src")?.as_str()?)?;
        let own = match net.attributes.get("hdlname") {
            Some(path) => path.as_str()?.rsplit(' ').next()?,
            None => name,
        };
        if self.sources.text(at)? != own {
            return None;
        }
        let (source, is_port) = match self.sources.declared(at) {
            Some(place) => (Some(place), false),
            None => (self.sources.declaration(at.file(), own), true),
        };
        Some((Named { signal: plain(name), source }, is_port))
    }

    /// The points of a path: one for each signal, or stretch of logic that computes one expression.
    pub fn points(&self, steps: &[Step]) -> Vec<Point> {
        let mut points: Vec<Point> = Vec::new();
        let (mut ns, mut reached) = (0.0, 0.0);
        let mut add = |ns: f64, named: Named| match points.last_mut() {
            Some(last) if last.signal == named.signal && last.source == named.source => last.ns = rounded(ns, 3),
            _ => points.push(Point { ns: rounded(ns, 3), signal: named.signal, source: named.source }),
        };
        for (index, step) in steps.iter().enumerate() {
            match &step.net {
                Some(net) => {
                    if index == 1
                        && let Some(memory) = self.memory(&steps[0].to.cell)
                    {
                        add(reached, memory);
                    }
                    if let Some(named) = self.net(net) {
                        add(reached, named);
                    }
                }
                None if index + 1 == steps.len() && index > 0 => {
                    add(ns + step.delay, self.end(&step.to.cell));
                }
                None => {}
            }
            ns += step.delay;
            if step.net.is_none() {
                reached = ns;
            }
        }
        points
    }

    /// The name of a clock.
    pub fn clock(&self, net: &str) -> String {
        self.net(net).map_or_else(|| net.to_owned(), |named| named.signal)
    }

    /// The name of a net of nextpnr. Some have none: they are a part of what the next one with a name is computed by.
    fn net(&self, net: &str) -> Option<Named> {
        let (name, wire) = self.wire(net);
        let own = wire.and_then(|wire| self.wires.get(&wire)).cloned();
        let place = || self.netlist.netnames.get(name)?.attributes.get("src")?.as_str();
        own.or_else(|| self.expression(place()?))
    }

    /// The netlist's name of a net of nextpnr, and the wire.
    fn wire<'n>(&self, net: &'n str) -> (&'n str, Option<u64>) {
        let (name, index) = match self.netlist.netnames.contains_key(net) {
            true => (net, None),
            false => match net.strip_suffix(']').and_then(|it| it.rsplit_once('[')) {
                Some((name, index)) => (name, index.parse::<i64>().ok()),
                None => (net, None),
            },
        };
        let wire = self.netlist.netnames.get(name).and_then(|it| {
            let index = usize::try_from(index.map_or(0, |index| index - it.offset)).ok()?;
            if let Bit::Wire(wire) = it.bits.get(index)? { Some(*wire) } else { None }
        });
        (name, wire)
    }

    /// The expression that stands at a place of Yosys, with the line of the signal that it is computed for.
    fn expression(&self, places: &str) -> Option<Named> {
        let at = self.sources.stretch(places)?;
        let (signal, source) = self.sources.assigned(at)?;
        let text = self.sources.text(at)?;
        let signal = match text.chars().count() <= MOST && text.contains(' ') {
            true => format!("{signal}: {text}"),
            false => logic(signal),
        };
        Some(Named { signal, source: Some(source) })
    }

    /// What a path ends at: a port, a register or a memory.
    fn end(&self, cell: &str) -> Named {
        // On an iCE40 nextpnr joins a flip-flop with the look-up table before it, whose name it keeps.
        let name = ["_DFFLC", "_LC", "_RAM"].iter().find_map(|end| cell.strip_suffix(end)).unwrap_or(cell);
        let name = self.behind(name).unwrap_or(name);
        if let Some(port) = name.strip_prefix(AT_PORT) {
            return self.port(port);
        }
        let wire = self.netlist.cells.get(name).and_then(|cell| cell.output(&["Q", "O"]));
        let register = wire.and_then(|wire| self.wires.get(&wire)).cloned();
        register.or_else(|| self.memory(name)).unwrap_or_else(|| self.near(name))
    }

    /// The flip-flop that only a look-up table drives, if the cell is one.
    fn behind(&self, cell: &str) -> Option<&'a str> {
        let wire = self.netlist.cells.get(cell)?.output(&["O"])?;
        let reads = |cell: &Cell| cell.connections.get("D").is_some_and(|it| it[..] == [Bit::Wire(wire)]);
        self.netlist.cells.iter().find(|(_, cell)| reads(cell)).map(|(name, _)| name.as_str())
    }

    /// Another cell is at the signal or the word of a memory that Yosys names it after: `sum_MULT18X18D_P` is at `sum`.
    fn near(&self, name: &str) -> Named {
        let mut parts = name.match_indices('_').map(|(at, _)| &name[..at]).rev();
        let found = parts.find_map(|part| match self.signals.get(part) {
            Some(named) => Some(Named { signal: logic(&named.signal), source: named.source.clone() }),
            None => {
                let (words, _) = part.strip_suffix(']')?.rsplit_once('[')?;
                let source = self.sources.memory(words.rsplit('.').next()?)?;
                Some(Named { signal: plain(part), source: Some(source) })
            }
        });
        found.unwrap_or_else(|| Named { signal: plain(name), source: None })
    }

    /// A bit of a port, such as `left[3]`.
    fn port(&self, bit: &str) -> Named {
        let name = bit.rsplit_once('[').map_or(bit, |(name, _)| name);
        match self.signals.get(name) {
            Some(named) if self.netlist.netnames[name].bits.len() == 1 => named.clone(),
            Some(named) => Named { signal: bit.to_owned(), source: named.source.clone() },
            None => Named { signal: bit.to_owned(), source: None },
        }
    }

    /// The memory that a block RAM is a part of: Yosys names it `words.0.0`.
    fn memory(&self, cell: &str) -> Option<Named> {
        let cell = cell.split('$').next().unwrap_or(cell);
        let name = cell.trim_end_matches(|c: char| c == '.' || c.is_ascii_digit());
        let is_numbered = cell[name.len()..].starts_with('.');
        let own = name.rsplit('.').next().filter(|_| is_numbered)?;
        Some(Named { signal: plain(name), source: self.sources.memory(own) })
    }
}

/// What has no name itself, and is at a signal.
fn logic(signal: &str) -> String {
    format!("{signal}: logic")
}

/// A number to that many places: nextpnr writes what a single-precision number becomes.
pub fn rounded(number: f64, places: i32) -> f64 {
    let scale = 10_f64.powi(places);
    (number * scale).round() / scale
}

/// A path of instances without the names that only the printer has given.
fn plain(name: &str) -> String {
    name.replace(".lane.", ".")
}
