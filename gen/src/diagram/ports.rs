//! The ports of a module as a reader sees them: streams, records and lists in place of single signals.

use std::collections::{BTreeMap, BTreeSet};
use tilewright_circuit::ir::{Module, NodeId};

/// The part that a port has in its bundle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Role {
    /// A signal without a handshake, or the payload of a stream.
    Payload,
    /// The `valid` of a stream.
    Valid,
    /// The `ready` of a stream.
    Ready,
}

/// Ports that are drawn as one.
#[derive(Debug)]
pub(super) struct Bundle {
    /// The path, with `[*]` for the numbers of a list: `processors[*].request`.
    pub name: String,
    pub is_stream: bool,
    pub comes_in: bool,
    /// The number of list elements.
    pub elements: usize,
    /// The width of one element, without the handshake.
    pub bits: u64,
    /// The names of the ports.
    pub members: Vec<String>,
}

/// The bundles of a module, and for each port its bundle and role.
pub(super) struct Ports {
    pub bundles: Vec<Bundle>,
    pub inputs: Vec<(usize, Role)>,
    pub outputs: Vec<(usize, Role)>,
}

impl Ports {
    pub fn of(module: &Module) -> Ports {
        let paths = |ports: &mut dyn Iterator<Item = &str>| ports.map(str::to_owned).collect::<BTreeSet<String>>();
        let inputs = paths(&mut module.inputs.iter().map(|port| port.path.as_str()));
        let outputs = paths(&mut module.outputs.iter().map(|port| port.path.as_str()));
        let both = |valid: &BTreeSet<String>, ready: &BTreeSet<String>| {
            let streams = valid.iter().filter_map(|path| path.strip_suffix(".valid"));
            streams.filter(|path| ready.contains(&format!("{path}.ready"))).map(str::to_owned).collect()
        };
        let mut collector = Collector {
            into: both(&inputs, &outputs),
            out: both(&outputs, &inputs),
            found: BTreeMap::new(),
            bundles: Vec::new(),
            elements: Vec::new(),
        };
        let width = |node: NodeId| u64::from(module.width(node)) * u64::from(module.shape(node).lanes());
        let inputs = module.inputs.iter().map(|port| collector.add(true, &port.path, &port.name, width(port.node)));
        let inputs = inputs.collect();
        let outputs = module.outputs.iter().map(|port| collector.add(false, &port.path, &port.name, width(port.node)));
        let outputs = outputs.collect();
        for (bundle, elements) in collector.bundles.iter_mut().zip(&collector.elements) {
            bundle.elements = elements.len();
            bundle.bits /= elements.len() as u64;
        }
        Ports { bundles: collector.bundles, inputs, outputs }
    }
}

struct Collector {
    /// The paths of the streams that come in, and of those that go out.
    into: BTreeSet<String>,
    out: BTreeSet<String>,
    found: BTreeMap<(bool, String), usize>,
    bundles: Vec<Bundle>,
    /// For each bundle, the list indices in the paths of its ports.
    elements: Vec<BTreeSet<Vec<String>>>,
}

impl Collector {
    /// Adds a port. Returns its bundle and role.
    fn add(&mut self, is_input: bool, path: &str, port: &str, bits: u64) -> (usize, Role) {
        let stream = prefixes(path).find(|it| self.into.contains(*it) || self.out.contains(*it));
        let comes_in = stream.map_or(is_input, |stream| self.into.contains(stream));
        let role = match stream.map(|stream| &path[stream.len()..]) {
            Some(".valid") => Role::Valid,
            Some(".ready") => Role::Ready,
            _ => Role::Payload,
        };
        let (name, numbers) = without_numbers(stream.unwrap_or(record(path)));
        let next = self.bundles.len();
        let bundle = *self.found.entry((comes_in, name.clone())).or_insert(next);
        if bundle == next {
            let is_stream = stream.is_some();
            self.bundles.push(Bundle { name, is_stream, comes_in, elements: 0, bits: 0, members: Vec::new() });
            self.elements.push(BTreeSet::new());
        }
        let found = &mut self.bundles[bundle];
        found.members.push(port.to_owned());
        found.bits += if role == Role::Payload { bits } else { 0 };
        self.elements[bundle].insert(numbers);
        (bundle, role)
    }
}

/// `a`, `a.b`, `a.b.c` of `a.b.c`.
fn prefixes(path: &str) -> impl Iterator<Item = &str> {
    path.match_indices('.').map(|(at, _)| &path[..at]).chain([path])
}

fn is_number(segment: &str) -> bool {
    segment.bytes().all(|byte| byte.is_ascii_digit())
}

/// The first field of a path, with the list indices that follow.
fn record(path: &str) -> &str {
    let ends = path.match_indices('.').map(|(at, _)| at).chain([path.len()]);
    let of_numbers = ends.zip(path.split('.')).take_while(|(_, segment)| is_number(segment)).count();
    let after = path.split('.').enumerate().skip(1).take_while(|(_, segment)| is_number(segment)).count();
    prefixes(path).nth(after.max(of_numbers)).unwrap_or(path)
}

/// A path with `[*]` in place of each list index, and the indices.
fn without_numbers(path: &str) -> (String, Vec<String>) {
    let (mut name, mut numbers) = (String::new(), Vec::new());
    for segment in path.split('.') {
        if is_number(segment) {
            name += "[*]";
            numbers.push(segment.to_owned());
        } else {
            name += if name.is_empty() { "" } else { "." };
            name += segment;
        }
    }
    (name, numbers)
}

#[cfg(test)]
mod tests {
    use super::{record, without_numbers};

    #[test]
    fn a_port_belongs_to_the_first_field_of_its_path() {
        assert_eq!(
            ["left", "left.z", "nodes.3.byte", "grid.1.2.byte"].map(record),
            ["left", "left", "nodes.3", "grid.1.2"]
        );
    }

    #[test]
    fn a_list_is_one_whatever_its_numbers() {
        let numbers = vec!["3".to_owned()];
        assert_eq!(without_numbers("processors.3.request"), ("processors[*].request".to_owned(), numbers));
    }
}
