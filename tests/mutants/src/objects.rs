//! Edits of registers, memories, instances, outputs and assumptions.

use crate::same::is_guard;
use crate::site::{Sites, always, beside, near, near_init, not, observed};
use tilewright_hdl::ir::{Contents, Directive, Module, Node, NodeId, Op, ReadUnderWrite};

/// Adds the mutants in which a part of the schematic is another.
pub(crate) fn edit(sites: &mut Sites) {
    registers(sites);
    memories(sites);
    instances(sites);
    ends(sites);
}

fn registers(sites: &mut Sites) {
    let (module, observed) = (sites.module, observed(sites.module));
    let described = |node: NodeId| observed[node.0 as usize] && !is_guard(module, node);
    for (i, register) in module.registers.iter().enumerate().filter(|(_, register)| described(register.node)) {
        let (name, loc) = (module.register_name(register), module.node(register.node).loc);
        if let Some(reset) = &register.reset {
            sites.add(name, loc, "reset dropped", |module| module.registers[i].reset = None);
            for (change, reset) in near_init(reset) {
                sites.add(name, loc, format!("reset to {change}"), |m| m.registers[i].reset = Some(reset));
            }
        }
        if let Some(enable) = register.enable {
            sites.add(name, loc, "enable dropped", |module| module.registers[i].enable = None);
            sites.add(name, loc, "enable inverted", |m| m.registers[i].enable = Some(not(m, enable)));
            sites.add(name, loc, "never enabled", |m| m.registers[i].enable = Some(always(m, enable, false)));
        }
        sites.add(name, loc, "register bypassed", |module| bypass(module, i));
    }
}

/// What the register takes at the next edge is seen in its place at once.
fn bypass(module: &mut Module, index: usize) {
    let register = module.registers[index].clone();
    let old = module.node(register.node).clone();
    let held = beside(module, register.node, old.width, old.op.clone());
    module.nodes[held.0 as usize] = Node { name: old.name.map(|name| name + "_held"), ..module.node(held).clone() };
    module.nodes[held.0 as usize].kind = old.kind;
    module.registers[index].node = held;
    module.nodes[register.node.0 as usize].op = match register.enable {
        None => Op::Wire(register.next),
        Some(select) => Op::Mux { select, on_true: register.next, on_false: held },
    };
}

fn memories(sites: &mut Sites) {
    let module = sites.module;
    for (i, memory) in module.memories.iter().enumerate() {
        let (name, loc) = (memory.name.as_str(), memory.loc);
        for (port, write) in memory.writes.iter().enumerate() {
            for holds in [false, true] {
                sites.add(name, loc, format!("write port {port} enabled always: {holds}"), |module| {
                    module.memories[i].writes[port].enable = always(module, write.enable, holds);
                });
            }
        }
        for (port, read) in memory.reads.iter().enumerate() {
            let Some(enable) = read.enable else { continue };
            let reads = move |module: &mut Module, enable| module.memories[i].reads[port].enable = enable;
            sites.add(name, loc, format!("read port {port} enabled always"), |m| reads(m, None));
            sites.add(name, loc, format!("the enable of read port {port} inverted"), |module| {
                let inverted = not(module, enable);
                reads(module, Some(inverted));
            });
        }
        if memory.reads.iter().any(|read| read.clock.is_some()) {
            let other = if memory.policy == ReadUnderWrite::Old { ReadUnderWrite::Any } else { ReadUnderWrite::Old };
            sites.add(name, loc, "the other policy of reading under a write", |m| m.memories[i].policy = other);
        }
        contents(sites, i);
    }
}

fn contents(sites: &mut Sites, index: usize) {
    let memory = &sites.module.memories[index];
    let (name, loc) = (memory.name.as_str(), memory.loc);
    match &memory.contents {
        Contents::Fill(word) => {
            sites.add(name, loc, "contents unknown", |m| m.memories[index].contents = Contents::Unknown);
            for (change, word) in near(word) {
                sites.add(name, loc, format!("filled with {change}"), |m| {
                    m.memories[index].contents = Contents::Fill(word)
                });
            }
        }
        Contents::Words(words) => {
            for place in 0..words.len() {
                sites.add(name, loc, format!("word {place} is one more"), |module| {
                    if let Contents::Words(words) = &mut module.memories[index].contents {
                        words[place] = near(&words[place]).swap_remove(0).1;
                    }
                });
            }
        }
        Contents::Unknown | Contents::Each(_) => {}
    }
}

/// Inputs of instances exchanged or inverted.
fn instances(sites: &mut Sites) {
    let module = sites.module;
    for (i, instance) in module.instances.iter().enumerate() {
        let (name, loc) = (instance.name.as_str(), instance.loc);
        for (port, &input) in instance.inputs.iter().enumerate() {
            if module.width(input) == 1 {
                sites.add(name, loc, format!("input {port} inverted"), |module| {
                    module.instances[i].inputs[port] = not(module, input);
                });
            }
            let other = port.checked_sub(1).filter(|other| alike(module, instance.inputs[*other], input));
            if let Some(other) = other {
                let change = format!("inputs {other} and {port} exchanged");
                sites.add(name, loc, change, |module| module.instances[i].inputs.swap(other, port));
            }
        }
    }
}

/// Outputs exchanged or inverted, assumptions dropped.
fn ends(sites: &mut Sites) {
    let module = sites.module;
    for (i, output) in module.outputs.iter().enumerate() {
        let (name, loc) = (format!("output {}", output.name), module.node(output.node).loc);
        if module.width(output.node) == 1 {
            sites.add(&name, loc, "inverted", |module| module.outputs[i].node = not(module, output.node));
        }
        let other = i.checked_sub(1).filter(|other| alike(module, module.outputs[*other].node, output.node));
        if let Some(other) = other {
            let first = module.outputs[other].node;
            sites.add(&name, loc, format!("exchanged with {}", module.outputs[other].name), |module| {
                (module.outputs[other].node, module.outputs[i].node) = (output.node, first);
            });
        }
    }
    let assumes = module.properties.iter().enumerate().filter(|(_, it)| it.directive == Directive::Assume);
    for (i, assume) in assumes {
        sites.add("an assumption", assume.loc, "dropped", |module| {
            module.properties[i].condition = always(module, assume.condition, true);
        });
    }
}

/// Whether two values differ and one can stand for the other.
fn alike(module: &Module, a: NodeId, b: NodeId) -> bool {
    a != b && (module.width(a), module.shape(a)) == (module.width(b), module.shape(b))
}
