//! Which edits plainly make the same circuit: of conditions that never hold together, and beside constants that change nothing.

use std::collections::BTreeSet;
use tilewright_hdl::Bits;
use tilewright_hdl::ir::{Binary, Init, Module, NodeId, Op, Relation, Unary};

/// Whether the operator gives its other operand where one is this.
pub(crate) fn is_neutral(module: &Module, operator: Binary, operand: NodeId) -> bool {
    let neutral = match operator {
        Binary::And => Bits::ones(module.width(operand)),
        _ => Bits::zero(module.width(operand)),
    };
    constant(module, operand) == Some(neutral)
}

/// Whether a register says that edges have passed: 0 at power-on and after a reset, and then 1. It is not described, but made for
/// a statement about past values, as is the gate by which that waits for it.
pub(crate) fn is_guard(module: &Module, id: NodeId) -> bool {
    let Op::Register(register) = module.node(id).op else { return false };
    let register = &module.registers[register.0 as usize];
    let begins_with_0 = register.initial == Some(Bits::zero(1)) && register.reset == Some(Init::Same(Bits::zero(1)));
    begins_with_0 && (constant(module, register.next) == Some(Bits::ones(1)) || is_guard(module, register.next))
}

/// The value of a constant, as it is or inverted.
fn constant(module: &Module, id: NodeId) -> Option<Bits> {
    match &module.node(id).op {
        Op::Const(value) => Some(value.clone()),
        Op::Wire(of) => constant(module, *of),
        Op::Unary(Unary::Not, of) => constant(module, *of).map(|value| value.not()),
        _ => None,
    }
}

/// A condition holds only while a value is one of these numbers, such as the codes of a state.
struct Only {
    value: NodeId,
    numbers: BTreeSet<u64>,
}

/// Whether two conditions never hold together, as each needs another number of the same value.
pub(crate) fn exclusive(module: &Module, a: NodeId, b: NodeId) -> bool {
    let (a, b) = (needs(module, a), needs(module, b));
    a.iter().any(|a| b.iter().any(|b| a.value == b.value && a.numbers.is_disjoint(&b.numbers)))
}

/// All that is needed for a condition, as far as that is plain to see.
fn needs(module: &Module, condition: NodeId) -> Vec<Only> {
    match &module.node(condition).op {
        Op::Wire(of) => needs(module, *of),
        Op::Compare { relation: Relation::Eq, operands: [value, number], .. } => match &module.node(*number).op {
            Op::Const(number) => {
                let only = |number| Only { value: *value, numbers: [number].into() };
                number.to_u64().map(only).into_iter().collect()
            }
            _ => Vec::new(),
        },
        Op::Binary(Binary::And, a, b) => [needs(module, *a), needs(module, *b)].into_iter().flatten().collect(),
        Op::Binary(Binary::Or, a, b) => {
            let b = needs(module, *b);
            let either = |a: Only| {
                let b = b.iter().find(|b| b.value == a.value)?;
                Some(Only { value: a.value, numbers: &a.numbers | &b.numbers })
            };
            needs(module, *a).into_iter().filter_map(either).collect()
        }
        _ => Vec::new(),
    }
}
