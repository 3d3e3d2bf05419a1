//! Gives unnamed expressions the name of the wire or port that they drive, so that a value has one name.

use super::order::map_operands;
use tilewright_circuit::ir::{Module, NodeId, Op};

/// A named wire becomes the operator that drives it; then a port gives its name to its driver.
pub fn adopt_names(module: &mut Module) {
    let mut same: Vec<NodeId> = (0..module.nodes.len() as u32).map(NodeId).collect();
    for wire in 0..module.nodes.len() {
        if let Op::Wire(driver) | Op::QuasiStatic(driver, _) = module.nodes[wire].op
            && module.nodes[wire].name.is_some()
            && same[driver.0 as usize] == driver
            && can_take_name(module, driver)
        {
            same[driver.0 as usize] = NodeId(wire as u32);
            module.nodes[wire].op = module.node(driver).op.clone();
            module.nodes[driver.0 as usize].op = Op::Wire(NodeId(wire as u32));
        }
    }
    let to = |id: NodeId| same[id.0 as usize];
    for (id, node) in module.nodes.iter_mut().enumerate() {
        if same[id] == NodeId(id as u32) {
            node.op = map_operands(&node.op, to);
        }
    }
    for register in &mut module.registers {
        register.next = to(register.next);
        register.enable = register.enable.map(to);
    }
    for memory in &mut module.memories {
        for read in &mut memory.reads {
            (read.node, read.address, read.enable) = (to(read.node), to(read.address), read.enable.map(to));
        }
        for write in &mut memory.writes {
            (write.enable, write.address, write.data) = (to(write.enable), to(write.address), to(write.data));
        }
    }
    for instance in &mut module.instances {
        instance.inputs.iter_mut().chain(&mut instance.outputs).for_each(|id| *id = to(*id));
    }
    for property in &mut module.properties {
        property.condition = to(property.condition);
        property.values.iter_mut().for_each(|shown| shown.node = to(shown.node));
    }
    for port in 0..module.outputs.len() {
        let driver = to(module.outputs[port].node);
        module.outputs[port].node = driver;
        if can_take_name(module, driver) {
            module.nodes[driver.0 as usize].name = Some(module.outputs[port].name.clone());
        }
    }
}

/// Whether the node has no name and no declaration of its own.
fn can_take_name(module: &Module, id: NodeId) -> bool {
    let node = module.node(id);
    let declared = match node.op {
        Op::Read(memory, port) => module.memories[memory.0 as usize].reads[port as usize].clock.is_some(),
        Op::Lane { .. } | Op::Const(_) | Op::Input(_) | Op::Register(_) => true,
        // The output of an array gets the name of the port.
        Op::Output(..) => !node.shape.is_plain(),
        _ => false,
    };
    node.name.is_none() && !declared
}
