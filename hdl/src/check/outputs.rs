//! Checks that the outputs have the declared widths.

use crate::elaboration::Elaboration;
use crate::names::bits_text;
use crate::signal::Signal;
use crate::uneven::uneven;
use crate::width::Width;
use std::collections::HashSet;
use tilewright_circuit::{Mistake, Problem};

/// Reports outputs that differ from their declaration. `outputs` are the results of `build`, `declared` the widths,
/// both by their paths.
pub(crate) fn check(e: &mut Elaboration, outputs: &[(String, Signal)], declared: &[(String, Width)]) {
    // An output declared without a width is not checked.
    let ports: HashSet<&str> = declared.iter().map(|(path, _)| port(path)).collect();
    let returned: Vec<_> = outputs.iter().filter(|(path, _)| ports.contains(port(path))).cloned().collect();
    if let Some(uneven) = uneven(&returned, declared) {
        let has = uneven.has;
        let message = format!("output{uneven} is declared as a list of {}, but `build` returns {has}", uneven.needs);
        let place = declared.iter().find(|(path, _)| path.starts_with(&format!("{}.", uneven.list)));
        let loc = place.map_or(e.draft().loc, |(_, width)| width.loc);
        return e.report(
            Problem::new(Mistake::ListLength, loc, message).help("return as many from `build` as are declared"),
        );
    }
    let mut faulty = Vec::new();
    for ((path, signal), (_, width)) in returned.iter().zip(declared) {
        if let Some(problem) = problem(e, &path.replace('.', "_"), *signal, *width) {
            e.report_instead_of(&[signal.node], problem);
            faulty.push(signal.node);
        }
    }
    // Its instances cannot know these widths.
    e.draft().stand_ins.extend(faulty);
}

/// The port that a path belongs to.
fn port(path: &str) -> &str {
    path.split('.').next().unwrap_or(path)
}

fn problem(e: &mut Elaboration, name: &str, signal: Signal, width: Width) -> Option<Problem> {
    if let Some(clock) = width.clock {
        let clock = clock.name;
        let message =
            format!("output `{name}` is declared on clock `{clock}`, but an output is on the clock of its driver");
        return Some(Problem::new(Mistake::OutputOnClock, width.loc, message).help("leave `.on(..)` out"));
    }
    let draft = e.draft();
    let driver = Some(draft.describe(signal.node)).filter(|driver| driver != name);
    let driver = driver.map_or("what drives it".to_owned(), |driver| format!("`{driver}`"));
    let place = draft.node(signal.node).loc;
    let (declared, has) = if signal.width != width.bits {
        (format!("with {}", bits_text(width.bits)), format!("has {}", bits_text(signal.width)))
    } else if signal.shape != width.shape {
        (format!("with {}", width.shape), format!("has {}", signal.shape))
    } else if signal.kind != width.kind {
        (format!("as {}", width.kind), format!("is {}", signal.kind))
    } else {
        return None;
    };
    let problem = Problem::new(
        Mistake::OutputDiffers,
        place,
        format!("output `{name}` is declared {declared}, but {driver} {has}"),
    );
    let problem = problem.note(format!("`{name}` is declared"), width.loc);
    Some(problem.help("change its driver, or its declaration, on which the block's instances rely"))
}
