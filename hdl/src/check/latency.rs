//! Checks a latency that is stated as a number against the counted one.

use tilewright_circuit::ir::Module;
use tilewright_circuit::ir::latency::{Delay, latency, output_delays};
use tilewright_circuit::{Mistake, Problem};

/// Checks the last of the modules, none of which has a problem. `delays` are those of the first modules, as many as were
/// needed before.
pub(crate) fn check(
    (block, is_gated): (&str, bool),
    modules: &[Module],
    delays: &mut Vec<Vec<Delay>>,
    problems: &mut Vec<Problem>,
) {
    let Some(module) = modules.last() else { return };
    // An enable around the block changes what is counted.
    if is_gated {
        return;
    }
    let text = &module.about.latency;
    // A latency in words is allowed if it cannot be counted, as with a FIFO. If it can, it must match.
    let in_words = text.strip_suffix(" clock").or(text.strip_suffix(" clocks"));
    let Ok(stated) = in_words.unwrap_or(text).parse::<u32>() else { return };
    for module in &modules[delays.len()..] {
        let own = output_delays(module, delays);
        delays.push(own);
    }
    let message = match latency(module, &delays[modules.len() - 1]) {
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
