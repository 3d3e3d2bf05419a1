//! The nets of a module, each after those it reads.
//!
//! A net that reads lanes is declared before the groups of lanes and assigned after them.

use super::branches::Target;
use super::layout::{range, with_place};
use super::literal::Style;
use super::order::{for_each_read, operands_first};
use super::plan::Form;
use super::printer::Printer;
use super::statement::lines;
use tilewright_circuit::ir::{NodeId, Op};

/// The text of the nets.
#[derive(Default)]
pub struct Nets {
    /// The text before the groups of lanes.
    pub before: Vec<String>,
    /// The text after them.
    pub after: Vec<String>,
}

impl Printer<'_> {
    pub fn nets(&mut self) -> Nets {
        let module = self.module;
        let nets: Vec<NodeId> = self.net_order();
        let mut out = Nets::default();
        let (late, early): (Vec<NodeId>, Vec<NodeId>) = nets.into_iter().partition(|&id| self.reads_lanes(id));
        for &id in &late {
            if !self.is_port(id) {
                let kind = if self.plan.form(id) == Form::Block { "reg" } else { "wire" };
                let declaration = format!("{kind} {}{};", range(module.width(id)), self.name(id));
                out.before.push(with_place(declaration, module.node(id).loc));
            }
        }
        for &id in &early {
            let text = self.net(id, true);
            out.before.extend(text);
        }
        for &id in &late {
            let name = self.name(id).to_string();
            let text = match module.node(id).op {
                Op::Reduce { by, of, axis } => self.reduction(id, &name, by, of, axis),
                Op::Pick { of, axis, index } => self.pick(id, &name, of, axis, index),
                Op::Pack { of, axis } => self.pack(&name, module.width(id), of, axis, id),
                _ => self.net(id, false),
            };
            out.after.extend(text);
        }
        out
    }

    fn net_order(&self) -> Vec<NodeId> {
        operands_first(self.module)
            .into_iter()
            .filter(|&id| self.plan.is_net(id) && self.module.shape(id).is_plain())
            .collect()
    }

    /// Whether the text of a net mentions lanes.
    fn reads_lanes(&self, id: NodeId) -> bool {
        let mut stack = vec![id];
        while let Some(next) = stack.pop() {
            match &self.module.node(next).op {
                _ if !self.module.shape(next).is_plain() => return true,
                Op::Lane { .. } => return true,
                _ if next == id || matches!(self.plan.form(next), Form::Inline | Form::Branches) => {
                    for_each_read(self.module, next, |operand| stack.push(operand));
                }
                _ => {}
            }
        }
        false
    }

    fn net(&mut self, id: NodeId, declare: bool) -> Vec<String> {
        let node = self.module.node(id);
        let (name, range) = (self.name(id).to_string(), range(node.width));
        let declare = declare && !self.is_port(id);
        if self.plan.form(id) != Form::Block {
            let head = if declare { format!("wire {range}{name}") } else { format!("assign {name}") };
            let value = self.state_or_expression(id);
            return vec![with_place(format!("{head} = {value};"), node.loc)];
        }
        let mut out = Vec::new();
        if declare {
            out.push(with_place(format!("reg {range}{name};"), node.loc));
        }
        let target = Target { name, assign: "=", hold: None, states: self.states.of(id), now: None };
        let body = self.statements(id, &target);
        out.push("always @* begin".to_string());
        out.extend(lines(&body, 1));
        out.push("end".to_string());
        out
    }

    pub fn state_or_expression(&mut self, id: NodeId) -> String {
        if let Op::Wire(to) = self.module.node(id).op
            && let Some(state) = self.state_text(to, self.states.of(id))
        {
            return state;
        }
        self.expression(id, Style::Count)
    }
}
