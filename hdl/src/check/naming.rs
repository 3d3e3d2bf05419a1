//! Names are legal, unique in their module, and not reserved.

use crate::check::{numbering, unused};
use crate::draft::Draft;
use crate::names::{is_legal, is_reserved, is_reserved_in_cpp, port_name};
use std::collections::btree_map::{BTreeMap, Entry};
use std::collections::{HashMap, HashSet};
use tilewright_circuit::ir::{Instance, Module, Node, NodeId, Op};
use tilewright_circuit::{Loc, Mistake, Problem};

/// Returns the module's name. It gets a `_` if an object in the module has the same name, because Verilator rejects
/// such a top module.
pub(crate) fn check(
    draft: &mut Draft,
    done: &[Module],
    outputs: &[(String, NodeId)],
    resets: &[Option<String>],
    mut name: String,
    problems: &mut Vec<Problem>,
) -> String {
    let mut names = Names { taken: BTreeMap::new(), problems };
    for (i, clock) in draft.clocks.iter().enumerate().filter(|(i, _)| draft.clock_used[*i]) {
        let port = draft.clock_port(*clock);
        names.port("clock", &port, draft.loc);
        resets[i].iter().for_each(|reset| names.port("reset", reset, draft.loc));
    }
    for input in &draft.inputs {
        names.port("input", &input.name, draft.node(input.node).loc);
    }
    for (path, node) in outputs {
        names.port("output", &draft.port(path), draft.node(*node).loc);
    }
    let pads: HashSet<String> = super::pads::ports(&draft.inputs).collect();
    let mut driven: Vec<(NodeId, String)> = outputs.iter().map(|(path, node)| (*node, draft.port(path))).collect();
    driven.sort_unstable();
    numbering::number(draft, &driven, |name| names.taken.contains_key(name) || pads.contains(name));
    name_reads(draft);
    for (id, node) in (0..).map(NodeId).zip(&mut draft.nodes) {
        let Some(name) = node.name.as_mut().filter(|_| !matches!(node.op, Op::Input(_))) else { continue };
        // A net with the name of the output that it drives is that output.
        if !numbering::drives(&driven, id, name) {
            names.inner("net", name, node.loc);
        }
    }
    for memory in draft.memories.iter_mut().map(|draft| &mut draft.memory) {
        names.inner("memory", &mut memory.name, memory.loc);
    }
    for instance in &mut draft.instances {
        names.inner("instance", &mut instance.name, instance.loc);
    }
    name_fields(draft, &mut names.taken);
    let pads = pad_ports(draft, done);
    while names.taken.contains_key(&name) || pads.contains(&name) {
        name.push('_');
    }
    check_hiding(&draft.instances, done, problems);
    name
}

/// The ports that pads would be of a chip.
fn pad_ports(draft: &Draft, done: &[Module]) -> Vec<String> {
    let pads = draft.instances.iter().filter(|instance| done[instance.module.0 as usize].is_pad);
    let port = |pad: &Instance| {
        let [value, _] = pad.outside()?;
        let input = draft.inputs.iter().find(|input| input.node == value)?;
        Some(port_name("", input.path.strip_suffix(".value")?))
    };
    pads.filter_map(port).collect()
}

/// A module's own nets and memories hide an instance of the same name around it. Linters reject that, but they accept
/// an instance within one of the same name. Each lane of an array is an instance called `lane`.
fn check_hiding(instances: &[Instance], done: &[Module], problems: &mut Vec<Problem>) {
    let mut inside = HashMap::new();
    for instance in instances {
        let names = inside.entry(instance.module).or_insert_with(|| inner_names(&done[instance.module.0 as usize]));
        let name = if instance.shape.is_plain() { &instance.name } else { "lane" };
        problems.extend(names.get(name).map(|inside| hides(instance, name, *inside)));
    }
}

/// The nets and memories of a module, with the first place of each name.
fn inner_names(module: &Module) -> HashMap<&str, Loc> {
    let nets = module.nodes.iter().filter_map(|node| Some((node.name.as_deref()?, node.loc)));
    let memories = module.memories.iter().map(|memory| (memory.name.as_str(), memory.loc));
    let mut names = HashMap::new();
    nets.chain(memories).for_each(|(name, loc)| {
        names.entry(name).or_insert(loc);
    });
    names
}

fn hides(instance: &Instance, name: &str, inside: Loc) -> Problem {
    let (message, help) = match instance.shape.is_plain() {
        true => {
            let message = format!("instance `{name}` has the name of something inside of it");
            (message, format!("call the instance `u_{name}`"))
        }
        false => {
            let message =
                format!("the lanes of `{}` contain something called `lane`, the name of each lane", instance.name);
            (message, "call it something else".to_owned())
        }
    };
    Problem::new(Mistake::HidingName, instance.loc, message)
        .note(format!("the inner `{name}` is declared"), inside)
        .help(help)
}

/// The data register of a synchronous read is `MEMORY_read`, with the port's number if there are several.
fn name_reads(draft: &mut Draft) {
    for m in 0..draft.memories.len() {
        let memory = &draft.memories[m].memory;
        let ports: Vec<_> = memory.reads.iter().filter(|read| read.clock.is_some()).map(|read| read.node).collect();
        let name = memory.name.clone();
        for (i, port) in ports.iter().enumerate() {
            let number = if ports.len() > 1 { i.to_string() } else { String::new() };
            draft.node_mut(*port).name.get_or_insert(format!("{name}_read{number}"));
        }
    }
}

/// A field of a payload that an instance sends is `INSTANCE_STREAM_FIELD`, where more than a port reads it. For a word
/// that is packed again no field is named.
fn name_fields(draft: &mut Draft, taken: &mut BTreeMap<String, (&'static str, Loc)>) {
    let fields = std::mem::take(&mut draft.unpacked);
    if fields.is_empty() {
        return;
    }
    let is_read = unused::read_within(draft, |op| !matches!(op, Op::Concat(_) | Op::Broadcast { .. }));
    for (word, field, path) in fields {
        let (Op::Output(instance, port), Node { name: None, op: Op::Slice { .. }, .. }) =
            (&draft.node(word).op, draft.node(field))
        else {
            continue;
        };
        let sender = &draft.instances[instance.0 as usize].name;
        let stream = draft.instance_outputs[instance.0 as usize][*port as usize].trim_end_matches("payload");
        let name = format!("{sender}_{stream}{}", path.replace('.', "_"));
        let is_free = is_legal(&name) && !taken.contains_key(&name) && !is_handshake(&path);
        if is_free && is_read[field.0 as usize] {
            let node = draft.node_mut(field);
            taken.insert(name.clone(), ("net", node.loc));
            node.name = Some(name);
        }
    }
}

/// Whether a field would have the name of another signal of its stream.
fn is_handshake(path: &str) -> bool {
    matches!(path, "valid" | "ready" | "payload")
}

struct Names<'a> {
    taken: BTreeMap<String, (&'static str, Loc)>,
    problems: &'a mut Vec<Problem>,
}

impl Names<'_> {
    /// A port is visible from outside, so a reserved word is a problem and is not renamed.
    fn port(&mut self, kind: &'static str, name: &str, loc: Loc) {
        let language = match name {
            _ if is_reserved(name) => Some("Verilog"),
            _ if is_reserved_in_cpp(name) => Some("C++"),
            _ => None,
        };
        if let Some(language) = language {
            let problem = Problem::new(
                Mistake::ReservedName,
                loc,
                format!("{kind} `{name}` has a reserved word of {language} for a name"),
            );
            self.problems.push(problem.help(format!("call it `{name}_` or something else")));
        }
        self.take(kind, name, loc);
    }

    /// An inner name that is a reserved word gets a `_`.
    fn inner(&mut self, kind: &'static str, name: &mut String, loc: Loc) {
        if is_reserved(name) {
            name.push('_');
        }
        self.take(kind, name, loc);
    }

    fn take(&mut self, kind: &'static str, name: &str, loc: Loc) {
        if !is_legal(name) {
            let problem = Problem::new(Mistake::IllegalName, loc, format!("`{name}` cannot be the name of a {kind}"));
            self.problems
                .push(problem.help("a name consists of letters, digits and `_`, and does not start with a digit"));
        }
        let (other, first) = match self.taken.entry(name.to_owned()) {
            Entry::Occupied(taken) => *taken.get(),
            Entry::Vacant(free) => {
                free.insert((kind, loc));
                return;
            }
        };
        let (another, the) = match (kind == other, other.starts_with(['a', 'e', 'i', 'o', 'u'])) {
            (true, _) => ("another", "the other"),
            (false, true) => ("an", "the"),
            (false, false) => ("a", "the"),
        };
        let problem =
            Problem::new(Mistake::TakenName, loc, format!("{kind} `{name}` has the name of {another} {other}"));
        let note = format!("{the} {other} `{name}` is declared");
        let is_port = |kind: &str| matches!(kind, "input" | "output" | "clock" | "reset");
        let help = match is_port(kind) && is_port(other) {
            true => "rename one of them",
            false => "rename one of them, or put a prefix before it: `m.within(\"first\", || ..)`",
        };
        let problem = problem.note(note, first).help(help);
        // A helper that is called twice makes the same mistake twice.
        if !self.problems.contains(&problem) {
            self.problems.push(problem);
        }
    }
}
