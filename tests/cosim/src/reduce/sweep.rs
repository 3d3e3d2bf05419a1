//! Leaves out of a circuit what nothing depends on.

use super::of_write;
use crate::edit::operands;
use tilewright_hdl::Bits;
use tilewright_hdl::ir::{InstanceId, MemoryId, Module, ModuleId, NodeId, Op, Property, RegisterId};

/// Visits every mention of a node but those of ports and of objects that are that node.
pub fn for_each_use(module: &mut Module, mut visit: impl FnMut(&mut NodeId)) {
    module.nodes.iter_mut().flat_map(|node| operands(&mut node.op)).for_each(&mut visit);
    for register in &mut module.registers {
        visit(&mut register.next);
        register.enable.iter_mut().for_each(&mut visit);
    }
    for memory in &mut module.memories {
        for read in &mut memory.reads {
            visit(&mut read.address);
            read.enable.iter_mut().for_each(&mut visit);
        }
        memory.writes.iter_mut().flat_map(of_write).for_each(&mut visit);
    }
    module.instances.iter_mut().flat_map(|instance| &mut instance.inputs).for_each(&mut visit);
    for property in &mut module.properties {
        visit(&mut property.condition);
        property.values.iter_mut().for_each(|shown| visit(&mut shown.node));
    }
}

/// Visits every mention of a node.
pub fn for_each_mention(module: &mut Module, mut visit: impl FnMut(&mut NodeId)) {
    for_each_use(module, &mut visit);
    module.inputs.iter_mut().for_each(|input| visit(&mut input.node));
    module.outputs.iter_mut().for_each(|output| visit(&mut output.node));
    module.registers.iter_mut().for_each(|register| visit(&mut register.node));
    module.memories.iter_mut().flat_map(|memory| &mut memory.reads).for_each(|read| visit(&mut read.node));
    module.instances.iter_mut().flat_map(|instance| &mut instance.outputs).for_each(visit);
}

/// Drops an output of a module, which is zero wherever it was.
pub fn drop_output(modules: &mut [Module], at: usize, port: usize) {
    modules[at].outputs.remove(port);
    for module in &mut modules[at + 1..] {
        for instance in module.instances.iter_mut().filter(|instance| instance.module.0 as usize == at) {
            let node = &mut module.nodes[instance.outputs.remove(port).0 as usize];
            node.op = Op::Const(Bits::zero(node.width));
        }
    }
    for module in &mut modules[at + 1..] {
        number_outputs(module);
    }
}

fn number_outputs(module: &mut Module) {
    for (instance, place) in module.instances.iter().zip(0..) {
        for (node, port) in instance.outputs.iter().zip(0..) {
            module.nodes[node.0 as usize].op = Op::Output(InstanceId(place), port);
        }
    }
}

/// Leaves out what no output and no assertion of the last module depends on.
pub fn sweep(modules: &mut Vec<Module>) {
    for at in 0..modules.len() {
        let is_top = at + 1 == modules.len();
        let kept = live(&modules[at]);
        let inputs: Vec<bool> = modules[at].inputs.iter().map(|input| kept[input.node.0 as usize]).collect();
        if !is_top {
            for module in &mut modules[at + 1..] {
                for instance in module.instances.iter_mut().filter(|instance| instance.module.0 as usize == at) {
                    let mut kept = inputs.iter();
                    instance.inputs.retain(|_| *kept.next().expect("as many as there are ports"));
                }
            }
        }
        keep(&mut modules[at], &kept);
    }
    drop_unused(modules);
}

/// Leaves out modules but the last of which there is no instance.
pub fn drop_unused(modules: &mut Vec<Module>) {
    for at in (0..modules.len().saturating_sub(1)).rev() {
        let is = |module: &Module| module.instances.iter().any(|instance| instance.module.0 as usize == at);
        if !modules.iter().any(is) {
            modules.remove(at);
            let instances = modules.iter_mut().flat_map(|module| &mut module.instances);
            for instance in instances.filter(|instance| instance.module.0 as usize > at) {
                instance.module = ModuleId(instance.module.0 - 1);
            }
        }
    }
}

/// The nodes that something depends on.
fn live(module: &Module) -> Vec<bool> {
    let mut live = vec![false; module.nodes.len()];
    let mut open: Vec<NodeId> = module.outputs.iter().map(|output| output.node).collect();
    open.extend(module.properties.iter().flat_map(Property::nodes));
    while let Some(id) = open.pop() {
        if id.0 as usize >= live.len() || std::mem::replace(&mut live[id.0 as usize], true) {
            continue;
        }
        let mut op = module.node(id).op.clone();
        match &op {
            Op::Register(register) => {
                let register = &module.registers[register.0 as usize];
                open.extend([register.next].into_iter().chain(register.enable));
            }
            Op::Read(memory, port) => {
                let memory = &module.memories[memory.0 as usize];
                let read = &memory.reads[*port as usize];
                open.extend([read.address].into_iter().chain(read.enable));
                open.extend(memory.writes.iter().flat_map(|it| [it.enable, it.address, it.data]));
            }
            Op::Output(instance, _) => {
                let instance = &module.instances[instance.0 as usize];
                open.extend(instance.inputs.iter().chain(&instance.outputs));
            }
            _ => open.extend(operands(&mut op).into_iter().map(|id| *id)),
        }
    }
    live
}

/// Keeps these nodes and the objects that are among them.
fn keep(module: &mut Module, kept: &[bool]) {
    let is = |id: NodeId| kept[id.0 as usize];
    let op = |module: &Module, id: NodeId| module.nodes[id.0 as usize].op.clone();
    let registers = std::mem::take(&mut module.registers);
    module.registers =
        registers.into_iter().filter(|it| is(it.node) && matches!(op(module, it.node), Op::Register(_))).collect();
    let mut memories = std::mem::take(&mut module.memories);
    for memory in &mut memories {
        memory.reads.retain(|read| is(read.node) && matches!(op(module, read.node), Op::Read(..)));
    }
    memories.retain(|memory| !memory.reads.is_empty());
    module.memories = memories;
    let instances = std::mem::take(&mut module.instances);
    module.instances = instances.into_iter().filter(|it| it.outputs.iter().any(|id| is(*id))).collect();
    let inputs = std::mem::take(&mut module.inputs);
    module.inputs =
        inputs.into_iter().filter(|it| is(it.node) && matches!(op(module, it.node), Op::Input(_))).collect();
    let mut count = 0;
    let places: Vec<u32> = kept
        .iter()
        .map(|kept| {
            let place = count;
            count += u32::from(*kept);
            place
        })
        .collect();
    let mut all = kept.iter();
    module.nodes.retain(|_| *all.next().expect("as many as there are nodes"));
    for_each_mention(module, |id| *id = NodeId(places[id.0 as usize]));
    for (place, input) in (0..).zip(&module.inputs) {
        module.nodes[input.node.0 as usize].op = Op::Input(place);
    }
    for (place, register) in (0..).zip(&module.registers) {
        module.nodes[register.node.0 as usize].op = Op::Register(RegisterId(place));
    }
    for (place, memory) in (0..).map(MemoryId).zip(&module.memories) {
        for (port, read) in (0..).zip(&memory.reads) {
            module.nodes[read.node.0 as usize].op = Op::Read(place, port);
        }
    }
    number_outputs(module);
}
