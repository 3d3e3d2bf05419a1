//! Which conditions never hold together: the order of such does not matter, nor whether they meet in an or or an exclusive or.

use std::collections::BTreeSet;
use tilewright_hdl::ir::{Binary, Module, NodeId, Op, Relation};

/// A condition holds only while a value is one of these numbers, such as the codes of a state.
struct Only {
    value: NodeId,
    numbers: BTreeSet<u64>,
}

/// Whether two conditions never hold together, as each needs another number of the same value.
pub(crate) fn exclusive(module: &Module, a: NodeId, b: NodeId) -> bool {
    match (only(module, a), only(module, b)) {
        (Some(a), Some(b)) => a.value == b.value && a.numbers.is_disjoint(&b.numbers),
        _ => false,
    }
}

/// What is needed for a condition, as far as that is plain to see.
fn only(module: &Module, condition: NodeId) -> Option<Only> {
    match &module.node(condition).op {
        Op::Wire(of) => only(module, *of),
        Op::Compare { relation: Relation::Eq, operands: [value, number], .. } => match &module.node(*number).op {
            Op::Const(number) => Some(Only { value: *value, numbers: [number.to_u64()?].into() }),
            _ => None,
        },
        Op::Binary(Binary::And, a, b) => only(module, *a).or_else(|| only(module, *b)),
        Op::Binary(Binary::Or, a, b) => {
            let (a, mut b) = (only(module, *a)?, only(module, *b)?);
            b.numbers.extend(a.numbers);
            (a.value == b.value).then_some(b)
        }
        _ => None,
    }
}
