//! Names: those of the description unchanged. The few nets without one are named by what they are, such as
//! `step_is_idle`; otherwise after the consumer and the operator, such as `count_sum`. An edit elsewhere in the module
//! renames nothing.

use super::order::for_each_read;
use super::own_name::Operands;
use super::plan::{Form, Plan};
use super::reads::ReadNames;
use super::scope::Names;
use std::collections::{BTreeMap, BTreeSet};
use tilewright_circuit::ir::{Binary, Design, Directive, Module, NodeId, Op, Reduction, Relation, Unary};

/// The name of every node that is referred to by name.
pub fn name_nodes(
    design: &Design,
    module: &Module,
    plan: &Plan,
    reads: &[Vec<Option<ReadNames>>],
    resets: &[Option<NodeId>],
    ports: &BTreeMap<NodeId, String>,
    taken: &mut Names,
) -> Vec<Option<String>> {
    let mut namer = Namer {
        design,
        module,
        plan,
        ports,
        taken,
        names: module.nodes.iter().map(|node| node.name.clone()).collect(),
    };
    namer.name_declared(reads);
    for id in (0..module.nodes.len() as u32).map(NodeId) {
        if let Some(name) = &module.node(id).name {
            namer.name_below(id, name, name);
        }
    }
    for register in &module.registers {
        let name = module.register_name(register);
        namer.name_below(register.next, name, &format!("{name}_next"));
        if let Some(enable) = register.enable {
            namer.name_below(enable, name, &format!("{name}_enable"));
        }
    }
    namer.name_memory_ports();
    for instance in &module.instances {
        for (port, &input) in design.module(instance.module).inputs.iter().zip(&instance.inputs) {
            let base = format!("{}_{}", instance.name, port.name);
            namer.name_below(input, &base, &base);
        }
    }
    for (register, reset) in module.registers.iter().zip(resets) {
        let name = module.register_name(register);
        reset.iter().for_each(|&id| namer.name_below(id, name, &format!("{name}_reset")));
    }
    for output in &module.outputs {
        namer.name_below(output.node, &output.name, &format!("{}_value", output.name));
    }
    for property in &module.properties {
        let name = match property.directive {
            Directive::Assert => "asserted",
            Directive::Assume => "assumed",
            Directive::Cover => "covered",
            Directive::Display => "displayed",
        };
        namer.name_below(property.condition, name, name);
        property.values.iter().for_each(|shown| namer.name_below(shown.node, "shown", "shown"));
    }
    namer.names
}

struct Namer<'a> {
    design: &'a Design,
    module: &'a Module,
    plan: &'a Plan,
    /// Values named after the port for which they are made.
    ports: &'a BTreeMap<NodeId, String>,
    taken: &'a mut Names,
    names: Vec<Option<String>>,
}

impl Namer<'_> {
    fn give(&mut self, id: NodeId, wanted: &str) {
        if self.names[id.0 as usize].is_none() && !self.ports.contains_key(&id) {
            self.names[id.0 as usize] = Some(self.taken.fresh(wanted));
        }
    }

    /// Data of memories and outputs of instances.
    fn name_declared(&mut self, reads: &[Vec<Option<ReadNames>>]) {
        for (memory, names) in self.module.memories.iter().zip(reads) {
            let asynchronous = memory.reads.iter().filter(|read| read.clock.is_none()).count();
            let mut index = 0;
            for (read, names) in memory.reads.iter().zip(names) {
                match names {
                    Some(names) => self.names[read.node.0 as usize] = Some(names.data.clone()),
                    None => {
                        let number = if asynchronous > 1 { index.to_string() } else { String::new() };
                        index += 1;
                        self.give(read.node, &format!("{}_word{number}", memory.name));
                    }
                }
            }
        }
        for instance in self.module.instances.iter().filter(|instance| instance.shape.is_plain()) {
            for (port, &node) in self.design.module(instance.module).outputs.iter().zip(&instance.outputs) {
                self.give(node, &format!("{}_{}", instance.name, port.name));
            }
        }
    }

    fn name_memory_ports(&mut self) {
        for memory in &self.module.memories {
            let name = &memory.name;
            for read in &memory.reads {
                let base = format!("{name}_read");
                self.name_below(read.address, &base, &format!("{base}_address"));
                read.enable.iter().for_each(|&id| self.name_below(id, &base, &format!("{base}_enable")));
            }
            for write in &memory.writes {
                let base = format!("{name}_write");
                self.name_below(write.enable, &base, &format!("{base}_enable"));
                self.name_below(write.address, &base, &format!("{base}_address"));
                self.name_below(write.data, &base, &format!("{base}_data"));
            }
        }
    }

    /// `jobs_valid & jobs_ready` means that the payload of `jobs` is taken.
    fn taken_name(&self, id: NodeId) -> Option<String> {
        let Op::Binary(Binary::And, a, b) = self.module.node(id).op else { return None };
        let pairs = [(a, b), (b, a)].into_iter();
        let mut streams = pairs.flat_map(|(valid, ready)| {
            let ready = self.streams(ready, "_ready");
            self.streams(valid, "_valid").into_iter().filter(move |stream| ready.contains(stream))
        });
        streams.next().map(|stream| format!("{stream}_taken"))
    }

    /// The names of the ports with a node's value and this suffix, without the suffix.
    fn streams(&self, id: NodeId, end: &str) -> Vec<&str> {
        let module = self.module;
        let source = |mut id: NodeId| {
            while let Op::Wire(of) = module.node(id).op {
                id = of;
            }
            id
        };
        let inputs = module.inputs.iter().map(|port| (port.node, &port.name));
        let ports = inputs.chain(module.outputs.iter().map(|port| (port.node, &port.name)));
        ports.filter(|(node, _)| source(*node) == source(id)).filter_map(|(_, name)| name.strip_suffix(end)).collect()
    }

    /// Names the still unnamed nets that `root` is computed from; `root` itself gets the name `itself`.
    fn name_below(&mut self, root: NodeId, base: &str, itself: &str) {
        let mut stack = vec![root];
        let mut seen = BTreeSet::new();
        let module = self.module;
        while let Some(id) = stack.pop() {
            // With chains of lanes, a net leads back to itself.
            if !seen.insert(id) {
                continue;
            }
            let form = self.plan.form(id);
            let is_named = self.names[id.0 as usize].is_some() || self.ports.contains_key(&id);
            let fresh = matches!(form, Form::Net | Form::Block | Form::Constants) && !is_named;
            if fresh && id == root {
                self.give(id, itself);
            } else if fresh {
                let operands = Operands { design: self.design, module, names: &self.names };
                let wanted = self.taken_name(id).or_else(|| operands.name(id));
                let wanted = wanted.unwrap_or_else(|| format!("{base}_{}", suffix(&module.node(id).op)));
                self.give(id, &wanted);
            }
            if id == root || fresh || matches!(form, Form::Inline | Form::Branches) || self.ports.contains_key(&id) {
                let first = stack.len();
                for_each_read(module, id, |operand| stack.push(operand));
                stack[first..].reverse();
            }
        }
    }
}

/// The suffix for the combination of all lanes.
pub fn combined(reduction: Reduction) -> &'static str {
    match reduction {
        Reduction::And => "all",
        Reduction::Or => "any",
        Reduction::Xor => "xor",
        Reduction::Add => "sum",
        Reduction::Min => "min",
        Reduction::Max => "max",
    }
}

/// The suffix for the operator of a value.
fn suffix(op: &Op) -> &'static str {
    match op {
        Op::Unary(Unary::Not, _) => "inverse",
        Op::Unary(Unary::AllOnes, _) => "all",
        Op::Unary(Unary::AnyOne, _) => "any",
        Op::Unary(Unary::Parity, _) => "parity",
        Op::Binary(Binary::And, ..) => "and",
        Op::Binary(Binary::Or, ..) => "or",
        Op::Binary(Binary::Xor, ..) => "xor",
        Op::Binary(Binary::Add, ..) => "sum",
        Op::Binary(Binary::Sub, ..) => "difference",
        Op::Binary(Binary::Mul | Binary::MulSigned, ..) => "product",
        Op::Compare { relation: Relation::Eq, .. } => "equal",
        Op::Compare { relation: Relation::Ne, .. } => "differs",
        Op::Compare { relation: Relation::Lt, .. } => "less",
        Op::Compare { relation: Relation::Le, .. } => "at_most",
        Op::Compare { relation: Relation::Gt, .. } => "greater",
        Op::Compare { relation: Relation::Ge, .. } => "at_least",
        Op::Shift(..) => "shifted",
        Op::Mux { .. } | Op::Select { .. } | Op::Case { .. } => "choice",
        Op::Slice { .. } => "part",
        Op::Concat(_) | Op::Repeat(..) => "joined",
        Op::Extend { .. } => "extended",
        Op::Lane { .. } | Op::Broadcast { .. } => "lane",
        Op::Map { .. } => "linked",
        Op::Stack { .. } => "listed",
        Op::Interleave { .. } => "woven",
        Op::Pick { .. } => "picked",
        Op::Pack { .. } | Op::Unpack { .. } => "lanes",
        Op::Reduce { by, .. } => combined(*by),
        Op::Input(_) | Op::Const(_) | Op::Register(_) | Op::Read(..) => "value",
        Op::Output(..) | Op::Wire(_) | Op::QuasiStatic(..) => "value",
    }
}
