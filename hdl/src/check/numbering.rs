//! Numbers for the names that one place in the source asks for several times: a helper that is called twice, a loop.

use crate::draft::{Draft, UNDRIVEN};
use std::collections::BTreeSet;
use tilewright_circuit::Loc;
use tilewright_circuit::ir::{NodeId, Op};

/// An object of a draft that has a name.
#[derive(Clone, Copy)]
enum Object {
    Node(NodeId),
    Memory(usize),
    Instance(usize),
}

/// Appends a number to each further name from one place in the source: `was`, `was_1`. The sequence is that of the
/// description, so the numbers are the same for every elaboration. A port keeps its name: a net takes a number beside
/// the input that it carries, and beside an output that another net of its place drives. All other names that clash
/// stay as they are, for the check to report.
///
/// `outputs` are sorted.
pub(super) fn number(draft: &mut Draft, outputs: &[(NodeId, String)], is_port: impl Fn(&str) -> bool) {
    let mut objects = objects(draft, outputs);
    objects.sort_by_key(|(name, _)| *name);
    let is_asked = |name: &str| objects.binary_search_by_key(&name, |(known, _)| known).is_ok() || is_port(name);
    let mut renamed = Vec::new();
    for same in objects.chunk_by(|(one, _), (next, _)| one == next) {
        let name = same[0].0;
        let is_port = is_port(name);
        if (same.len() == 1 && !is_port) || !is_one_place(draft, same) {
            continue;
        }
        if is_port && !same.iter().all(|(_, object)| is_beside(draft, *object, name, outputs)) {
            continue;
        }
        let first = usize::from(!is_port);
        let mut free = (1..).map(|number| format!("{name}_{number}")).filter(|name| !is_asked(name));
        renamed.extend(same[first..].iter().map(|(_, object)| (*object, free.next().expect("endless"))));
    }
    renamed.into_iter().for_each(|(object, name)| object.rename(draft, name));
}

/// The named objects inside of the module, in the sequence of the description. A net that is the output of its name is
/// not among them.
fn objects<'a>(draft: &'a Draft, outputs: &[(NodeId, String)]) -> Vec<(&'a str, Object)> {
    let mut objects = Vec::new();
    for (id, node) in (0..).map(NodeId).zip(&draft.nodes) {
        let name = node.name.as_deref().filter(|_| !matches!(node.op, Op::Input(_)));
        objects.extend(name.filter(|name| !drives(outputs, id, name)).map(|name| (name, Object::Node(id))));
    }
    let memories = draft.memories.iter().enumerate();
    objects.extend(memories.map(|(i, draft)| (draft.memory.name.as_str(), Object::Memory(i))));
    let instances = draft.instances.iter().enumerate();
    objects.extend(instances.map(|(i, instance)| (instance.name.as_str(), Object::Instance(i))));
    objects
}

/// Whether the node drives the output of this name; `outputs` are sorted.
pub(super) fn drives(outputs: &[(NodeId, String)], node: NodeId, name: &str) -> bool {
    outputs.binary_search_by(|(driver, output)| (*driver, output.as_str()).cmp(&(node, name))).is_ok()
}

fn is_one_place(draft: &Draft, objects: &[(&str, Object)]) -> bool {
    objects.windows(2).all(|pair| pair[0].1.loc(draft) == pair[1].1.loc(draft))
}

/// Whether the object may stand beside the port of its name.
fn is_beside(draft: &Draft, object: Object, name: &str, outputs: &[(NodeId, String)]) -> bool {
    let is_output = |(node, output): &(NodeId, String)| {
        let driver = draft.node(*node);
        output == name && driver.name.as_deref() == Some(name) && driver.loc == object.loc(draft)
    };
    let carries = matches!(object, Object::Node(node) if carries(draft, node, name));
    carries || outputs.iter().any(is_output)
}

/// Whether a net is the input of this name: another name for it, the input in a later clock, or in another clock.
fn carries(draft: &Draft, mut node: NodeId, input: &str) -> bool {
    let mut seen = BTreeSet::new();
    while seen.insert(node) {
        node = match draft.node(node).op {
            Op::Input(index) => return draft.inputs[index as usize].name == input,
            Op::Wire(of) | Op::QuasiStatic(of, _) if of != UNDRIVEN => of,
            Op::Register(id) => {
                let register = &draft.registers[id.0 as usize];
                let is_delay = register.is_synchronizer || draft.pipelines.delays.contains(&node);
                match register.next.filter(|_| is_delay) {
                    Some((next, _)) => next,
                    None => return false,
                }
            }
            _ => return false,
        };
    }
    false
}

impl Object {
    fn loc(self, draft: &Draft) -> Loc {
        match self {
            Object::Node(node) => draft.node(node).loc,
            Object::Memory(memory) => draft.memories[memory].memory.loc,
            Object::Instance(instance) => draft.instances[instance].loc,
        }
    }

    fn rename(self, draft: &mut Draft, name: String) {
        match self {
            Object::Node(node) => draft.node_mut(node).name = Some(name),
            Object::Memory(memory) => draft.memories[memory].memory.name = name,
            Object::Instance(instance) => draft.instances[instance].name = name,
        }
    }
}
