//! Memories whose reads give the word that is being written. A synchronous read of one is a register of what an
//! asynchronous read gives, or of what is written there at the same edge. Synthesizers make a block RAM of both.

use crate::draft::{Draft, DraftRegister};
use tilewright_circuit::ir::{Binary, MemoryId, NodeId, Op, ReadUnderWrite, RegisterId, Relation, Shape, WritePort};
use tilewright_circuit::{Bits, Loc};

/// Replaces the synchronous reads of all memories of this policy.
pub(crate) fn apply(draft: &mut Draft) {
    for index in 0..draft.memories.len() {
        if draft.memories[index].memory.policy == ReadUnderWrite::New {
            (0..draft.memories[index].memory.reads.len()).for_each(|port| replace(draft, index, port));
            draft.memories[index].memory.policy = ReadUnderWrite::Old;
        }
    }
}

fn replace(draft: &mut Draft, index: usize, port: usize) {
    let memory = &draft.memories[index].memory;
    let read = memory.reads[port].clone();
    let Some(clock) = read.clock else { return };
    let writes: Vec<WritePort> = memory.writes.iter().filter(|write| write.clock == clock).cloned().collect();
    let (shape, width, depth) = (memory.shape, memory.width, memory.depth);
    let (kind, loc) = (draft.node(read.node).kind, draft.node(read.node).loc);
    let at_once = draft.add(Op::Read(MemoryId(index as u32), port as u32), width, shape, loc);
    draft.node_mut(at_once).kind = kind;
    let mut next = at_once;
    // If two ports write the word, the later one wins.
    for write in writes {
        let select = writes_to(draft, &write, (read.address, depth), loc);
        let select = draft.in_shape(select, shape, loc);
        next = draft.add(Op::Mux { select, on_true: write.data, on_false: next }, width, shape, loc);
        draft.node_mut(next).kind = kind;
    }
    let enable = read.enable.map(|enable| (draft.in_shape(enable, shape, loc), loc));
    let part = draft.memories[index].read_parts[port];
    draft.node_mut(read.node).op = Op::Register(RegisterId(draft.registers.len() as u32));
    draft.registers.push(DraftRegister {
        enable,
        next: Some((next, loc)),
        ..DraftRegister::new(read.node, clock, part)
    });
    let read = &mut draft.memories[index].memory.reads[port];
    (read.clock, read.enable, read.node) = (None, None, at_once);
}

/// Whether a port writes the word at an address. There is no word beyond the depth.
fn writes_to(draft: &mut Draft, write: &WritePort, (address, depth): (NodeId, u32), loc: Loc) -> NodeId {
    let width = draft.node(address).width;
    let same = compare(draft, Relation::Eq, [write.address, address], loc);
    let hits = and(draft, write.enable, same, loc);
    if u64::from(depth) == 1 << width {
        return hits;
    }
    let depth = draft.add(Op::Const(Bits::new(width, depth.into())), width, Shape::Plain, loc);
    let exists = compare(draft, Relation::Lt, [write.address, depth], loc);
    and(draft, hits, exists, loc)
}

fn compare(draft: &mut Draft, relation: Relation, [left, right]: [NodeId; 2], loc: Loc) -> NodeId {
    let (operands, shape) = draft.alike([left, right], loc);
    draft.add(Op::Compare { relation, signed: false, operands }, 1, shape, loc)
}

fn and(draft: &mut Draft, left: NodeId, right: NodeId, loc: Loc) -> NodeId {
    let ([left, right], shape) = draft.alike([left, right], loc);
    draft.add(Op::Binary(Binary::And, left, right), 1, shape, loc)
}
