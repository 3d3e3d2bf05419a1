//! The name of a net by what it is, if its operands have names: `step_is_idle`, `count_plus_1`, `hits_any`.

use super::names::combined;
use super::states::screaming;
use tilewright_circuit::ir::{Binary, Design, Kind, Module, NodeId, Op, Relation, Unary};
use tilewright_circuit::{Bits, Radix};

/// A longer name is harder to read than what it stands for.
const LONGEST: usize = 32;

/// The names of operands.
pub struct Operands<'a> {
    pub design: &'a Design,
    pub module: &'a Module,
    /// What nodes are called so far.
    pub names: &'a [Option<String>],
}

impl Operands<'_> {
    /// The name after the operator and its operands; `None` if an operand has no name, or all together are too long.
    pub fn name(&self, id: NodeId) -> Option<String> {
        let module = self.module;
        let name = match &module.node(id).op {
            Op::Unary(op, a) => {
                let a = self.operand(*a)?;
                match op {
                    Unary::Not => format!("not_{a}"),
                    Unary::AllOnes => format!("{a}_all"),
                    Unary::AnyOne => format!("{a}_any"),
                    Unary::Parity => format!("{a}_parity"),
                }
            }
            Op::Binary(op, a, b) => {
                let right = constant(module, *a, *b).or_else(|| self.factor(*b))?;
                format!("{}_{}_{right}", self.factor(*a)?, word(*op))
            }
            Op::Compare { relation, operands: [a, b], .. } => match constant(module, *a, *b) {
                Some(number) => format!("{}_{}_{number}", self.operand(*a)?, relation_to_number(*relation)),
                None => format!("{}_{}_{}", self.operand(*a)?, relation_to_name(*relation), self.operand(*b)?),
            },
            Op::Slice { of, low } => match (self.operand(*of)?, module.width(id)) {
                (of, 1) => format!("{of}_{low}"),
                (of, width) => format!("{of}_{}_{low}", low + width - 1),
            },
            Op::Extend { of, .. } => format!("{}_extended", self.operand(*of)?),
            Op::Lane { of, index, .. } => format!("{}_{index}", self.operand(*of)?),
            Op::Pick { of, index, .. } => format!("{}_at_{}", self.operand(*of)?, self.operand(*index)?),
            Op::Reduce { by, of, .. } => format!("{}_{}", self.operand(*of)?, combined(*by)),
            _ => return None,
        };
        (name.len() <= LONGEST).then_some(name)
    }

    /// The name of an operand, also through what only passes it on.
    fn operand(&self, mut id: NodeId) -> Option<String> {
        loop {
            let node = self.module.node(id);
            id = match &node.op {
                _ if node.name.is_some() => return node.name.clone(),
                Op::Wire(of) | Op::QuasiStatic(of, _) | Op::Broadcast { of, .. } => *of,
                Op::Read(..) => return self.names[id.0 as usize].clone(),
                Op::Output(instance, port) => {
                    let instance = &self.module.instances[instance.0 as usize];
                    let port = &self.design.module(instance.module).outputs[*port as usize];
                    return Some(format!("{}_{}", instance.name, port.name));
                }
                _ => return None,
            }
        }
    }

    /// Like [`Self::operand`], or its inverse.
    fn factor(&self, id: NodeId) -> Option<String> {
        match self.module.node(id).op {
            Op::Unary(Unary::Not, a) => self.operand(a).map(|name| format!("not_{name}")),
            _ => self.operand(id),
        }
    }
}

/// A constant as a part of a name: a code by its name, a small number in decimal.
fn constant(module: &Module, beside: NodeId, id: NodeId) -> Option<String> {
    let Op::Const(value) = &module.node(id).op else { return None };
    if let Kind::Code(names) = module.node(beside).kind {
        return Some(screaming(&[names.name(value.to_u64()?)?]).to_lowercase());
    }
    let is_negative = module.node(id).kind == Kind::Signed && value.bit(value.width() - 1);
    (value.radix() == Radix::Any && !is_negative).then(|| small(value))?
}

fn small(value: &Bits) -> Option<String> {
    value.to_u64().filter(|number| *number < 10_000).map(|number| number.to_string())
}

fn word(op: Binary) -> &'static str {
    match op {
        Binary::And => "and",
        Binary::Or => "or",
        Binary::Xor => "xor",
        Binary::Add => "plus",
        Binary::Sub => "minus",
        Binary::Mul | Binary::MulSigned => "times",
    }
}

fn relation_to_number(relation: Relation) -> &'static str {
    match relation {
        Relation::Eq => "is",
        Relation::Ne => "is_not",
        Relation::Lt => "below",
        Relation::Le => "at_most",
        Relation::Gt => "above",
        Relation::Ge => "at_least",
    }
}

fn relation_to_name(relation: Relation) -> &'static str {
    match relation {
        Relation::Eq => "equals",
        Relation::Ne => "differs_from",
        other => relation_to_number(other),
    }
}
