//! Asserts that the subject of a choice is a code of its enum, if that is certain.

use crate::codes::{add_is_code, has_spare_codes};
use crate::draft::{Draft, DraftProperty};
use std::collections::BTreeSet;
use tilewright_circuit::ir::{ClockId, Contents, Directive, Kind, NodeId, Op, Property};

/// Adds an assertion for each subject whose value is known from the first edge on and that has spare values.
pub(crate) fn assert_codes(draft: &mut Draft) {
    let mut done = BTreeSet::new();
    for (subject, part, loc) in std::mem::take(&mut draft.chosen) {
        let node = draft.node(subject);
        let Kind::Code(names) = node.kind else { continue };
        if !has_spare_codes(names, node.width) || !done.insert(subject) {
            continue;
        }
        if let Some(clock) = known_on(draft, subject) {
            let message = format!("`{}` is a code of `{}`", draft.describe(subject), names.of);
            let condition = add_is_code(draft, subject, names, loc);
            let (directive, values) = (Directive::Assert, Vec::new());
            let property = Property { directive, clock, condition, message, values, loc };
            draft.properties.push(DraftProperty { property, part });
        }
    }
}

/// The clock of the registers that determine a node's value, if they have one clock and nothing on the way is unknown
/// at the start.
fn known_on(draft: &Draft, node: NodeId) -> Option<ClockId> {
    let (mut seen, mut open, mut clocks) = (BTreeSet::from([node]), vec![node], BTreeSet::new());
    while let Some(node) = open.pop() {
        for source in sources(draft, node, &mut clocks)? {
            if seen.insert(source) {
                open.push(source);
            }
        }
    }
    let mut clocks = clocks.into_iter();
    clocks.next().filter(|_| clocks.next().is_none())
}

/// The nodes that determine a node's value, now or at the previous edge. `None` if the value is unknown at the start
/// or comes from elsewhere. Select signals are not included.
fn sources(draft: &Draft, node: NodeId, clocks: &mut BTreeSet<ClockId>) -> Option<Vec<NodeId>> {
    let mut sources = Vec::new();
    match &draft.node(node).op {
        Op::Input(_) | Op::Output(..) => return None,
        Op::Register(register) => {
            let register = &draft.registers[register.0 as usize];
            if register.reset.is_none() && register.initial.is_none() {
                return None;
            }
            clocks.insert(register.clock);
            sources.extend(register.next.map(|(next, _)| next));
        }
        Op::Read(memory, port) => {
            let memory = &draft.memories[memory.0 as usize].memory;
            if memory.reads[*port as usize].clock.is_some() || memory.contents == Contents::Unknown {
                return None;
            }
            clocks.extend(memory.writes.iter().map(|write| write.clock));
            sources.extend(memory.writes.iter().map(|write| write.data));
        }
        Op::Mux { on_true, on_false, .. } => sources.extend([on_true, on_false]),
        Op::Select { arms, default } => sources.extend(arms.iter().map(|(_, value)| value).chain([default])),
        Op::Case { arms, default, .. } => sources.extend(arms.iter().map(|(_, value)| value).chain([default])),
        Op::Pick { of, .. } => sources.push(*of),
        op => op.for_each_operand(|operand| sources.push(operand)),
    }
    Some(sources)
}
