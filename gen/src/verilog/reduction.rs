//! The combination of all lanes of an array's output: a reduction of a vector, or a balanced tree.

use super::layout::{generate, range, with_place};
use super::printer::Printer;
use super::scope::Scope;
use tilewright_hdl::ir::{NodeId, Reduction};

impl Printer<'_> {
    /// The net that combines all lanes of an output.
    pub fn reduction(&mut self, id: NodeId, reduction: Reduction, of: NodeId) -> Vec<String> {
        let node = self.module.node(id);
        let (array, port) = self.array_output(of);
        let lanes = self.module.node(of).shape.lanes();
        for lane in 0..lanes {
            self.read_lane(of, lane);
        }
        let operator = match reduction {
            Reduction::And => "&",
            Reduction::Or => "|",
            Reduction::Xor => "^",
            Reduction::Add => "+",
            Reduction::Min | Reduction::Max => unreachable!("the language does not make these yet"),
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
        let mut scope = Scope::default();
        let mut local = |wanted| self.taken.fresh_in(&mut scope, "tree", wanted);
        let (value, at_leaf, pair) = (local("value"), local("leaf"), local("pair"));
        let body = vec![
            format!("wire {}{value};", range(node.width)),
            format!("if ({i} < {lanes}) begin : {at_leaf}"),
            format!("    assign {value} = {leaf};"),
            format!("end else begin : {pair}"),
            format!("    assign {value} = {tree}[{left}].{value} {operator} {tree}[{right}].{value};"),
            "end".to_string(),
        ];
        let mut out = generate(head, body);
        out.push(with_place(format!("assign {name} = {tree}[{}].{value};", 2 * lanes - 2), node.loc));
        out
    }
}
