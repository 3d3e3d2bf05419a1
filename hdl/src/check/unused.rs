//! What reads which node, and inputs that nothing reads.

use crate::draft::Draft;
use tilewright_circuit::ir::{NodeId, Op};
use tilewright_circuit::{Mistake, Problem};

/// For each node, whether a node for which `counts` is true reads it, or state or a statement.
pub(super) fn read_within(draft: &Draft, counts: impl Fn(&Op) -> bool) -> Vec<bool> {
    let mut used = vec![false; draft.nodes.len()];
    let mut mark = |node: NodeId| used[node.0 as usize] = true;
    draft.nodes.iter().filter(|node| counts(&node.op)).for_each(|node| node.op.for_each_operand(&mut mark));
    draft.properties.iter().flat_map(|draft| draft.property.nodes()).for_each(&mut mark);
    draft.parts.iter().for_each(|part| mark(part.enable));
    for register in &draft.registers {
        register.next.iter().chain(&register.enable).for_each(|(node, _)| mark(*node));
    }
    for memory in draft.memories.iter().map(|draft| &draft.memory) {
        memory.reads.iter().for_each(|read| read.enable.into_iter().chain([read.address]).for_each(&mut mark));
        memory
            .writes
            .iter()
            .for_each(|write| [write.enable, write.address, write.data].into_iter().for_each(&mut mark));
    }
    used
}

pub(crate) fn check(draft: &Draft, outputs: &[(String, NodeId)], problems: &mut Vec<Problem>) {
    let mut used = read_within(draft, |_| true);
    let mut mark = |node: NodeId| used[node.0 as usize] = true;
    outputs.iter().for_each(|(_, node)| mark(*node));
    draft.ignored.iter().chain(&draft.in_problems).for_each(|node| mark(*node));
    draft.enables.iter().for_each(|(_, input)| mark(*input));
    draft.instances.iter().for_each(|instance| instance.inputs.iter().for_each(|node| mark(*node)));
    for input in draft.inputs.iter().filter(|input| !used[input.node.0 as usize]) {
        let message = format!("input `{}` of `{}` is never used", input.name, draft.block);
        let help = format!("remove it, or say `m.ignore(&i.{})` if that is intended", input.path);
        problems.push(Problem::new(Mistake::UnusedInput, draft.node(input.node).loc, message).help(help));
    }
}
