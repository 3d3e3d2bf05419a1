//! The registers that only properties read, such as those of past values: synthesizers need not see them.

use super::plan::Plan;
use tilewright_circuit::ir::{Module, NodeId, Op, Property};

/// For each register, whether it belongs to the properties: nothing printed elsewhere reads it.
pub fn stated(module: &Module, plan: &Plan, resets: &[Option<NodeId>]) -> Vec<bool> {
    let by_statements = reached(module, module.properties.iter().flat_map(Property::nodes).collect(), true);
    let plain = |index: usize| module.shape(module.registers[index].node).is_plain() && resets[index].is_none();
    let is_port = |node: NodeId| module.outputs.iter().any(|output| output.node == node);
    let may = |index: usize| by_statements[index] && plain(index) && !is_port(module.registers[index].node);
    let mut stated: Vec<bool> = (0..module.registers.len()).map(may).collect();
    // A register that stays outside may read another one, which then must stay too.
    loop {
        let outside = reached(module, printed_outside(module, plan, &stated), false);
        let left: Vec<bool> = stated.iter().zip(&outside).map(|(stated, read)| *stated && !read).collect();
        if left == stated {
            return stated;
        }
        stated = left;
    }
}

/// The nodes that are read outside of properties: by ports, instances, memories and the other registers, and by nodes
/// with lines of their own.
fn printed_outside(module: &Module, plan: &Plan, stated: &[bool]) -> Vec<NodeId> {
    let mut roots: Vec<NodeId> = module.outputs.iter().map(|output| output.node).collect();
    roots.extend(module.instances.iter().flat_map(|instance| &instance.inputs));
    for memory in &module.memories {
        roots.extend(memory.reads.iter().flat_map(|read| read.enable.into_iter().chain([read.address])));
        roots.extend(memory.writes.iter().flat_map(|write| [write.enable, write.address, write.data]));
    }
    let others = module.registers.iter().zip(stated).filter(|(_, stated)| !**stated);
    roots.extend(others.flat_map(|(register, _)| register.enable.into_iter().chain([register.next])));
    let nodes = (0..module.nodes.len() as u32).map(NodeId);
    roots.extend(nodes.filter(|&id| plan.is_net(id) || !module.shape(id).is_plain()));
    roots
}

/// The registers that these nodes read: within the cycle, or also through other registers.
fn reached(module: &Module, mut open: Vec<NodeId>, through_registers: bool) -> Vec<bool> {
    let mut reached = vec![false; module.registers.len()];
    let mut seen = vec![false; module.nodes.len()];
    while let Some(id) = open.pop() {
        if std::mem::replace(&mut seen[id.0 as usize], true) {
            continue;
        }
        if let Op::Register(register) = module.node(id).op {
            reached[register.0 as usize] = true;
            let register = &module.registers[register.0 as usize];
            open.extend(register.enable.into_iter().chain([register.next]).filter(|_| through_registers));
        }
        module.node(id).op.for_each_operand(|operand| open.push(operand));
    }
    reached
}
