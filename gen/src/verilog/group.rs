//! Groups of lanes: a `generate for`, nested for a grid, whose scopes are the lanes. Each scope has the nets,
//! registers, memories and instances of its lane.
//!
//! A link to a neighbour uses the net in the neighbour's scope, `u_cell[i - 1].out`. So every net belongs to one
//! lane, and no tool sees a combinational loop where the lanes only form a chain.

use super::branches::Target;
use super::foreign::instantiate;
use super::layout::{generate, range, with_place, wrapped};
use super::literal::{Style, literal};
use super::part::Index;
use super::plan::Form;
use super::printer::Printer;
use super::scope::LANE;
use super::statement::lines;
use std::collections::BTreeSet;
use tilewright_circuit::ir::{Affine, InstanceId, MemoryId, Node, NodeId, Op, Shape};
use tilewright_circuit::{Bits, Loc};

impl Printer<'_> {
    /// The groups, each after those that it reads.
    pub fn groups(&mut self) -> Vec<String> {
        let mut out = Vec::new();
        for group in 0..self.groups.groups.len() {
            let block = self.ahead(group);
            if !block.is_empty() {
                out.extend(block);
                out.push(String::new());
            }
        }
        for group in 0..self.groups.groups.len() {
            out.extend(self.group(group));
            out.push(String::new());
        }
        out
    }

    /// The block of nets that earlier groups read.
    fn ahead(&mut self, group: usize) -> Vec<String> {
        let nodes: Vec<NodeId> = self.groups.groups[group].ahead.iter().copied().collect();
        let Some(label) = self.lanes.groups[group].ahead.clone() else { return Vec::new() };
        let declaration = |id| match self.module.node(id).op {
            // The register is beside its memory.
            Op::Read(..) => format!("wire {}{};", range(self.module.width(id)), self.name(id)),
            _ => self.declaration(id),
        };
        let body = nodes.into_iter().map(declaration).collect();
        self.scopes(group, &label, None, body)
    }

    fn group(&mut self, group: usize) -> Vec<String> {
        let mut out = self.tables(group);
        self.here = Some(group);
        let shape = self.groups.groups[group].shape;
        let genvars: Vec<Index> =
            (0..shape.axes() as usize).map(|depth| Index::all(&self.loop_variable(depth))).collect();
        let body = self.at(genvars, |printer| printer.scope(group));
        self.here = None;
        let label = self.lanes.groups[group].label.clone();
        let place = match self.groups.groups[group].instances[..] {
            [index] => Some(self.module.instances[index].loc),
            _ => None,
        };
        out.extend(self.scopes(group, &label, place, body));
        out
    }

    /// A loop, or two, around the contents of a lane.
    fn scopes(&mut self, group: usize, label: &str, place: Option<Loc>, body: Vec<String>) -> Vec<String> {
        let placed = |line: String| match place {
            Some(loc) => with_place(line, loc),
            None => line,
        };
        match self.groups.groups[group].shape {
            Shape::Grid(rows, columns) => {
                let head = format!("{} begin : {label}", self.for_lanes(0, rows));
                let inner = format!("{} begin : {}", self.for_lanes(1, columns), self.lanes.column);
                generate(placed(head), block(inner, body))
            }
            shape => generate(placed(format!("{} begin : {label}", self.for_lanes(0, shape.lanes()))), body),
        }
    }

    /// The head of a loop over `lanes` lanes; loops within loops have the next depth.
    pub fn for_lanes(&mut self, depth: usize, lanes: u32) -> String {
        let i = self.loop_variable(depth);
        format!("for ({i} = 0; {i} < {lanes}; {i} = {i} + 1)")
    }

    /// The loop variable at a depth, which the text uses from now on.
    pub fn loop_variable(&mut self, depth: usize) -> String {
        self.lanes.used = self.lanes.used.max(depth + 1);
        self.lanes.genvars[depth].clone()
    }

    /// The tables of a group's constants, and the ports that it reads side by side.
    fn tables(&mut self, group: usize) -> Vec<String> {
        let mut out = Vec::new();
        for id in self.groups.groups[group].nets.clone() {
            let (Op::Stack { .. } | Op::Broadcast { .. }) = self.module.node(id).op else { continue };
            let (words, ports) = (self.table(id), self.ports_of_row(id));
            if words.is_none() && ports.is_none() {
                continue;
            }
            let names = &self.lanes.groups[group];
            let name = self.taken.fresh(&format!("{}_{}", names.label, self.name(id)));
            out.extend(words.iter().flat_map(|words| table_text(&name, words)));
            out.extend(ports.map(|ports| {
                let range = range(self.module.width(id) * ports.len() as u32);
                format!("wire {range}{name} = {{{}}};", wrapped(&ports, 8).replace('\n', "\n    "))
            }));
            self.lanes.groups[group].tables.insert(id, name);
        }
        out
    }

    /// The plain ports that a row consists of, the last first. Nets are not read like this: side by side, chains of
    /// lanes look like loops.
    fn ports_of_row(&mut self, id: NodeId) -> Option<Vec<String>> {
        let Op::Stack { parts, axis: 0 } = &self.module.node(id).op else { return None };
        let is_port =
            |part: &NodeId| matches!(self.module.node(*part), Node { op: Op::Input(_), shape: Shape::Plain, .. });
        let is_row = matches!(self.module.shape(id), Shape::Row(_)) && parts.iter().all(is_port);
        is_row.then(|| parts.iter().rev().map(|&part| self.value(part)).collect())
    }

    /// The contents of one lane.
    fn scope(&mut self, group: usize) -> Vec<String> {
        let own = &self.groups.groups[group];
        let (nets, registers, memories) = (own.nets.clone(), own.registers.clone(), own.memories.clone());
        let (instances, properties) = (own.instances.clone(), own.properties.clone());
        let (early, ahead) = (own.early.clone(), own.ahead.clone());
        let mut out = Vec::new();
        let outputs = instances.iter().flat_map(|&index| self.module.instances[index].outputs.clone());
        let declared = registers.iter().map(|&register| self.module.registers[register].node);
        let declared = outputs.chain(declared).chain(nets.iter().copied().filter(|id| early.contains(id)));
        let declared: Vec<NodeId> = declared.filter(|id| !ahead.contains(id)).collect();
        out.extend(declared.into_iter().map(|id| self.declaration(id)));
        for &memory in &memories {
            let id = MemoryId(memory as u32);
            out.extend(self.memory_declaration(id));
            out.extend(self.data_ahead(id, &ahead));
            out.extend(self.lane_contents(id));
        }
        for id in nets {
            let declare = !early.contains(&id) && !ahead.contains(&id);
            out.extend(self.lane_net(id, declare));
        }
        for index in instances {
            out.push(String::new());
            out.extend(self.lane_instance(group, InstanceId(index as u32)));
        }
        let mut blocks = Vec::new();
        for memory in memories {
            blocks.extend(self.memory_blocks(MemoryId(memory as u32)));
        }
        blocks.extend(self.register_blocks(&registers));
        while blocks.last().is_some_and(String::is_empty) {
            blocks.pop();
        }
        if !blocks.is_empty() && !out.is_empty() {
            out.push(String::new());
        }
        out.extend(blocks);
        out.extend(self.properties(&properties));
        out.push(format!("{UNREAD} {group}"));
        out
    }

    /// Read data is beside its memory, and also in a net if it is read before its group.
    fn data_ahead(&self, id: MemoryId, ahead: &BTreeSet<NodeId>) -> Vec<String> {
        let memory = &self.module.memories[id.0 as usize];
        let reads = memory.reads.iter().zip(&self.reads[id.0 as usize]);
        let reads = reads.filter_map(|(read, names)| Some((read.node, names.as_ref()?)));
        let reads = reads.filter(|(node, _)| ahead.contains(node));
        reads.map(|(node, names)| format!("assign {} = {};", self.place_name(node), names.data)).collect()
    }

    /// The declaration of a net or register, without its value.
    fn declaration(&self, id: NodeId) -> String {
        let is_variable = self.is_variable(id);
        let mark = self.attributes(id);
        let kind = if is_variable { "reg" } else { "wire" };
        format!("{mark}{kind} {}{};", range(self.module.width(id)), self.name(id))
    }

    /// A net of a lane.
    fn lane_net(&mut self, id: NodeId, declare: bool) -> Vec<String> {
        let name = self.name(id).to_string();
        // Seen from here, also if it is declared ahead.
        let target = self.target(id);
        let (width, is_net) = (self.module.width(id), self.plan.form(id) != Form::Constants);
        let mut out = if declare && is_net { vec![self.declaration(id)] } else { Vec::new() };
        let formula = match self.module.node(id).op {
            Op::Stack { .. } | Op::Broadcast { .. } => self.formula(id),
            _ => None,
        };
        match self.module.node(id).op.clone() {
            Op::Stack { .. } | Op::Broadcast { .. } if formula.is_some() => {
                let formula = formula.expect("just seen");
                match is_net {
                    false => out.push(format!("localparam [31:0] {name} = {formula};")),
                    true => {
                        let constant = self.label(&format!("{name}_value"));
                        out.push(format!("localparam [31:0] {constant} = {formula};"));
                        out.push(format!("assign {target} = {};", super::part::formula_value(&constant, width)));
                    }
                }
            }
            Op::Stack { .. } | Op::Broadcast { .. } if self.is_table(id) => {
                let value = self.constant_lane(id);
                match out.pop() {
                    Some(declaration) => out.push(format!("{} = {value};", declaration.trim_end_matches(';'))),
                    None if is_net => out.push(format!("assign {target} = {value};")),
                    None => {}
                }
            }
            Op::Stack { parts, axis } => {
                let at = self.at_without(axis);
                let values = parts.iter().map(|&part| self.at(at.clone(), |printer| printer.value(part))).collect();
                let i = self.at[axis as usize].text.clone();
                out.extend(self.lane_cases(&i, &name, &target, values));
            }
            Op::Interleave { parts, axis } => {
                let count = parts.len() as u32;
                let at = self.at_instead(axis, self.at[axis as usize].shared(count));
                let values = parts.iter().map(|&part| self.at(at.clone(), |printer| printer.value(part))).collect();
                let i = format!("{} % {count}", self.at[axis as usize].text);
                out.extend(self.lane_cases(&i, &name, &target, values));
            }
            Op::Map { of, axis, index, edge: Some(edge) } => {
                out.extend(self.link(id, &target, of, (axis, index), edge));
            }
            Op::Reduce { by, of, axis } => out.extend(self.reduction(id, &target, by, of, axis)),
            Op::Pick { of, axis, index } => out.extend(self.pick(id, &target, of, axis, index)),
            Op::Pack { of, axis } => out.extend(self.pack(&target, width, of, axis, id)),
            _ if self.plan.form(id) == Form::Block => {
                let target = Target { name: target, assign: "=", hold: None, states: self.states.of(id), now: None };
                let body = self.statements(id, &target);
                out.push("always @* begin".to_string());
                out.extend(lines(&body, 1));
                out.push("end".to_string());
            }
            _ => {
                let value = self.state_or_expression(id);
                match out.pop() {
                    Some(declaration) => out.push(format!("{} = {value};", declaration.trim_end_matches(';'))),
                    None => out.push(format!("assign {target} = {value};")),
                }
            }
        }
        out
    }

    fn is_table(&self, id: NodeId) -> bool {
        let home = self.groups.home(id).expect("a net of a lane is in a group");
        self.lanes.groups[home].tables.contains_key(&id)
    }

    /// The value of another lane, or the edge if there is none.
    fn link(&mut self, id: NodeId, target: &str, of: NodeId, (axis, rule): (u32, Affine), edge: NodeId) -> Vec<String> {
        let name = self.name(id).to_string();
        let (extent, inner) = (self.module.shape(id).extent(axis), self.module.shape(of).extent(axis));
        let index = self.at[axis as usize].clone();
        let inside: Vec<u32> = (0..extent).filter(|&lane| rule.source(lane, inner).is_some()).collect();
        let (first, last) = (inside[0], inside[inside.len() - 1]);
        let below = (first > 0).then(|| format!("{} < {first}", index.text));
        let above = (last + 1 < extent).then(|| format!("{} >= {}", index.text, last + 1));
        let beyond: Vec<String> = below.into_iter().chain(above).collect();
        let value = self.at(self.at_without(axis), |printer| printer.value(edge));
        let there = index.only(inside).mapped(rule, extent, inner);
        let linked = self.at(self.at_instead(axis, there), |printer| printer.value(of));
        let [at_edge, link] = ["edge", "link"].map(|side| self.label(&format!("{name}_{side}")));
        vec![
            format!("if ({}) begin : {at_edge}", beyond.join(" || ")),
            format!("    assign {target} = {value};"),
            format!("end else begin : {link}"),
            format!("    assign {target} = {linked};"),
            "end".to_string(),
        ]
    }

    /// A value that differs between lanes without a rule.
    fn lane_cases(&mut self, i: &str, name: &str, target: &str, values: Vec<String>) -> Vec<String> {
        let mut out = vec![format!("case ({i})")];
        let last = values.len() - 1;
        for (lane, value) in values.into_iter().enumerate() {
            let label = if lane < last { lane.to_string() } else { "default".to_string() };
            let block = self.label(&format!("{name}_{lane}"));
            out.push(format!("    {label}: begin : {block} assign {target} = {value}; end"));
        }
        out.push("endcase".to_string());
        out
    }

    /// The name of a net as the target of an assignment.
    pub fn target(&self, id: NodeId) -> String {
        match self.groups.home(id) {
            Some(_) => self.place_name(id),
            None => self.name(id).to_string(),
        }
    }

    /// A label in the current scope, or in the module.
    pub fn label(&mut self, wanted: &str) -> String {
        match self.here {
            Some(group) => self.taken.fresh_in(&mut self.lanes.groups[group].scope, LANE, wanted),
            None => self.taken.fresh(wanted),
        }
    }

    /// Like [`Self::label`], for a loop whose lanes are read through the label.
    pub fn loop_label(&mut self, wanted: &str) -> String {
        match self.here {
            Some(group) => self.taken.fresh_label_in(&mut self.lanes.groups[group].scope, LANE, wanted),
            None => self.taken.fresh_label(wanted),
        }
    }

    /// Names for a block in the current scope, none of which hides another: linters reject that.
    pub fn local<const N: usize>(&mut self, prefix: &str, wanted: [&str; N]) -> [String; N] {
        let scope = self.here.map(|group| &mut self.lanes.groups[group].scope);
        self.taken.local_in(scope, prefix, wanted)
    }

    fn lane_instance(&mut self, group: usize, id: InstanceId) -> Vec<String> {
        let instance = &self.module.instances[id.0 as usize];
        let child = self.design.module(instance.module);
        let connections = self.connections(instance, |printer, output| printer.target(output));
        instantiate(child, &self.lanes.groups[group].instances[&(id.0 as usize)], (&connections, Vec::new()), None)
    }

    /// Ties off the bits that no reader uses in some lane; these are known only after everything else is printed.
    pub fn tie_lanes(&mut self, group: usize) -> Option<String> {
        let own = &self.groups.groups[group];
        let outputs = own.instances.iter().flat_map(|&index| self.module.instances[index].outputs.clone());
        let registers = own.registers.iter().map(|&register| self.module.registers[register].node);
        let nets = own.nets.iter().copied().filter(|&id| self.plan.is_net(id));
        let reads = own.memories.iter().flat_map(|&memory| &self.module.memories[memory].reads);
        let reads = reads.filter(|read| read.clock.is_some()).map(|read| read.node);
        let all: Vec<NodeId> = outputs.chain(registers).chain(reads).chain(nets).collect();
        let memories = own.memories.iter().map(|&memory| &self.module.memories[memory].name);
        let memories = memories.filter(|name| !self.usage.memories.contains(*name)).map(|name| format!("{name}[0]"));
        let memories: Vec<String> = memories.collect();
        let genvars = self.lanes.genvars.iter().take(own.shape.axes() as usize).map(|genvar| Index::all(genvar));
        let at: Vec<Index> = genvars.collect();
        self.here = Some(group);
        let mut items = self.at(at, |printer| {
            let unread = |id: NodeId| printer.unread_parts(id, &printer.target(id));
            all.into_iter().flat_map(unread).collect::<Vec<_>>()
        });
        items.extend(memories);
        let text = (!items.is_empty())
            .then(|| format!("wire {} = &{{1'b0, {}}};", self.label("_unused_lane"), items.join(", ")));
        self.here = None;
        text
    }
}

/// A placeholder at the end of a group's scope for the result of [`Printer::tie_lanes`]; the group's number follows.
pub const UNREAD: &str = "// unread";

/// A loop or choice within a `generate`.
pub fn block(head: String, body: Vec<String>) -> Vec<String> {
    let indent = |line: String| if line.is_empty() { line } else { format!("    {line}") };
    [head].into_iter().chain(body.into_iter().map(indent)).chain(["end".to_string()]).collect()
}

/// Lane 0 is in the lowest bits.
fn table_text(name: &str, words: &[Bits]) -> Vec<String> {
    let width: u32 = words.iter().map(Bits::width).sum();
    let words: Vec<String> = words.iter().rev().map(|word| literal(word, Style::Pattern)).collect();
    vec![
        format!("localparam [{}:0] {name} = {{", width - 1),
        format!("    {}", wrapped(&words, 4).replace('\n', "\n    ")),
        "};".to_string(),
    ]
}
