//! Walks over a module's expressions without recursion: a description may chain a hundred thousand of them.

use tilewright_circuit::ir::{Module, NodeId, Op};

/// Every node of the module, operands and addresses before the nodes that use them; otherwise in the order of
/// creation.
pub fn operands_first(module: &Module) -> Vec<NodeId> {
    let mut order = Vec::with_capacity(module.nodes.len());
    let mut seen = vec![false; module.nodes.len()];
    for id in 0..module.nodes.len() as u32 {
        visit(module, NodeId(id), &mut seen, &mut order);
    }
    order
}

fn visit(module: &Module, root: NodeId, seen: &mut [bool], order: &mut Vec<NodeId>) {
    let mut stack = vec![(root, false)];
    while let Some((id, operands_done)) = stack.pop() {
        if operands_done {
            order.push(id);
            continue;
        }
        if std::mem::replace(&mut seen[id.0 as usize], true) {
            continue;
        }
        stack.push((id, true));
        let first = stack.len();
        for_each_read(module, id, |operand| stack.push((operand, false)));
        stack[first..].reverse();
    }
}

/// Calls `visit` with every node that the text of a node names: its operands, and the address of an asynchronous read.
pub fn for_each_read(module: &Module, id: NodeId, mut visit: impl FnMut(NodeId)) {
    match module.node(id).op {
        Op::Read(memory, port) => {
            let read = &module.memories[memory.0 as usize].reads[port as usize];
            if read.clock.is_none() {
                visit(read.address);
            }
        }
        ref op => op.for_each_operand(visit),
    }
}

/// The operator with each operand replaced.
pub fn map_operands(op: &Op, mut f: impl FnMut(NodeId) -> NodeId) -> Op {
    let mut all = |ids: &[NodeId]| ids.iter().map(|&id| f(id)).collect::<Vec<_>>();
    match op {
        Op::Input(_) | Op::Const(_) | Op::Register(_) | Op::Read(..) | Op::Output(..) => op.clone(),
        Op::Unary(unary, a) => Op::Unary(*unary, f(*a)),
        Op::Binary(binary, a, b) => Op::Binary(*binary, f(*a), f(*b)),
        Op::Compare { relation, signed, operands: [a, b] } => {
            Op::Compare { relation: *relation, signed: *signed, operands: [f(*a), f(*b)] }
        }
        Op::Shift(shift, a, b) => Op::Shift(*shift, f(*a), f(*b)),
        Op::Mux { select, on_true, on_false } => {
            Op::Mux { select: f(*select), on_true: f(*on_true), on_false: f(*on_false) }
        }
        Op::Select { arms, default } => {
            Op::Select { arms: arms.iter().map(|&(c, v)| (f(c), f(v))).collect(), default: f(*default) }
        }
        Op::Case { subject, arms, default } => Op::Case {
            subject: f(*subject),
            arms: arms.iter().map(|(key, v)| (key.clone(), f(*v))).collect(),
            default: f(*default),
        },
        Op::Slice { of, low } => Op::Slice { of: f(*of), low: *low },
        Op::Concat(parts) => Op::Concat(all(parts)),
        Op::Repeat(a, times) => Op::Repeat(f(*a), *times),
        Op::Extend { of, signed } => Op::Extend { of: f(*of), signed: *signed },
        Op::Wire(a) => Op::Wire(f(*a)),
        Op::QuasiStatic(a, reason) => Op::QuasiStatic(f(*a), reason.clone()),
        &Op::Broadcast { of, axis } => Op::Broadcast { of: f(of), axis },
        Op::Stack { parts, axis } => Op::Stack { parts: all(parts), axis: *axis },
        &Op::Map { of, axis, index, edge } => Op::Map { of: f(of), axis, index, edge: edge.map(f) },
        Op::Interleave { parts, axis } => Op::Interleave { parts: all(parts), axis: *axis },
        &Op::Lane { of, axis, index } => Op::Lane { of: f(of), axis, index },
        &Op::Pick { of, axis, index } => Op::Pick { of: f(of), axis, index: f(index) },
        &Op::Reduce { by, of, axis } => Op::Reduce { by, of: f(of), axis },
        &Op::Pack { of, axis } => Op::Pack { of: f(of), axis },
        &Op::Unpack { of, axis } => Op::Unpack { of: f(of), axis },
    }
}
