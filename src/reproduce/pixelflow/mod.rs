//! The page of PixelFlow: what its paper states about the latency of three software systems (facts A4, B).

mod charts;
mod found;
mod frames;
mod plan;
mod reasons;
mod statements;
mod stereo;

use super::effort::Effort;
use crate::shell::Failure;
use found::Found;
use plan::Plan;
use tilewright_machines::Watch;
use tilewright_report::{Page, Provenance, Section};

/// Measures and makes the page; `None` if interrupted.
pub fn page(effort: Effort, watch: &mut Watch) -> Result<Option<Page>, Failure> {
    let plan = Plan { effort };
    let Some(found) = Found::all(&plan, watch)? else { return Ok(None) };
    let provenance =
        Provenance::new("tilewright", env!("CARGO_PKG_VERSION"), effort.command("pixelflow", "--primitives"))
            .seeds([effort.seed])
            .parameter("nodes", "20, one of which has the frame buffer", "as in the paper")
            .parameter("screen", "640x512 pixels in 40 regions of 128x64", "as in the paper")
            .parameter(
                "primitives",
                "10x10 pixels at random places",
                "as in the paper; the screen wraps around here, so that their overlap is the formula’s",
            )
            .parameter(
                "rasterizations with eight samples",
                "2",
                "our choice, the paper does not say: four samples are side by side, so everything is drawn twice",
            )
            .parameter("set-up of a composition", "0", "as in the paper, which leaves it out");
    let page = Page::new("PixelFlow: the latency of three systems", provenance)
        .paragraph(
            "Twenty nodes each have an array of 128x64 pixel processors and a front end. Some nodes rasterize, others shade, and one has the frame buffer. A network between them composes what they drew, \
             region by region. The paper gives the latency of three software systems in formulas. The base system draws a frame while the next one is transformed. The second sorts primitives in a \
             pass of its own and draws the same frame in a second pass. The third keeps the whole screen in the pixels’ memory, without sorting and without textures.",
        )
        .paragraph(
            "This page compares the formulas with a transaction model. The model has the paper’s time for each step and no circuit. Nodes, network and frame buffer wait for each other as their registers \
             make them. Where the paper’s statements follow from its constants, formula and model agree with it. Further down the circuit itself draws frames, with its own time \
             for each step.",
        )
        .section(charts::latencies(&found))
        .section(charts::stages(&found))
        .section(charts::pre_sorting(&found))
        .section(frames::section(&found.frames, &plan))
        .section(stereo::section(&found.frames, &plan))
        .section(Section::new("Statements").part(statements::verdicts(&found, &plan).note(effort.note())))
        .section(Section::new("Checks of the measurements").part(statements::checks(&found, &plan)));
    Ok(Some(page))
}
