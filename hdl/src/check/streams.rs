//! Streams that are offered only when the receiver is ready. The receiver may wait for the offer in turn.

use crate::draft::Draft;
use crate::summary::{Dependence, Summary};
use std::collections::HashMap;
use tilewright_circuit::ir::NodeId;
use tilewright_circuit::{Mistake, Problem};

pub(crate) fn check(draft: &Draft, outputs: &[(String, NodeId)], summary: &Summary, problems: &mut Vec<Problem>) {
    let paths = outputs.iter().map(|(path, _)| path.as_str());
    let found: HashMap<&str, &Dependence> = paths.zip(&summary.outputs).collect();
    for sent in &draft.sent {
        if found.get(sent.valid.as_str()).is_some_and(|valid| valid.inputs.contains(&sent.ready)) {
            let name = sent.valid.strip_suffix(".valid").unwrap_or(&sent.valid);
            let message = format!(
                "stream `{name}` of `{}` waits for its receiver: its `valid` follows from its `ready`",
                draft.block
            );
            let help = "offer the payload in any case, and let `sent` tell whether it is taken: the receiver may wait for `valid`";
            problems.push(Problem::new(Mistake::WaitingSender, sent.loc, message).help(help));
        }
    }
}
