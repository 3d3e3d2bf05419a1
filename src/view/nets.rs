//! The values of a unit's nets at each clock, from a waveform.

use serde::Serialize;
use std::collections::BTreeMap;
use tilewright_hdl::ir::Module;
use tilewright_hdl::{Design, Loc};
use vcd::{Command, Header, IdCode, Parser, Scope, ScopeItem, ScopeType, Value, VarType};

/// A net, and its values.
#[derive(Debug, PartialEq, Serialize)]
pub struct Net {
    /// Its name in the unit.
    pub name: String,
    pub width: u32,
    /// File and line of its description, if it is known.
    pub source: Option<String>,
    /// Whether it is a port of the unit.
    pub port: bool,
    /// Whether the reader asked about it.
    pub asked: bool,
    /// The number of the time from which on it has a value, and that value.
    pub changes: Vec<(usize, String)>,
}

impl Net {
    /// A net of a module without values.
    pub fn described(module: &Module, name: &str) -> Net {
        let (source, port) = Described::of(module).find(name);
        Net { name: name.to_owned(), width: 0, source, port, asked: false, changes: Vec::new() }
    }
}

/// The source lines of all named nets, by module and name.
pub fn sources(design: &Design) -> BTreeMap<(String, String), String> {
    let of_module = |module: &Module| {
        let named = module.nodes.iter().filter_map(|node| Some((node.name.clone()?, node.loc)));
        named.map(|(name, loc)| ((module.name.clone(), name), line(loc))).collect::<Vec<_>>()
    };
    design.modules().iter().flat_map(of_module).collect()
}

fn line(loc: Loc) -> String {
    format!("{}:{}", loc.file(), loc.line())
}

/// The names of a module's nets, each with its source line and whether it is a port.
struct Described(BTreeMap<String, (String, bool)>);

impl Described {
    fn of(module: &Module) -> Described {
        let named = module.nodes.iter().filter_map(|node| Some((node.name.clone()?, (line(node.loc), false))));
        let memories = module.memories.iter().map(|it| (it.name.clone(), (line(it.loc), false)));
        let mut nets: BTreeMap<_, _> = named.chain(memories).collect();
        let outputs = module.outputs.iter().map(|port| (&port.name, module.node(port.node).loc));
        let inputs = module.inputs.iter().map(|port| (&port.name, module.node(port.node).loc));
        for (name, loc) in inputs.chain(outputs) {
            nets.entry(name.clone()).or_insert_with(|| (line(loc), true)).1 = true;
        }
        Described(nets)
    }

    /// The source line of a net, and whether it is a port. Lanes of a net and words of a memory have its line.
    fn find(&self, name: &str) -> (Option<String>, bool) {
        let name = name.split('[').next().unwrap_or(name);
        self.0.get(name).map_or((None, false), |(line, is_port)| (Some(line.clone()), *is_port))
    }
}

/// The scope of a path of instances below the top of a waveform.
///
/// # Panics
/// The waveform has no top.
pub fn scope<'a>(header: &'a Header, path: &[String]) -> Option<&'a Scope> {
    let top = scopes(&header.items).next().expect("a waveform has a top module");
    path.iter().try_fold(top, |scope, name| {
        let found = scopes(&scope.items).find(|it| it.identifier == *name)?;
        // Lanes of an array have a scope of their own, as a loop of the Verilog does.
        let lane =
            scopes(&found.items).find(|it| it.identifier == "lane").filter(|_| found.scope_type == ScopeType::Begin);
        Some(lane.unwrap_or(found))
    })
}

/// The scopes among some items.
pub fn scopes(items: &[ScopeItem]) -> impl Iterator<Item = &Scope> {
    items.iter().filter_map(|item| if let ScopeItem::Scope(scope) = item { Some(scope) } else { None })
}

/// The times at which a clock of the unit rises, the beginning first, and all its other nets with their values from then on. The unit is
/// a path of instances below the top, and an instance of that module.
///
/// # Panics
/// The waveform is not one that the simulation writes, or has no such unit.
pub fn values(vcd: &[u8], path: &[String], module: &Module) -> (Vec<u64>, Vec<Net>) {
    let clocks: Vec<&str> = module.clocks.iter().map(|clock| clock.port.as_str()).collect();
    read(vcd, path, &clocks, &Described::of(module))
}

fn read(vcd: &[u8], path: &[String], clocks: &[&str], described: &Described) -> (Vec<u64>, Vec<Net>) {
    let mut parser = Parser::new(vcd);
    let header = parser.parse_header().expect("the simulation writes sound headers");
    let unit = scope(&header, path).expect("the waveform has the unit");
    let (mut nets, mut places, mut edges) = (Vec::new(), BTreeMap::<_, Vec<String>>::new(), Vec::new());
    for item in &unit.items {
        let ScopeItem::Var(variable) = item else { continue };
        if clocks.contains(&variable.reference.as_str()) {
            edges.push(variable.code);
            continue;
        }
        let is_text = variable.var_type == VarType::String;
        // A code is also there as a text, which says more.
        let name = variable.reference.strip_suffix("_state").filter(|_| is_text).unwrap_or(&variable.reference);
        let name = name.to_owned();
        let (source, port) = described.find(&name);
        if is_text {
            nets.retain(|net: &Net| net.name != name);
            places.values_mut().for_each(|names| names.retain(|of| *of != name));
        }
        places.entry(variable.code).or_default().push(name.clone());
        nets.push(Net { name, width: variable.size, source, port, asked: false, changes: Vec::new() });
    }
    let times = fill(&mut nets, &places, &edges, parser);
    (times, nets)
}

/// Reads all changes. Nets may share a code.
fn fill(nets: &mut [Net], places: &BTreeMap<IdCode, Vec<String>>, edges: &[IdCode], parser: Parser<&[u8]>) -> Vec<u64> {
    let index: BTreeMap<String, usize> = nets.iter().enumerate().map(|(at, net)| (net.name.clone(), at)).collect();
    let numbers: BTreeMap<IdCode, Vec<usize>> =
        places.iter().map(|(code, names)| (*code, names.iter().map(|name| index[name]).collect())).collect();
    let (mut times, mut now, mut news) = (Vec::new(), 0, BTreeMap::<usize, String>::new());
    // What changes at a time counts from there on, whether the clock's edge stands before or behind it.
    let settle = |nets: &mut [Net], times: &[u64], news: &mut BTreeMap<usize, String>| {
        let step = times.len().saturating_sub(1);
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
            for net in numbers.get(code).into_iter().flatten() {
                news.insert(*net, value.clone());
            }
        };
        match command.expect("the simulation writes sound waveforms") {
            Command::Timestamp(time) => {
                settle(nets, &times, &mut news);
                now = time;
                if times.is_empty() {
                    times.push(now);
                }
            }
            Command::ChangeScalar(code, value) => {
                if edges.contains(&code) && value == Value::V1 && times.last() != Some(&now) {
                    times.push(now);
                }
                change(&code, value.to_string());
            }
            Command::ChangeVector(code, value) => change(&code, hexadecimal(value.iter())),
            Command::ChangeString(code, text) => change(&code, text),
            _ => {}
        }
    }
    settle(nets, &times, &mut news);
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
        let described = Described(BTreeMap::from([("sum".to_owned(), ("a.rs:7".to_owned(), true))]));
        let (times, nets) = read(VCD, &[], &["clk"], &described);
        assert_eq!(times, [0, 10, 20]);
        let change = |at, value: &str| (at, value.to_owned());
        let net = |name: &str, width, source: Option<&str>, changes| Net {
            name: name.to_owned(),
            width,
            source: source.map(str::to_owned),
            port: source.is_some(),
            asked: false,
            changes,
        };
        let sum = net("sum", 9, Some("a.rs:7"), vec![change(0, "0"), change(1, "5"), change(2, "1ff")]);
        assert_eq!(nets, [sum, net("part", 1, None, vec![change(0, "Idle"), change(2, "Busy")])]);
    }
}
