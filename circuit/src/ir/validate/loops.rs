//! No combinational loop, within a module or through its instances.

use crate::ir::{Module, NodeId};
use crate::loops;
use crate::problem::Problem;
use crate::summary::{self, Summary};

pub(super) fn check(modules: &[Module], problems: &mut Vec<Problem>) {
    let mut summaries = Vec::with_capacity(modules.len());
    for module in modules {
        let sound = loops::check(module, &summaries, problems);
        let outputs: Vec<NodeId> = module.outputs.iter().map(|output| output.node).collect();
        summaries.push(match sound {
            true => summary::of_loops(module, &summaries, &outputs),
            false => Summary::unknown(outputs.len()),
        });
    }
}
