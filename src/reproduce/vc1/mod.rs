//! The page of the VC-1: what its paper states about virtual local frame buffers (facts A1, B).

mod beside;
mod charts;
mod circuit;
mod claims;
mod counted;
mod estimate;
mod figure_6;
mod found;
mod frames;
mod idle;
mod observed;
mod owners;
mod plan;
mod random;
mod regions;
mod run;
mod statements;
mod table;
mod tables;
mod words;

use super::effort::Effort;
use crate::shell::Failure;
use found::Found;
use frames::Drawn;
use owners::Owners;
use plan::Plan;
use random::Ran;
use tilewright_machines::Watch;
use tilewright_report::{Page, Section, Verdicts};

/// The frames of the circuit.
struct Drawings {
    owners: Owners,
    frames: Vec<Drawn>,
    random: Ran,
}

/// Measures and makes the page; `None` if interrupted.
pub fn page(effort: Effort, watch: &mut Watch) -> Result<Option<Page>, Failure> {
    let plan = Plan::new(effort);
    let Some(drawings) = Drawings::all(&plan, watch)? else { return Ok(None) };
    let Some(found) = Found::all(&plan, watch)? else { return Ok(None) };
    let page = words::introduction(Page::new("VC-1: virtual local frame buffers", words::provenance(&plan)), &plan)
        .section(charts::figure_7(&found, &drawings.frames))
        .section(charts::figure_8(&found))
        .section(charts::figure_9(&found).part(tables::effects(&found)))
        .section(table::section(&found))
        .section(tables::clusters(&found))
        .section(tables::section_6(&found))
        .section(found.figure_6.section())
        .section(drawings.section())
        .section(Section::new("Statements").part(statements::verdicts(&found).note(effort.note())))
        .section(Section::new("Checks").part(drawings.checks(effort.seed)).part(drawings.random.table()))
        .section(words::definitions(&plan))
        .section(tables::not_compared());
    Ok(Some(page))
}

impl Drawings {
    fn all(plan: &Plan, watch: &mut Watch) -> Result<Option<Drawings>, Failure> {
        let owners = Owners::drawn(plan, watch)?;
        let Some(frames) = Drawn::all(plan, watch)? else { return Ok(None) };
        let Some(random) = Ran::all(plan.machines(), plan.effort.seed, watch) else { return Ok(None) };
        Ok(Some(Drawings { owners, frames, random: random? }))
    }

    /// Frames as the circuit drew them.
    fn section(&self) -> Section {
        let section = Section::new("Frames").paragraph(
            "The circuit drew these scenes, clock by clock, with 16 processing elements. Local frame buffers, bus, merger, global frame buffer, swaps and display are simulated. The \
             programs of the processing elements and of the host take the time of their steps.",
        );
        frames::section(self.owners.section(section), &self.frames)
    }

    /// The checks of the measurements.
    fn checks(&self, seed: u64) -> Verdicts {
        let all = frames::checks(&self.frames).into_iter().chain(self.owners.checks()).chain([self.random.check(seed)]);
        Verdicts::new("checks", "Checks").states(all)
    }
}
