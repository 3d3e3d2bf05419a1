//! The page of Pixel-planes 5: what its paper states about the performance of its renderers (facts A0, B).

mod bins;
mod found;
mod frames;
mod load_charts;
mod loads;
mod owners;
mod plan;
mod reasons;
mod scenes;
mod statements;
mod time_charts;
mod times;

use super::effort::Effort;
use crate::shell::Failure;
use found::Found;
use plan::Plan;
use tilewright_machines::Watch;
use tilewright_report::{Page, Provenance, Section, Verdicts};

/// H_v of the paper's example, as it is printed.
const PRINTED: f64 = 1.63;
/// Nanoseconds a vector of the paper's example, as they are printed.
const UPDATE_TIME: f64 = 239.0;

/// Measures and makes the page; `None` if interrupted.
pub fn page(effort: Effort, watch: &mut Watch) -> Result<Option<Page>, Failure> {
    let plan = Plan { effort };
    let Some(found) = Found::all(&plan, watch)? else { return Ok(None) };
    let (size, side) = (plan.regions().size(), plan.regions().side());
    let provenance =
        Provenance::new("tilewright", env!("CARGO_PKG_VERSION"), effort.command("pixel-planes-5", "--vectors"))
            .seeds([effort.seed])
            .parameter(
                "screen of frames",
                format!("{size} pixels in regions of {side}x{side}"),
                "80 regions, as in the paper",
            )
            .parameter("renderers", "B = 16", "as in the paper’s example")
            .parameter("clock", "25 ns", "as in the paper")
            .parameter("vectors", "50 pixels at 45 degrees", "as in the paper’s example");
    let page = Page::new("Pixel-planes 5: the performance of its renderers", provenance)
        .paragraph(
            "The screen is cut into regions of 128x128 pixels. A renderer has a processor for each pixel of one region, and takes region after region; several renderers share the screen. The paper \
             estimates how many regions a primitive is in, and how many primitives the renderer with the heaviest load has. From both follows how long a frame takes.",
        )
        .paragraph(
            "This page compares the estimates with three programs. A plain count bins primitives and assigns regions, without time. The transaction model has the clocks of renderers and ring \
             without their circuit. RTL is the circuit itself, simulated clock by clock, with all processors of all renderers. Where it runs, each of its handshakes is compared with the model’s. The \
             formulas are the paper’s, restored where the print is damaged.",
        )
        .section(bins::section(&found.counted))
        .section(load_charts::section(&found.loads, &found.frames))
        .section(time_charts::section(&plan, &found.times, &found.table))
        .section(frames::section(&found.frames))
        .section(Section::new("Statements").part(statements::verdicts(&found).note(effort.note())))
        .section(
            Section::new("Checks of the measurements")
                .paragraph("The golden image is drawn by a plain rasterizer, without regions.")
                .part(Verdicts::new("checks", "Checks").states(frames::checks(&found.frames))),
        );
    Ok(Some(page))
}
