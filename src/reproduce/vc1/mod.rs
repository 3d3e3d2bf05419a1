//! The page of the VC-1: what its paper says of virtual local frame buffers (facts A1, B).

mod charts;
mod circuit;
mod counted;
mod figure_6;
mod found;
mod frames;
mod idle;
mod observed;
mod owners;
mod plan;
mod random;
mod run;
mod statements;
mod table;
mod tables;

use super::effort::Effort;
use crate::shell::Failure;
use found::Found;
use plan::Plan;
use tilewright_machines::Watch;
use tilewright_report::{Page, Provenance, Section, Verdicts};

/// Measures and makes the page; `None` if it was interrupted.
pub fn page(effort: Effort, watch: &mut Watch) -> Result<Option<Page>, Failure> {
    let plan = Plan::new(effort);
    let Some(found) = Found::all(&plan, watch)? else { return Ok(None) };
    let provenance =
        Provenance::new("tilewright", env!("CARGO_PKG_VERSION"), effort.command("vc1", "--views")).seeds([effort.seed]);
    let page = Page::new("VC-1: virtual local frame buffers", provenance)
        .section(Section::new("Statements").part(statements::verdicts(&found)))
        .section(charts::figure_7(&found))
        .section(charts::figure_8(&found))
        .section(charts::figure_9(&found).part(tables::effects(&found)))
        .section(table::section(&found))
        .section(tables::clusters(&found))
        .section(tables::section_6(&found))
        .section(found.figure_6.section())
        .section(frames_section(&found))
        .section(Section::new("Checks").part(checks(&found)))
        .section(tables::not_compared());
    Ok(Some(page))
}

/// Frames as the circuit drew them.
fn frames_section(found: &Found) -> Section {
    let section = Section::new("Frames").paragraph(
        "Scenes as the circuit drew them, clock by clock, with 16 processing elements: local frame buffers, bus, merger, global frame buffer, swaps and display are simulated, the \
         programs of the processing elements and of the host take the time of their steps.",
    );
    frames::section(found.owners.section(section), &found.frames)
}

/// That what is measured is right.
fn checks(found: &Found) -> Verdicts {
    Verdicts::new("checks", "Checks")
        .states(frames::checks(&found.frames))
        .states(found.owners.checks())
        .state(found.random.check(found.plan.effort.seed))
}
