//! No combinational loop, within a module or through its instances.

use crate::ir::Module;
use crate::loops;
use crate::problem::Problem;
use crate::summary::{self, Summary};

pub(super) fn check(modules: &[Module], problems: &mut Vec<Problem>) {
    let mut summaries = Vec::with_capacity(modules.len());
    for module in modules {
        let graph = loops::check(module, &summaries, problems);
        summaries.push(match graph {
            Some(graph) => summary::of_loops(module, &graph),
            None => Summary::unknown(module.outputs.len()),
        });
    }
}
