//! Registers and wires without a driver; the others get their drivers.

use crate::draft::{Draft, UNDRIVEN};
use crate::stream::{inputs_of_stream, say_untaken};
use tilewright_circuit::ir::{NodeId, Op, Shape};
use tilewright_circuit::{Bits, Mistake, Problem};

pub(crate) fn check(draft: &mut Draft, problems: &mut Vec<Problem>) {
    for register in draft.registers.iter().filter(|register| register.next.is_none()) {
        let help = "give its next value with `.next(value)`, or with `.when(condition, value)`";
        problems.push(undriven(draft, register.node, "register", help));
    }
    let mut untaken = Vec::new();
    for wire in draft.wires.iter().filter(|wire| wire.driver.is_none()) {
        match say_untaken(draft, wire.node) {
            Some(problem) => {
                problems.push(problem);
                untaken.extend(inputs_of_stream(draft, wire.node));
            }
            None => problems.push(undriven(draft, wire.node, "wire", "drive it with `.drive(value)`")),
        }
    }
    draft.in_problems.extend(untaken);
    connect_wires(draft);
}

fn undriven(draft: &Draft, node: NodeId, what: &str, help: &str) -> Problem {
    let name = draft.describe(node);
    let message = format!("{what} `{name}` of `{}` is never driven", draft.block);
    Problem::new(Mistake::Undriven, draft.node(node).loc, message).help(help)
}

/// Gives every wire its driver; a wire without one gets zero.
fn connect_wires(draft: &mut Draft) {
    for i in 0..draft.wires.len() {
        let node = draft.wires[i].node;
        let (width, loc) = (draft.node(node).width, draft.node(node).loc);
        let driver = match draft.wires[i].driver {
            Some((driver, _)) => driver,
            None => draft.add(Op::Const(Bits::zero(width)), width, Shape::Plain, loc),
        };
        debug_assert_eq!(draft.node(node).op, Op::Wire(UNDRIVEN));
        draft.node_mut(node).op = Op::Wire(driver);
    }
}
