//! Registers and wires that nothing drives.

use crate::draft::Draft;
use crate::finish::connect_wires;
use crate::ir::NodeId;
use crate::problem::Problem;

pub(crate) fn check(draft: &mut Draft, problems: &mut Vec<Problem>) {
    let mut report = |node: NodeId, what: &str, help: &str| {
        let name = draft.describe(node);
        problems.push(
            Problem::new(draft.node(node).loc, format!("{what} `{name}` of `{}` is never driven", draft.block))
                .help(help),
        );
    };
    for register in draft.registers.iter().filter(|register| register.next.is_none()) {
        report(register.node, "register", "say what it takes at the next edge with `.next(value)`");
    }
    for wire in draft.wires.iter().filter(|wire| wire.driver.is_none()) {
        report(wire.node, "wire", "say what drives it with `.drive(value)`");
    }
    connect_wires(draft);
}
