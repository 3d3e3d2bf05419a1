//! Streams that are offered only to a receiver that is ready, which may wait for the offer in turn.

use crate::draft::Draft;
use crate::ir::NodeId;
use crate::problem::Problem;
use crate::summary::Summary;

pub(crate) fn check(draft: &Draft, outputs: &[(String, NodeId)], summary: &Summary, problems: &mut Vec<Problem>) {
    for sent in &draft.sent {
        let valid = outputs.iter().position(|(path, _)| *path == sent.valid);
        let inputs = valid.and_then(|output| summary.outputs.get(output)).map_or(&[][..], |output| &output.inputs);
        if inputs.contains(&sent.ready) {
            let name = sent.valid.strip_suffix(".valid").unwrap_or(&sent.valid);
            let message = format!(
                "stream `{name}` of `{}` waits for its receiver: its `valid` follows from its `ready`",
                draft.block
            );
            let help = "offer what there is, and let `sent` say whether it is taken: the receiver may wait for `valid`";
            problems.push(Problem::new(sent.loc, message).help(help));
        }
    }
}
