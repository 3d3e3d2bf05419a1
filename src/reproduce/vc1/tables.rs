//! Tables: clusters, the thresholds' effects, section 6, and what cannot be compared.

use super::claims;
use super::found::Found;
use super::plan::Capacity;
use super::statements::{best, named};
use tilewright_report::{Axis, Cell, Chart, Section, Series, Table};
use tilewright_rtl::gfb::Blanking;

/// The effects of the threshold on the paper's machine.
pub fn effects(found: &Found) -> Table {
    let columns = ["threshold", "T, ms", "D, ms", "busiest over mean", "overflows a frame", "words a frame", "bus, ms"];
    let table = Table::new("figure-9-effects", "Figure 9: effects of the threshold, 1/4.7 of the screen", columns);
    let plan = &found.plan;
    plan.thresholds().fold(table, |table, apr| {
        match found.of(plan.at_threshold(Capacity::Paper, Blanking::AtStart, apr)) {
            None => table,
            Some(it) => {
                let numbers = [it.time, it.drawing, it.imbalance, it.overflows, it.words, it.bus].map(Cell::Number);
                table.row([Cell::from(named(apr))].into_iter().chain(numbers))
            }
        }
    })
}

/// Section 4.1.
pub fn clusters(found: &Found) -> Section {
    let columns = ["polygons of a cluster w", "busiest over mean", "vertices transformed", "pages of each"];
    let table = Table::new("clusters", "ter1k by the size of clusters, n = 16", columns).note(
        "Vertices and pages are counted, with pages for all patches; the load of processing elements is the model’s.",
    );
    let row = |table: Table, it: &super::counted::Cluster| {
        let imbalance = found.of(found.plan.clustered(it.polygons)).map_or(f64::NAN, |timed| timed.imbalance);
        table.row([f64::from(it.polygons), imbalance, it.vertices, it.pages].map(Cell::Number))
    };
    Section::new("Clusters of polygons")
        .paragraph("Clusters of w consecutive polygons go to the processing element with the least load. Large clusters share vertices and pages; small ones share out the work.")
        .part(found.counted.clusters.iter().fold(table, row))
}

/// Section 6.
pub fn section_6(found: &Found) -> Section {
    let plan = &found.plan;
    let columns = ["n", "capacity", "best threshold", "T, ms", "D, ms", "mean area sent, pixels", "bus, ms"];
    let table = Table::new("section-6", "The table with more and more processing elements", columns)
        .note("The best threshold has the least T and, if several have it, the least D.");
    let table = plan.section_6().fold(table, |table, machine| match best(found, machine) {
        None => table,
        Some(it) => {
            let area = found.counted.mean_area(it.case.config(plan).apr).unwrap_or(f64::NAN);
            let cells = [f64::from(machine.0).into(), format!("1/{}", machine.1).into(), named(it.case.apr).into()];
            table.row(cells.into_iter().chain([it.time, it.drawing, area, it.bus].map(Cell::Number)))
        }
    });
    let chart = Chart::new(
        "section-6-drawing",
        "D by the threshold, with less memory as there are more processing elements",
        Axis::log("threshold, pixels"),
        Axis::log("D, ms"),
    );
    let chart = plan.section_6().fold(chart, |chart, machine| {
        let point = |apr: Option<u32>| Some((f64::from(apr?), found.of(plan.in_section_6(machine, apr))?.drawing));
        chart.series(Series::new(format!("n = {}", machine.0), found.model(), plan.thresholds().filter_map(point)))
    });
    Section::new("Section 6: larger machines")
        .paragraph(
            "As the number of processing elements grows, each has fewer pixels to draw and needs less memory. But large polygons are then too large for it, so more of them are sent to all.",
        )
        .part(table)
        .figure(claims::best(found), chart)
}

/// The paper's contents without numbers here.
pub fn not_compared() -> Section {
    let rows = [
        ("1.3 GFLOPS", "the programs are in Rust with a cost for each step: no floating-point operation is simulated"),
        (
            "point-to-point links, 20 Mbit/s",
            "polygon rendering uses the broadcast bus alone, and so does the machine here",
        ),
        ("Figures 3, 10 and 11", "block diagrams and photographs have no numbers"),
        ("texture mapping", "future work in the paper"),
        ("special hardware for rasterization", "future work in the paper"),
        ("reuse of pages while they are sent", "left out of the paper’s machine as too complex, and left out here"),
        ("Figures 7, 8 and 9, point by point", "the curves are not in the text: only its sentences can be compared"),
    ];
    let table = Table::new("not-compared", "What is not compared, and why", ["what", "why"]);
    let table = rows.into_iter().fold(table, |table, (what, why)| table.row([what.into(), why.into()]));
    Section::new("Not compared").part(table).paragraph(
        "Two expected numbers are wrong. 42.0 ms, T_m and a refresh, is not a bound of an overflow’s wait. From 754 clocks of rasterization to the 1492 of 2x2 regions there are 738 more, \
         and not 739.",
    )
}
