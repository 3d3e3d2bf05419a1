//! The page of the VC-1: what its paper says of virtual local frame buffers (facts A1, B).

mod circuit;
mod counted;
mod figure_6;
mod found;
mod observed;
mod plan;
mod run;
mod statements;
mod table;

use super::effort::Effort;
use crate::shell::Failure;
use found::Found;
use plan::Plan;
use tilewright_machines::Watch;
use tilewright_report::{Page, Provenance, Section};

/// Measures and makes the page; `None` if it was interrupted.
pub fn page(effort: Effort, watch: &mut Watch) -> Result<Option<Page>, Failure> {
    let plan = Plan::new(effort);
    let Some(found) = Found::all(&plan, watch)? else { return Ok(None) };
    let provenance =
        Provenance::new("tilewright", env!("CARGO_PKG_VERSION"), effort.command("vc1", "--views")).seeds([effort.seed]);
    let page = Page::new("VC-1: virtual local frame buffers", provenance)
        .section(Section::new("Statements").part(statements::verdicts(&found)))
        .section(found.figure_6.section());
    Ok(Some(page))
}
