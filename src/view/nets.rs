//! The values of nets at each clock, from a waveform, and their source lines.

use serde::Serialize;
use std::collections::BTreeMap;
use tilewright_hdl::Design;
use tilewright_hdl::ir::Module;
use vcd::{Command, IdCode, Parser, ScopeItem, Value, VarType};

/// A net, and its values.
#[derive(Debug, PartialEq, Serialize)]
pub struct Net {
    /// Its path below the top.
    pub name: String,
    pub width: u32,
    /// File and line of its description, if it is known.
    pub source: Option<String>,
    /// The number of the time from which on it has a value, and that value.
    pub changes: Vec<(usize, String)>,
}

/// The source lines of all named nets, by module and name.
pub fn sources(design: &Design) -> BTreeMap<(String, String), String> {
    let of_module = |module: &Module| {
        let named = module.nodes.iter().filter_map(|node| Some((node.name.clone()?, node.loc)));
        let line = |loc: tilewright_hdl::Loc| format!("{}:{}", loc.file(), loc.line());
        named.map(|(name, loc)| ((module.name.clone(), name), line(loc))).collect::<Vec<_>>()
    };
    design.modules().iter().flat_map(of_module).collect()
}

/// The times at which one of the clocks rises, the beginning first, and all other nets of the top with their values from then on.
///
/// # Panics
/// The waveform is not one that the simulation writes.
pub fn values(vcd: &[u8], clocks: &[String], sources: &BTreeMap<(String, String), String>) -> (Vec<u64>, Vec<Net>) {
    let mut parser = Parser::new(vcd);
    let header = parser.parse_header().expect("the simulation writes sound headers");
    let top = header.items.iter().find_map(|item| if let ScopeItem::Scope(top) = item { Some(top) } else { None });
    let top = top.expect("a waveform has a top module");
    let (mut nets, mut places, mut edges) = (Vec::new(), BTreeMap::new(), Vec::new());
    for item in &top.items {
        let ScopeItem::Var(variable) = item else { continue };
        if clocks.contains(&variable.reference) {
            edges.push(variable.code);
            continue;
        }
        let is_text = variable.var_type == VarType::String;
        // A code is also there as a text, which says more.
        let name = variable.reference.strip_suffix("_state").filter(|_| is_text).unwrap_or(&variable.reference);
        // Lanes of a net have its line.
        let described = name.split('[').next().unwrap_or(name);
        let source = sources.get(&(top.identifier.clone(), described.to_owned())).cloned();
        let name = name.to_owned();
        if is_text {
            nets.retain(|net: &Net| net.name != name);
            places.retain(|_, of: &mut String| *of != name);
        }
        places.insert(variable.code, name.clone());
        nets.push(Net { name, width: variable.size, source, changes: Vec::new() });
    }
    let times = fill(&mut nets, &places, &edges, parser);
    (times, nets)
}

/// Reads all changes.
fn fill(nets: &mut [Net], places: &BTreeMap<IdCode, String>, edges: &[IdCode], parser: Parser<&[u8]>) -> Vec<u64> {
    let index: BTreeMap<String, usize> = nets.iter().enumerate().map(|(at, net)| (net.name.clone(), at)).collect();
    let (mut times, mut now, mut news) = (vec![0], 0, BTreeMap::<usize, String>::new());
    // What changes at a time counts from there on, whether the clock's edge stands before or behind it.
    let settle = |nets: &mut [Net], step: usize, news: &mut BTreeMap<usize, String>| {
        for (net, value) in std::mem::take(news) {
            let changes = &mut nets[net].changes;
            match changes.last_mut() {
                Some((at, last)) if *at == step => *last = value,
                Some((_, last)) if *last == value => {}
                _ => changes.push((step, value)),
            }
        }
    };
    for command in parser {
        let mut change = |code: &IdCode, value: String| {
            if let Some(net) = places.get(code).and_then(|name| index.get(name)) {
                news.insert(*net, value);
            }
        };
        match command.expect("the simulation writes sound waveforms") {
            Command::Timestamp(time) => {
                settle(nets, times.len() - 1, &mut news);
                now = time;
            }
            Command::ChangeScalar(code, value) => {
                if edges.contains(&code) && value == Value::V1 && now > 0 && times.last() != Some(&now) {
                    times.push(now);
                }
                change(&code, value.to_string());
            }
            Command::ChangeVector(code, value) => change(&code, hexadecimal(value.iter())),
            Command::ChangeString(code, text) => change(&code, text),
            _ => {}
        }
    }
    settle(nets, times.len() - 1, &mut news);
    times
}

/// A number without leading zeros.
fn hexadecimal(bits: impl Iterator<Item = Value>) -> String {
    let bits: Vec<bool> = bits.map(|bit| bit == Value::V1).collect();
    let digits = bits.rchunks(4).rev().map(|part| part.iter().fold(0, |digit, bit| 2 * digit + u32::from(*bit)));
    let text: String = digits.filter_map(|digit| char::from_digit(digit, 16)).collect();
    let short = text.trim_start_matches('0');
    if short.is_empty() { "0".to_owned() } else { short.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    const VCD: &[u8] =
        b"$timescale 1 ps $end $scope module top $end $var wire 1 ! clk $end $var wire 9 \" sum [8:0] $end \
$var reg 2 # part [1:0] $end $var string 1 $ part_state $end $upscope $end $enddefinitions $end
#0
$dumpvars
0!
b0 \"
b1 #
sIdle $
$end
#10
b101 \"
1!
#15
0!
#20
1!
b111111111 \"
sBusy $
b10 #
";

    #[test]
    fn a_value_counts_from_its_edge_on() {
        let sources = BTreeMap::from([(("top".to_owned(), "sum".to_owned()), "a.rs:7".to_owned())]);
        let (times, nets) = values(VCD, &["clk".to_owned()], &sources);
        assert_eq!(times, [0, 10, 20]);
        let change = |at, value: &str| (at, value.to_owned());
        let net = |name: &str, width, source: Option<&str>, changes| Net {
            name: name.to_owned(),
            width,
            source: source.map(str::to_owned),
            changes,
        };
        let sum = net("sum", 9, Some("a.rs:7"), vec![change(0, "0"), change(1, "5"), change(2, "1ff")]);
        assert_eq!(nets, [sum, net("part", 1, None, vec![change(0, "Idle"), change(2, "Busy")])]);
    }
}
