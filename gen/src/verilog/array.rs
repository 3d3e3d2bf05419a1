//! Instance arrays: a `generate for` whose scopes are the lanes, each with the instance `lane` and the nets of its own.
//!
//! A link to a neighbour names the net in the neighbour's scope, `u_cell[i - 1].out`. So every net belongs to one lane,
//! and no tool sees a combinational loop where the lanes only form a chain.

use super::layout::{connect, generate, range, with_place, wrapped};
use super::literal::{Style, literal};
use super::pattern::Pattern;
use super::printer::Printer;
use super::scope::LANE;
use tilewright_hdl::Bits;
use tilewright_hdl::ir::{Instance, InstanceId, NodeId, Op};

/// A table of constants wider than this is given lane by lane: tools limit the width of a vector.
const WIDEST_TABLE: u64 = 65_536;

impl Printer<'_> {
    /// One array.
    pub fn array(&mut self, id: InstanceId, instance: &Instance, lanes: u32) -> Vec<String> {
        let child = self.design.module(instance.module);
        let mut body = Vec::new();
        for (port, output) in child.outputs.iter().enumerate() {
            body.push(format!("wire {}{};", range(child.width(output.node)), self.lane_port(id, port as u32)));
        }
        let mut out = Vec::new();
        for (node, name) in self.lane_names(id).local.clone() {
            match self.table(node) {
                Some(words) => {
                    let table = self.taken.fresh(&format!("{}_{name}", instance.name));
                    out.extend(table_text(&table, &words));
                    let names = self.arrays.arrays.get_mut(&id).expect("every array has names");
                    names.tables.insert(node, table);
                }
                None => body.extend(self.local_value(id, node, &name)),
            }
        }
        let mut connections = self.clock_connections(instance, child);
        for (port, &input) in child.inputs.iter().zip(&instance.inputs) {
            let value = self.lane_input(id, input);
            connections.push((port.name.clone(), value));
        }
        for (port, output) in child.outputs.iter().enumerate() {
            connections.push((output.name.clone(), self.lane_port(id, port as u32).to_string()));
        }
        body.push(String::new());
        body.extend(connect(&child.name, &self.lane_names(id).instance, &connections));
        body.push(UNREAD.to_string());
        let head = with_place(format!("{} begin : {}", self.for_lanes(lanes), instance.name), instance.loc);
        out.extend(generate(head, body));
        out
    }

    pub fn for_lanes(&self, lanes: u32) -> String {
        let i = &self.arrays.genvar;
        format!("for ({i} = 0; {i} < {lanes}; {i} = {i} + 1)")
    }

    /// What feeds an input of a lane.
    fn lane_input(&mut self, array: InstanceId, id: NodeId) -> String {
        match &self.module.node(id).op {
            Op::Broadcast { of, .. } => self.value(*of),
            Op::Stack { parts, .. } if self.pattern(parts).is_some() => {
                formula_value(&self.lane_names(array).local[&id], self.module.width(id))
            }
            Op::Stack { .. } if self.lane_names(array).tables.contains_key(&id) => {
                let (table, i) = (&self.lane_names(array).tables[&id], &self.arrays.genvar);
                match self.module.width(id) {
                    1 => format!("{table}[{i}]"),
                    width => format!("{table}[{i} * {width} +: {width}]"),
                }
            }
            _ => self.lane_value(array, id, 0),
        }
    }

    /// The value of lane `i - by` in the scope of lane `i`.
    fn lane_value(&mut self, array: InstanceId, id: NodeId, by: i32) -> String {
        let (home, net) = match self.module.node(id).op {
            Op::Output(home, port) => {
                self.read_lanes_behind(id, by);
                (home, self.lane_port(home, port).to_string())
            }
            _ => (array, self.lane_names(array).local[&id].clone()),
        };
        let (i, scope) = (&self.arrays.genvar, &self.module.instances[home.0 as usize].name);
        match by {
            0 if home == array => net,
            0 => format!("{scope}[{i}].{net}"),
            by if by > 0 => format!("{scope}[{i} - {by}].{net}"),
            by => format!("{scope}[{i} + {}].{net}", -by),
        }
    }

    /// Notes that the lanes that have one `by` lanes ahead are read by it.
    fn read_lanes_behind(&mut self, id: NodeId, by: i32) {
        let lanes = self.module.node(id).shape.lanes();
        for lane in 0..lanes {
            let reader = i64::from(lane) + i64::from(by);
            if (0..i64::from(lanes)).contains(&reader) {
                self.read_lane(id, lane);
            }
        }
    }

    /// The declaration of a value that is made in a lane's scope.
    fn local_value(&mut self, array: InstanceId, id: NodeId, name: &str) -> Vec<String> {
        let module = self.module;
        let node = module.node(id);
        let (i, range) = (self.arrays.genvar.clone(), range(node.width));
        match &node.op {
            Op::Map { of, index, edge: Some(edge), .. } => {
                let by = -index.add;
                let lanes = node.shape.lanes();
                let at_edge = match by {
                    by if by > 0 => format!("{i} < {by}"),
                    by => format!("{i} >= {}", i64::from(lanes) + i64::from(by)),
                };
                let [at_edge_label, link_label] =
                    ["edge", "link"].map(|side| self.label(array, &format!("{name}_{side}")));
                vec![
                    format!("wire {range}{name};"),
                    format!("if ({at_edge}) begin : {at_edge_label}"),
                    format!("    assign {name} = {};", self.value(*edge)),
                    format!("end else begin : {link_label}"),
                    format!("    assign {name} = {};", self.lane_value(array, *of, by)),
                    "end".to_string(),
                ]
            }
            Op::Stack { parts, .. } => match self.pattern(parts) {
                Some(pattern) => vec![format!("localparam [31:0] {name} = {};", pattern.text(&i))],
                None => self.lane_cases(array, parts, name, &range),
            },
            _ => unreachable!("only shifted and per-lane values are made in a lane's scope"),
        }
    }

    /// A label in a lane's scope.
    fn label(&mut self, array: InstanceId, wanted: &str) -> String {
        let names = self.arrays.arrays.get_mut(&array).expect("every array has names");
        self.taken.fresh_in(&mut names.scope, LANE, wanted)
    }

    /// A value that differs between lanes without a rule.
    fn lane_cases(&mut self, array: InstanceId, parts: &[NodeId], name: &str, range: &str) -> Vec<String> {
        let mut out = vec![format!("wire {range}{name};"), format!("case ({})", self.arrays.genvar)];
        for (lane, &part) in parts.iter().enumerate() {
            let label = if lane + 1 < parts.len() { lane.to_string() } else { "default".to_string() };
            let (value, block) = (self.value(part), self.label(array, &format!("{name}_{lane}")));
            out.push(format!("    {label}: begin : {block} assign {name} = {value}; end"));
        }
        out.push("endcase".to_string());
        out
    }

    fn constants(&self, parts: &[NodeId]) -> Option<Vec<Bits>> {
        let value = |&part: &NodeId| match &self.module.node(part).op {
            Op::Const(value) => Some(value.clone()),
            _ => None,
        };
        parts.iter().map(value).collect()
    }

    /// The words of a table, for constants that follow no rule.
    fn table(&self, id: NodeId) -> Option<Vec<Bits>> {
        let node = self.module.node(id);
        let Op::Stack { parts, .. } = &node.op else { return None };
        let words = self.constants(parts).filter(|words| words.len() as u64 * u64::from(node.width) <= WIDEST_TABLE)?;
        Pattern::of(&words).is_none().then_some(words)
    }

    fn pattern(&self, parts: &[NodeId]) -> Option<Pattern> {
        Pattern::of(&self.constants(parts)?)
    }

    /// Ties the lane outputs that some lane's reader lacks; known only when all else is printed.
    pub fn tie_lanes(&mut self, array: InstanceId) -> Option<String> {
        let instance = &self.module.instances[array.0 as usize];
        let is_read = |id: NodeId| self.usage.lanes.get(&id).is_some_and(|lanes| lanes.iter().all(|&read| read));
        let unread = instance.outputs.iter().enumerate().filter(|&(_, &id)| !is_read(id));
        let nets: Vec<String> = unread.map(|(port, _)| self.lane_port(array, port as u32).to_string()).collect();
        (!nets.is_empty())
            .then(|| format!("wire {} = &{{1'b0, {}}};", self.label(array, "_unused_lane"), nets.join(", ")))
    }
}

/// Stands in an array's text for what [`Printer::tie_lanes`] says in the end.
pub const UNREAD: &str = "// unread";

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

/// The bits in use of a formula's 32.
fn formula_value(name: &str, width: u32) -> String {
    match width {
        1 => format!("{name}[0]"),
        32 => name.to_string(),
        width if width < 32 => format!("{name}[{}:0]", width - 1),
        width => format!("{{{}'d0, {name}}}", width - 32),
    }
}
