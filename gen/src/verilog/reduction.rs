//! The combination of all lanes along an axis: a reduction of a vector, or a balanced tree; and lanes side by side.

use super::group::block;
use super::layout::{generate, range, with_place};
use super::part::Index;
use super::plan::Form;
use super::printer::Printer;
use tilewright_circuit::ir::{NodeId, Op, Reduction};

impl Printer<'_> {
    /// Combines all lanes of a value; `target` is the net that takes it.
    pub fn reduction(&mut self, id: NodeId, target: &str, by: Reduction, of: NodeId, axis: u32) -> Vec<String> {
        let node = self.module.node(id);
        let lanes = self.module.shape(of).extent(axis);
        let name = self.name(id).to_string();
        let depth = self.at.len();
        let i = self.loop_variable(depth);
        let leaf = self.at(self.at_with(axis, Index::all(&i)), |printer| printer.value(of));
        if node.width == 1 {
            let operator = match by {
                Reduction::And | Reduction::Min => "&",
                Reduction::Or | Reduction::Max => "|",
                Reduction::Xor | Reduction::Add => "^",
            };
            let (vector, scope) = (self.label(&format!("{name}_lanes")), self.label(&format!("{name}_of")));
            let head = format!("{} begin : {scope}", self.for_lanes(depth, lanes));
            let mut out = vec![format!("wire [{}:0] {vector};", lanes - 1)];
            out.extend(self.generated(head, vec![format!("assign {vector}[{i}] = {leaf};")]));
            out.push(self.placed(format!("assign {target} = {operator}{vector};"), id));
            return out;
        }
        let tree = self.loop_label(&format!("{name}_tree"));
        let head = format!("{} begin : {tree}", self.for_lanes(depth, 2 * lanes - 1));
        let (left, right) = (format!("2 * ({i} - {lanes})"), format!("2 * ({i} - {lanes}) + 1"));
        let [value, at_leaf, pair] = self.local("tree", ["value", "leaf", "pair"]);
        let (left, right) = (format!("{tree}[{left}].{value}"), format!("{tree}[{right}].{value}"));
        let range = range(node.width);
        let mut body = vec![
            format!("wire {range}{value};"),
            format!("if ({i} < {lanes}) begin : {at_leaf}"),
            format!("    assign {value} = {leaf};"),
            format!("end else begin : {pair}"),
        ];
        match operator(by) {
            Some(operator) => body.push(format!("    assign {value} = {left} {operator} {right};")),
            None => {
                let [a, b] = self.local("tree", ["a", "b"]);
                let relation = if by == Reduction::Min { "<" } else { ">" };
                body.push(format!("    wire {range}{a} = {left};"));
                body.push(format!("    wire {range}{b} = {right};"));
                body.push(format!("    assign {value} = ({a} {relation} {b}) ? {a} : {b};"));
            }
        }
        body.push("end".to_string());
        let mut out = self.generated(head, body);
        out.push(self.placed(format!("assign {target} = {tree}[{}].{value};", 2 * lanes - 2), id));
        out
    }

    /// The lanes side by side, each of `of`'s width, in the vector `target` of `width` bits.
    pub fn pack(&mut self, target: &str, width: u32, of: NodeId, axis: u32, id: NodeId) -> Vec<String> {
        let name = self.name(id).to_string();
        let depth = self.at.len();
        let (i, lanes) = (self.loop_variable(depth), self.module.shape(of).extent(axis));
        let (at, scope) = (self.at_with(axis, Index::all(&i)), self.label(&format!("{name}_of")));
        let head = format!("{} begin : {scope}", self.for_lanes(depth, lanes));
        let apart = width / lanes;
        // Rows side by side of columns side by side are one vector.
        if let Op::Pack { of: inner, axis: second } = self.module.node(of).op
            && self.plan.form(of) == Form::Inline
        {
            let j = self.loop_variable(depth + 1);
            let columns = self.module.shape(inner).extent(second);
            let value = self.at(at, |printer| {
                let at = printer.at_with(second, Index::all(&j));
                printer.at(at, |printer| printer.value(inner))
            });
            let inner_scope = self.label(&format!("{name}_col"));
            let inner_head = format!("{} begin : {inner_scope}", self.for_lanes(depth + 1, columns));
            let to = match apart / columns {
                1 => format!("{target}[{i} * {columns} + {j}]"),
                width => format!("{target}[({i} * {columns} + {j}) * {width} +: {width}]"),
            };
            return self.generated(head, block(inner_head, vec![format!("assign {to} = {value};")]));
        }
        let value = self.at(at, |printer| printer.value(of));
        let to = match apart {
            1 => format!("{target}[{i}]"),
            width => format!("{target}[{i} * {width} +: {width}]"),
        };
        self.generated(head, vec![format!("assign {to} = {value};")])
    }

    /// A loop; `generate` is added around it if it is not in one already.
    pub fn generated(&self, head: String, body: Vec<String>) -> Vec<String> {
        if self.here.is_some() { block(head, body) } else { generate(head, body) }
    }

    /// The line with the node's source place, if the node belongs to the module and not to each lane.
    pub fn placed(&self, line: String, id: NodeId) -> String {
        if self.here.is_some() { line } else { with_place(line, self.module.node(id).loc) }
    }
}

/// The operator between two lanes; `None` for the minimum and the maximum, which are compared.
fn operator(by: Reduction) -> Option<&'static str> {
    match by {
        Reduction::And => Some("&"),
        Reduction::Or => Some("|"),
        Reduction::Xor => Some("^"),
        Reduction::Add => Some("+"),
        Reduction::Min | Reduction::Max => None,
    }
}
