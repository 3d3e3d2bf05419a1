//! Logic that feeds a synchronizer: the other clock may sample a glitch as an event.

use crate::draft::Draft;
use crate::summary::{self, Summary};
use tilewright_circuit::ir::NodeId;
use tilewright_circuit::{Loc, Mistake, Problem};

/// Returns the inputs that are wired to a synchronizer here or in an instance, with its name. The parents check what
/// feeds them.
pub(crate) fn check(draft: &Draft, summaries: &[Summary], problems: &mut Vec<Problem>) -> Vec<(u32, String)> {
    let mut synchronized = Vec::new();
    let mut enters = |node: NodeId, name: &str, loc: Loc| match summary::wired_inputs(draft, summaries, node) {
        Some(inputs) => synchronized.extend(inputs.into_iter().map(|input| (input, name.to_owned()))),
        None => {
            let text = draft.describe(node);
            let problem = Problem::new(
                Mistake::GlitchySynchronizer,
                loc,
                format!("`{text}` enters synchronizer `{name}` but is logic, which glitches"),
            )
            .note(format!("`{text}` is made"), draft.node(node).loc)
            .help("put a register on its own clock before the synchronizer, as in `m.pipe(name, value)`");
            problems.push(problem);
        }
    };
    for synchronizer in &draft.synchronizers {
        enters(synchronizer.enters, &synchronizer.name, synchronizer.loc);
    }
    for instance in &draft.instances {
        for (input, name) in &summaries[instance.module.0 as usize].synchronized {
            if let Some(driver) = instance.inputs.get(*input as usize) {
                enters(*driver, &format!("{}.{name}", instance.name), instance.loc);
            }
        }
    }
    synchronized
}
