//! Checks a latency that is stated as a number against the counted one.

use tilewright_circuit::ir::Module;
use tilewright_circuit::ir::latency::{Delay, latency, output_delays};
use tilewright_circuit::{Mistake, Problem};

/// Adds the delays of `module` to those of the earlier modules, if these have no problem.
pub(crate) fn check(
    (block, is_gated): (&str, bool),
    module: &Module,
    delays: &mut Vec<Vec<Delay>>,
    problems: &mut Vec<Problem>,
) {
    let own = output_delays(module, delays);
    let found = latency(module, &own);
    delays.push(own);
    // An enable around the block changes what is counted.
    if is_gated {
        return;
    }
    let text = &module.about.latency;
    // A latency in words is allowed if it cannot be counted, as with a FIFO. If it can, it must match.
    let in_words = text.strip_suffix(" clock").or(text.strip_suffix(" clocks"));
    let Ok(stated) = in_words.unwrap_or(text).parse::<u32>() else { return };
    let message = match found {
        None if in_words.is_some() => return,
        Some(found) if found.clocks == stated => return,
        Some(found) => format!("`{block}` states a latency of {stated}, but takes {found}"),
        None => format!("`{block}` states a latency of {stated}, but has no single latency"),
    };
    problems.push(
        Problem::new(Mistake::WrongLatency, module.loc, message).help(
            "a latency that is a single number is counted and need not be stated; otherwise, describe it in words",
        ),
    );
}
