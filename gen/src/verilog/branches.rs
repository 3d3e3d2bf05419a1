//! Choices as statements: the `if` chains and `case`s of registers and of `always @*` blocks.

use super::literal::{Style, literal};
use super::plan::Form;
use super::printer::Printer;
use super::statement::{Statement, assign_always};
use tilewright_circuit::Bits;
use tilewright_circuit::ir::{NodeId, Op, Unary};

/// Above this number, conditions are not `else if`s of each other: parsers of some tools fail at a thousand or so,
/// and Yosys takes time cubic in their number.
const LONGEST_CHAIN: usize = 32;

/// The target of assignments.
#[derive(Clone)]
pub struct Target {
    /// Its name.
    pub name: String,
    /// `<=` for a register, `=` for a net.
    pub assign: &'static str,
    /// The node whose value it keeps if nothing is assigned: a register's own.
    pub hold: Option<NodeId>,
    /// Its enum of states.
    pub states: Option<usize>,
    /// Its value in an arm of a `case` on itself: an assignment of that value changes nothing.
    pub now: Option<Bits>,
}

impl Printer<'_> {
    /// The statements that give `target` the value of a node; none if a register keeps its value.
    pub fn statements(&mut self, id: NodeId, target: &Target) -> Vec<Statement> {
        match &self.module.node(id).op {
            _ if self.keeps(target, id) => Vec::new(),
            Op::Case { .. } if self.is_choice(id) => vec![self.case(id, target)],
            Op::Mux { .. } | Op::Select { .. } if self.is_choice(id) => self.if_chain(id, target),
            Op::Concat(_) if self.plan.form(id) == Form::Block => {
                vec![target.take(&self.expression(id, Style::Count))]
            }
            _ => self.leaf(id, target),
        }
    }

    /// A value inside a choice: a further choice only if it is part of this block.
    pub fn branch(&mut self, id: NodeId, target: &Target) -> Vec<Statement> {
        match self.plan.form(id) {
            Form::Block => self.leaf(id, target),
            _ => self.statements(id, target),
        }
    }

    /// Like [`Self::branch`], with an explicit assignment if a register keeps its value.
    fn full_branch(&mut self, id: NodeId, target: &Target) -> Vec<Statement> {
        match self.branch(id, target) {
            body if !body.is_empty() => body,
            _ if target.hold == Some(id) => vec![target.keep()],
            _ => self.leaf(id, &Target { now: None, ..target.clone() }),
        }
    }

    fn leaf(&mut self, id: NodeId, target: &Target) -> Vec<Statement> {
        if self.keeps(target, id) {
            return Vec::new();
        }
        let value = self.state_text(id, target.states).unwrap_or_else(|| self.assigned(id));
        vec![target.take(&value)]
    }

    /// Whether `target` keeps its value when it is assigned that of a node.
    fn keeps(&self, target: &Target, id: NodeId) -> bool {
        target.hold == Some(id)
            || matches!(&self.module.node(id).op, Op::Const(value) if target.now.as_ref() == Some(value))
    }

    fn is_choice(&self, id: NodeId) -> bool {
        matches!(self.plan.form(id), Form::Branches | Form::Block)
    }

    fn case(&mut self, id: NodeId, target: &Target) -> Statement {
        let Op::Case { subject, arms, default } = &self.module.node(id).op else { unreachable!("a case") };
        let states = self.states.of(*subject);
        let is_own = target.hold == Some(*subject);
        let subject = self.value(*subject);
        let mut printed = Vec::with_capacity(arms.len());
        for (key, value) in arms {
            let label = match states {
                Some(states) => self.states.name(states, key),
                None => literal(key, Style::Count),
            };
            let target = &Target { now: is_own.then(|| key.clone()), ..target.clone() };
            printed.push((label, self.branch(*value, target)));
        }
        let note = states.and_then(|states| self.states.remaining(states, arms.iter().map(|(key, _)| key)));
        Statement::Case { subject, arms: printed, default: self.branch(*default, target), note }
    }

    /// None if the target keeps its value in any case.
    fn if_chain(&mut self, id: NodeId, target: &Target) -> Vec<Statement> {
        let (mut arms, last) = self.chain(id);
        let this = &*self;
        let holds = |id: NodeId| this.keeps(target, id);
        while holds(last) && arms.last().is_some_and(|&(_, value)| holds(value)) {
            arms.pop();
        }
        if arms.is_empty() && holds(last) {
            return Vec::new();
        }
        if arms.len() > LONGEST_CHAIN {
            return self.separate_ifs(&arms, last, target);
        }
        let is_kept = matches!(arms[..], [(_, value)] if holds(value));
        if let [(condition, _)] = arms[..]
            && is_kept
        {
            let condition = self.negated(condition);
            return vec![Statement::If(vec![(condition, self.branch(last, target))], Vec::new())];
        }
        let mut printed = Vec::with_capacity(arms.len());
        for (condition, value) in arms {
            let condition = self.value(condition);
            printed.push((condition, self.full_branch(value, target)));
        }
        vec![Statement::If(printed, self.branch(last, target))]
    }

    /// The same choice without an `else`: the first true condition wins, so it comes last.
    fn separate_ifs(&mut self, arms: &[(NodeId, NodeId)], last: NodeId, target: &Target) -> Vec<Statement> {
        let mut out = self.branch(last, target);
        for &(condition, value) in arms.iter().rev() {
            let condition = self.value(condition);
            let mut body = self.full_branch(value, target);
            // An arm that keeps the value must override an earlier assignment.
            if !assign_always(&body) {
                body.insert(0, target.keep());
            }
            out.push(Statement::If(vec![(condition, body)], Vec::new()));
        }
        out
    }

    /// The negation of a condition.
    pub fn negated(&mut self, condition: NodeId) -> String {
        match self.module.node(condition).op {
            Op::Unary(Unary::Not, inner) if self.plan.form(condition) == Form::Inline => self.value(inner),
            _ => format!("!{}", self.operand(condition, Style::Count)),
        }
    }

    /// The conditions and values of choices nested in the `else`, and the last `else`.
    fn chain(&self, mut id: NodeId) -> (Vec<(NodeId, NodeId)>, NodeId) {
        let mut arms = Vec::new();
        loop {
            id = match &self.module.node(id).op {
                Op::Mux { select, on_true, on_false } => {
                    arms.push((*select, *on_true));
                    *on_false
                }
                Op::Select { arms: more, default } => {
                    arms.extend(more);
                    *default
                }
                _ => return (arms, id),
            };
            if self.plan.form(id) != Form::Branches {
                return (arms, id);
            }
        }
    }
}

impl Target {
    /// The assignment of a value.
    fn take(&self, value: &str) -> Statement {
        Statement::Assign(format!("{} {} {value};", self.name, self.assign))
    }

    /// The assignment that changes nothing.
    pub fn keep(&self) -> Statement {
        self.take(&self.name)
    }
}
