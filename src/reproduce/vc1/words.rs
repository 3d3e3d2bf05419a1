//! The introduction of the page, and its definitions.

use super::plan::{Plan, SPLITS, split};
use tilewright_machines::vc1::CostTable;
use tilewright_report::{Page, Provenance, Section};

pub fn introduction(page: Page, plan: &Plan) -> Page {
    let page = page
        .paragraph(
            "Sixteen general-purpose processors each transform, light and draw their own polygons into a local frame buffer. A pipelined merger takes the nearest word of each pixel from all of them, and a \
             global frame buffer gathers these for the display. Each local frame buffer is virtual, with memory for a part of the screen. A patch of 4x4 pixels takes a page of it when it is drawn on for the first \
             time. When there is none left, its buffers swap in the midst of a frame.",
        )
        .paragraph(
            "This page compares each statement of the paper with a number, a sequence or a direction with what the machine does. Its rule was fixed before the number was known. Most numbers come from an \
             event-driven model. Its clocks are the circuit’s: wherever the circuit runs for this page, the two are compared event by event.",
        );
    match plan.is_quick() {
        false => page,
        true => page.paragraph(format!(
            "This is a quick look, on a screen of {} pixels. Refreshes and programs are faster by the factor by which T_m is shorter, and all times are multiplied by that factor. There are few scenes and \
             few machines, so some statements cannot be compared, and numbers differ from those of the paper’s screen.",
            plan.size()
        )),
    }
}

/// Where the numbers come from.
pub fn provenance(plan: &Plan) -> Provenance {
    let CostTable { vertex, polygon, area, clip, set_up, row, pixel, clear, send, receive } = CostTable::default();
    Provenance::new("tilewright", env!("CARGO_PKG_VERSION"), plan.effort.command("vc1", "--views"))
        .seeds([plan.effort.seed])
        .parameter("screen", format!("{} pixels", plan.size()), "the paper’s is 640x480")
        .parameter("refreshes", "60 Hz", "the paper does not say; 33.3 ms are two of them")
        .parameter("swaps", "at the start of the blanking", "the paper says: in it")
        .parameter(
            "geometry",
            format!("{vertex} clocks a vertex, {polygon} a polygon"),
            "fitted: 631 clocks for a polygon of ter1k, Table 1",
        )
        .parameter(
            "rasterization",
            format!("{area} clocks an area, {clip} to clip, {set_up} to set up, {row} a row, {pixel} a pixel"),
            "fitted: 754 clocks for a polygon of ter1k, Table 1; the split is ours",
        )
        .parameter("patch table", format!("{clear} clocks an entry to clear"), "the paper gives no number")
        .parameter("bus", format!("{send} clocks to send a word, {receive} to receive it"), "the paper gives no number")
        .parameter(
            "clusters",
            "32 polygons, assigned once by their expected clocks",
            "the paper tunes w, and gives no number",
        )
        .parameter(
            "threshold",
            "500 with 16 processing elements, 500 · 16 / n with n, none with one",
            "the paper says 500 for 16, and less for more",
        )
}

/// The two times of the figures.
pub const TIMES: &str = "T is the rendering time: the mean of the 12 intervals between the swaps 3 to 15 of the global frame buffer. D is the time for which the busiest processing element clears and draws. \
     Waiting is left out of D, but an access’s fourth clock, in which it takes a page, is not.";

pub fn definitions(plan: &Plan) -> Section {
    let rows: Vec<String> = SPLITS.iter().map(|set_up| split(*set_up).row.to_string()).collect();
    let views = plan.views().count();
    Section::new("What the words mean")
        .paragraph(format!(
            "The view is still. A capacity c is floor(19,200 c) pages in each of the two buffers; 1/4.7 is the paper’s machine with its 4096 pages. Unless stated otherwise, thresholds are 500 pixels with 16 processing \
             elements and 500 · 16 / n with n. The best threshold has the least T and, if several have it, the least D. Table 1 has means over {views} still views, 7.5 degrees apart. Their clusters are assigned once, in \
             the first view.",
        ))
        .paragraph(format!(
            "Two of Table 1’s numbers are fitted, and have no verdict: 12.3 ms of geometry and 14.7 ms of rasterization, 631 and 754 clocks a polygon. All other numbers are predictions: no cost was adjusted for them. \
             The splits of the 754 clocks have {} clocks a row.",
            rows.join(", ")
        ))
}
