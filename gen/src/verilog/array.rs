//! Instance arrays: a `generate for` whose scopes are the lanes, each with the instance `lane` and the nets of its own.
//!
//! A link to a neighbour names the net in the neighbour's scope, `u_cell[i - 1].out`. So every net belongs to one lane,
//! and no tool sees a combinational loop where the lanes only form a chain.

use super::expression::Printer;
use super::instance::connect;
use super::layout::{range, with_place, wrapped};
use super::literal::{Style, literal};
use super::names::Taken;
use super::pattern::Pattern;
use std::collections::BTreeMap;
use tilewright_hdl::Bits;
use tilewright_hdl::ir::{Design, Instance, InstanceId, Module, NodeId, Op, Reduction};

/// A table of constants wider than this is given lane by lane: tools limit the width of a vector.
const WIDEST_TABLE: u64 = 65_536;

/// The names that arrays need.
pub struct ArrayNames {
    /// The loop variable of every array of the module.
    genvar: String,
    /// For each instance the nets of a lane's outputs, empty for a plain instance.
    outputs: Vec<Vec<String>>,
    /// A net of the module that is called `lane`, and what it is called inside of arrays, where `lane` is the instance.
    hidden: Option<(NodeId, String)>,
    /// For each array, the nets of the values that are made in its lanes.
    local: BTreeMap<(InstanceId, NodeId), String>,
    /// For each array, the tables of constants of its lanes; declared outside of the lanes, or every lane has a copy.
    tables: BTreeMap<(InstanceId, NodeId), String>,
}

impl ArrayNames {
    pub fn new(design: &Design, module: &Module, taken: &mut Taken) -> ArrayNames {
        let arrays = || module.instances.iter().enumerate().filter(|(_, instance)| instance.lanes.is_some());
        let free = ["i", "j", "k", "n"].into_iter().find(|name| !taken.contains(name)).unwrap_or("lane_index");
        let genvar = if arrays().next().is_some() { taken.fresh(free) } else { String::new() };
        let hidden = module.nodes.iter().position(|node| node.name.as_deref() == Some("lane") && node.lanes.is_none());
        let hidden = hidden.filter(|_| !genvar.is_empty()).map(|id| (NodeId(id as u32), taken.fresh("lane_value")));
        let outputs = vec![Vec::new(); module.instances.len()];
        let mut names = ArrayNames { genvar, outputs, hidden, local: BTreeMap::new(), tables: BTreeMap::new() };
        for (index, instance) in arrays() {
            let array = InstanceId(index as u32);
            let mut scope = Scope { taken, used: vec!["lane".to_string()] };
            let child = design.module(instance.module);
            names.outputs[index] = child.outputs.iter().map(|port| scope.name(&port.name)).collect();
            for (port, &input) in child.inputs.iter().zip(&instance.inputs) {
                let mut next = Some(input);
                while let Some(id) = next.filter(|&id| !names.local.contains_key(&(array, id))) {
                    let (made_here, operand) = match module.node(id).op {
                        Op::Shifted { of, .. } => (true, Some(of)),
                        Op::PerLane(_) => (true, None),
                        _ => (false, None),
                    };
                    if made_here {
                        names.local.insert((array, id), scope.name(&port.name));
                    }
                    next = operand;
                }
            }
        }
        names
    }
}

/// The names of one lane's scope; they hide no name of the module.
struct Scope<'a> {
    taken: &'a Taken,
    used: Vec<String>,
}

impl Scope<'_> {
    fn name(&mut self, wanted: &str) -> String {
        let numbered = (2..).map(|n| format!("lane_{wanted}_{n}"));
        let names = [wanted.to_string(), format!("lane_{wanted}")].into_iter().chain(numbered);
        let free = |name: &String| !self.used.contains(name) && !self.taken.contains(name);
        let name = { names }.find(free).expect("some number is free");
        self.used.push(name.clone());
        name
    }
}

impl Printer<'_> {
    /// The net of an output inside of a lane's scope.
    pub fn lane_port(&self, array: InstanceId, port: u32) -> &str {
        &self.arrays.outputs[array.0 as usize][port as usize]
    }

    /// The declarations that arrays need, of which this is the text.
    pub fn array_declarations(&self, arrays: &[String]) -> Vec<String> {
        let mut out = Vec::new();
        if let Some((id, alias)) = &self.arrays.hidden
            && arrays.iter().any(|line| line.contains(alias))
        {
            out.push(format!("wire {}{alias} = {};", range(self.module.width(*id)), self.name(*id)));
        }
        if !self.arrays.genvar.is_empty() {
            out.push(format!("genvar {};", self.arrays.genvar));
        }
        out
    }

    /// Calls a net named `lane` by its other name while a lane's scope is printed, and back.
    fn swap_hidden(&mut self) {
        if let Some((id, alias)) = &mut self.arrays.hidden {
            std::mem::swap(self.names[id.0 as usize].as_mut().expect("the net has a name"), alias);
        }
    }

    /// One array.
    pub fn array(&mut self, id: InstanceId, instance: &Instance, lanes: u32) -> Vec<String> {
        let child = self.design.module(instance.module);
        let mut body = Vec::new();
        for (port, output) in child.outputs.iter().enumerate() {
            body.push(format!("wire {}{};", range(child.width(output.node)), self.lane_port(id, port as u32)));
        }
        let local = self.arrays.local.range((id, NodeId(0))..=(id, NodeId(u32::MAX)));
        let local: Vec<(NodeId, String)> = local.map(|(&(_, node), name)| (node, name.clone())).collect();
        self.swap_hidden();
        let mut out = Vec::new();
        for (node, name) in local {
            match self.table(node) {
                Some(words) => {
                    let table = self.taken.fresh(&format!("{}_{name}", instance.name));
                    out.extend(table_text(&table, &words));
                    self.arrays.tables.insert((id, node), table);
                }
                None => body.extend(self.local_value(id, node, &name)),
            }
        }
        let mut connections = self.clock_connections(instance, child);
        for (port, &input) in child.inputs.iter().zip(&instance.inputs) {
            let value = self.lane_input(id, input);
            connections.push((port.name.clone(), value));
        }
        self.swap_hidden();
        for (port, output) in child.outputs.iter().enumerate() {
            connections.push((output.name.clone(), self.lane_port(id, port as u32).to_string()));
        }
        body.push(String::new());
        body.extend(connect(&child.name, "lane", &connections));
        body.push(UNREAD.to_string());
        let head = with_place(format!("{} begin : {}", self.for_lanes(lanes), instance.name), instance.loc);
        out.extend(generate(head, body));
        out
    }

    fn for_lanes(&self, lanes: u32) -> String {
        let i = &self.arrays.genvar;
        format!("for ({i} = 0; {i} < {lanes}; {i} = {i} + 1)")
    }

    /// What feeds an input of a lane.
    fn lane_input(&mut self, array: InstanceId, id: NodeId) -> String {
        match &self.module.node(id).op {
            Op::Broadcast(plain) => self.value(*plain),
            Op::PerLane(parts) if self.pattern(parts).is_some() => {
                formula_value(&self.arrays.local[&(array, id)], self.module.width(id))
            }
            Op::PerLane(_) if self.arrays.tables.contains_key(&(array, id)) => {
                let (table, i) = (&self.arrays.tables[&(array, id)], &self.arrays.genvar);
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
            _ => (array, self.arrays.local[&(array, id)].clone()),
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
        let lanes = self.module.node(id).lanes.expect("an array's output has lanes");
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
            Op::Shifted { of, by, edge } => {
                let lanes = node.lanes.expect("a shifted value has lanes");
                let at_edge = match *by {
                    by if by > 0 => format!("{i} < {by}"),
                    by => format!("{i} >= {}", i64::from(lanes) + i64::from(by)),
                };
                vec![
                    format!("wire {range}{name};"),
                    format!("if ({at_edge}) begin : {name}_edge"),
                    format!("    assign {name} = {};", self.value(*edge)),
                    format!("end else begin : {name}_link"),
                    format!("    assign {name} = {};", self.lane_value(array, *of, *by)),
                    "end".to_string(),
                ]
            }
            Op::PerLane(parts) => match self.pattern(parts) {
                Some(pattern) => vec![format!("localparam [31:0] {name} = {};", pattern.text(&i))],
                None => self.lane_cases(parts, name, &range),
            },
            _ => unreachable!("only shifted and per-lane values are made in a lane's scope"),
        }
    }

    /// A value that differs between lanes without a rule.
    fn lane_cases(&mut self, parts: &[NodeId], name: &str, range: &str) -> Vec<String> {
        let mut out = vec![format!("wire {range}{name};"), format!("case ({})", self.arrays.genvar)];
        for (lane, &part) in parts.iter().enumerate() {
            let label = if lane + 1 < parts.len() { lane.to_string() } else { "default".to_string() };
            let value = self.value(part);
            out.push(format!("    {label}: begin : {name}_{lane} assign {name} = {value}; end"));
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
        let Op::PerLane(parts) = &node.op else { return None };
        let words = self.constants(parts).filter(|words| words.len() as u64 * u64::from(node.width) <= WIDEST_TABLE)?;
        Pattern::of(&words).is_none().then_some(words)
    }

    fn pattern(&self, parts: &[NodeId]) -> Option<Pattern> {
        Pattern::of(&self.constants(parts)?)
    }

    /// The net that combines all lanes of an output.
    pub fn reduction(&mut self, id: NodeId, reduction: Reduction, of: NodeId) -> Vec<String> {
        let node = self.module.node(id);
        let (array, port) = self.array_output(of);
        let lanes = self.module.node(of).lanes.expect("a reduced value has lanes");
        for lane in 0..lanes {
            self.read_lane(of, lane);
        }
        let operator = match reduction {
            Reduction::And => "&",
            Reduction::Or => "|",
            Reduction::Xor => "^",
            Reduction::Add => "+",
        };
        let i = self.arrays.genvar.clone();
        let leaf = format!("{}[{i}].{}", self.module.instances[array.0 as usize].name, self.lane_port(array, port));
        let name = self.name(id).to_string();
        if node.width == 1 {
            let operator = if reduction == Reduction::Add { "^" } else { operator };
            let (vector, scope) = (self.taken.fresh(&format!("{name}_lanes")), self.taken.fresh(&format!("{name}_of")));
            let head = format!("{} begin : {scope}", self.for_lanes(lanes));
            let mut out = vec![format!("wire [{}:0] {vector};", lanes - 1)];
            out.extend(generate(head, vec![format!("assign {vector}[{i}] = {leaf};")]));
            out.push(with_place(format!("assign {name} = {operator}{vector};"), node.loc));
            return out;
        }
        let tree = self.taken.fresh(&format!("{name}_tree"));
        let head = format!("{} begin : {tree}", self.for_lanes(2 * lanes - 1));
        let (left, right) = (format!("2 * ({i} - {lanes})"), format!("2 * ({i} - {lanes}) + 1"));
        let body = vec![
            format!("wire {}value;", range(node.width)),
            format!("if ({i} < {lanes}) begin : leaf"),
            format!("    assign value = {leaf};"),
            "end else begin : pair".to_string(),
            format!("    assign value = {tree}[{left}].value {operator} {tree}[{right}].value;"),
            "end".to_string(),
        ];
        let mut out = generate(head, body);
        out.push(with_place(format!("assign {name} = {tree}[{}].value;", 2 * lanes - 2), node.loc));
        out
    }

    /// Ties the lane outputs that some lane's reader lacks; known only when all else is printed.
    pub fn tie_lanes(&self, array: InstanceId) -> Option<String> {
        let instance = &self.module.instances[array.0 as usize];
        let is_read = |id: NodeId| self.lanes_read.get(&id).is_some_and(|lanes| lanes.iter().all(|&read| read));
        let unread = instance.outputs.iter().enumerate().filter(|&(_, &id)| !is_read(id));
        let nets: Vec<String> = unread.map(|(port, _)| self.lane_port(array, port as u32).to_string()).collect();
        (!nets.is_empty()).then(|| format!("wire _unused_lane = &{{1'b0, {}}};", nets.join(", ")))
    }
}

/// Stands in an array's text for what [`Printer::tie_lanes`] says in the end.
pub const UNREAD: &str = "// unread";

fn generate(head: String, body: Vec<String>) -> Vec<String> {
    let mut out = vec!["generate".to_string(), format!("    {head}")];
    let indent = |line: String| if line.is_empty() { line } else { format!("        {line}") };
    out.extend(body.into_iter().map(indent));
    out.extend(["    end".to_string(), "endgenerate".to_string()]);
    out
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

/// The bits in use of a formula's 32.
fn formula_value(name: &str, width: u32) -> String {
    match width {
        1 => format!("{name}[0]"),
        32 => name.to_string(),
        width if width < 32 => format!("{name}[{}:0]", width - 1),
        width => format!("{{{}'d0, {name}}}", width - 32),
    }
}
