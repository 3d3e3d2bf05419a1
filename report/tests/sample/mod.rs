//! A small page with every kind of part. Its curves are formulas of the sparse-raster quadtree paper; what is called measured here is
//! made up, as the introduction says.

use tilewright_report::{
    Axis, Chart, HeatMap, Lane, Link, Origin, Page, Picture, Provenance, Rule, Section, Series, Statement, Table,
    Timeline, Verdicts,
};

/// The page.
pub fn page() -> Page {
    let provenance =
        Provenance::new("tilewright-report", "0.1.0", "cargo run -p tilewright-report --example page -- out")
            .seeds([1, 2, 3])
            .parameter("image", "1024x1024", "m = 10, as in the paper")
            .parameter("matrix", "4ᵏ processors, k = 0 to 4", "as in the paper")
            .parameter("aperture", "2x2", "the paper’s example");
    Page::new("Every part of a report page", provenance)
        .paragraph(
            "This page shows what a report is made of, with formulas of the sparse-raster quadtree paper. Nothing ran for it: \
             what is marked as RTL, transaction model or plain count is made up from the formulas, to show how it looks.",
        )
        .section(
            Section::new("Windows per level")
                .paragraph(
                    "A polygon of area S touches few windows of a coarse level and many of a fine one. The curves are bounds; \
                     what is measured lies a few percent below them.",
                )
                .figure("A polygon touches fewer windows of a larger matrix, but never fewer than one above Sₖ.", windows())
                .figure("The load is greatest near 100 pixels.", load()),
        )
        .section(
            Section::new("Pictures")
                .figure("The light dot is above the dark one.", dots())
                .figure("A wide picture is as wide as there is room.", wide())
                .figure("One processor of the last row has the most to do.", busy())
                .figure("What is far from the middle has the greatest numbers.", fine()),
        )
        .section(
            Section::new("Times")
                .figure("Each sender begins a millisecond after the one before.", transfer())
                .figure("Twelve kinds of spans can be told apart.", bars()),
        )
        .section(Section::new("Numbers").part(forms()))
        .section(Section::new("Statements of the paper").part(verdicts()))
        .section(Section::new("Other pages").links([Link::new("#statements", "Statements", "The section above.")]))
}

/// MPG-EQ3: windows of the last level for 4ᵏ processors and aperture 2.
fn windows_of(k: i32, area: f64) -> f64 {
    (area + 2.0 * 1.514 * (2.0 * std::f64::consts::PI * area).sqrt() + 4.0) / 4f64.powi(k)
}

fn areas(steps: i32) -> impl Iterator<Item = f64> {
    (0..=steps).map(move |step| 10f64.powf(f64::from(step) * 5.0 / f64::from(steps)))
}

fn windows() -> Chart {
    let mut chart = Chart::new(
        "windows",
        "Windows of the last level",
        Axis::log("area S, pixels"),
        Axis::log("windows per polygon"),
    )
    .note("MPG-EQ3, for 4ᵏ processors. Crosses: Sₖ of the paper, where a processor has one window.");
    for k in 0..=4 {
        let name = format!("k = {k}");
        let curve = areas(50).map(|area| (area, windows_of(k, area)));
        let below = |share: f64| move |area: f64| (area, windows_of(k, area) * share);
        chart = chart
            .series(Series::new(&name, Origin::Formula, curve))
            .series(Series::new(&name, Origin::count([1]), areas(15).map(below(0.98))))
            .series(Series::new(&name, Origin::model([1, 2, 3]), areas(10).map(below(0.97))))
            .series(Series::new(&name, Origin::rtl([1, 2, 3]), areas(5).map(below(0.96))));
        if let Some(area) = [1.8, 23.3, 157.0].get((k - 2) as usize) {
            chart = chart.series(Series::new(&name, Origin::Paper, [(*area, 1.0)]));
        }
    }
    chart
}

fn load() -> Chart {
    let curve = |k: f64| areas(20).map(move |area| (area, 0.35 + 0.6 / (1.0 + (area.log10() - k).powi(2))));
    Chart::new("load", "Load of a pipeline's stages", Axis::log("area S, pixels"), Axis::linear("load"))
        .note("Points of one kind are joined for the eye.")
        .series(Series::new("transactions", Origin::model([1]), curve(2.0)))
        .series(Series::new("clock by clock", Origin::rtl([1]), curve(2.2).step_by(4).chain([(0.0, 0.5)])))
}

fn verdicts() -> Verdicts {
    let k = || "k".to_owned();
    Verdicts::new("statements", "Statements, each by the rule beneath it")
        .state(
            Statement::new(
                "MPG-EQ4",
                "Beyond an area Sₖ the performance no longer grows fourfold from step to step.",
                Rule::Within { percent: 1.0 },
            )
            .unit("pixels")
            .paper([("k = 2", 1.8), ("k = 3", 23.3), ("k = 4", 157.0)])
            .found(Origin::Formula, [("k = 2", 1.8044), ("k = 3", 23.3351), ("k = 4", 156.921)]),
        )
        .state(
            Statement::new(
                "MPG-F5A",
                "The matrix’s relative performance grows with the matrix.",
                Rule::Increases { with: k() },
            )
            .found(Origin::rtl([1, 2, 3]), [("k = 1", 0.088), ("k = 2", 0.127), ("k = 3", 0.169), ("k = 4", 0.221)]),
        )
        .state(
            Statement::new("MPG-F6A", "At S = 1000 performance grows almost as 4ᵏ.", Rule::Within { percent: 10.0 })
                .unit("times")
                .paper([("k = 1", 4.0), ("k = 2", 16.0), ("k = 3", 64.0), ("k = 4", 256.0)])
                .found(Origin::model([1, 2, 3]), [("k = 1", 3.81), ("k = 2", 13.9), ("k = 3", 47.1), ("k = 4", 141.4)])
                .because([
                    "The 16 x 16 matrix is near its turning point at this area, so its last level already has windows that it shares with its neighbours.",
                    "“Almost” would have to mean half, or the statement would have to be of areas from 10⁵ pixels on.",
                ]),
        )
        .state(
            Statement::new("MPG-EQ1", "No level has more windows than equation 1 says.", Rule::AtMost)
                .formula(areas(10).map(|area| (format!("S = {area:.0}"), windows_of(2, area))))
                .found(
                    Origin::rtl([1, 2, 3, 4, 5]),
                    areas(10).map(|area| (format!("S = {area:.0}"), windows_of(2, area) * 0.96)),
                ),
        )
        .state(
            Statement::new(
                "MPG-TREE",
                "For 1 < S < … it is as fast as a full tree, at three orders better efficiency.",
                Rule::WithinFactor { factor: 2.0 },
            )
            .paper([1000.0])
            .cannot_be_compared("the upper bound of the range is illegible in the scan"),
        )
}

fn transfer() -> Timeline {
    let lane = |number: u32| {
        let start = f64::from(number);
        let lane =
            Lane::new(format!("sender {number}")).span("computing", 0.0, start).span("sending", start, start + 1.0);
        lane.span("waiting", start + 1.0, 6.0).event("1", "the first word", start).event(
            "2",
            "the last word",
            start + 1.0,
        )
    };
    let chart =
        Timeline::new("transfer", "Who sends when", "time, ms", Origin::rtl([1])).note("Two events beside each other.");
    (0..4)
        .map(lane)
        .fold(chart, Timeline::lane)
        .lane(Lane::new("bus").event("3", "it is free", 4.05).event("4", "it stops", 4.1))
}

/// Spans that follow one another from zero, of more kinds than there are colours.
fn bars() -> Timeline {
    let kinds = ["clear", "geometry", "raster", "send", "receive", "stall", "bus", "overflow", "sync", "swap"];
    let lane = |n: u32| {
        let mut end = 0.0;
        kinds.iter().enumerate().fold(Lane::new(format!("n = {n}")), |lane, (number, kind)| {
            let from = end;
            end += f64::from(n + 3 * number as u32 % 7);
            lane.span(*kind, from, end)
        })
    };
    [1, 4, 16]
        .map(lane)
        .into_iter()
        .fold(Timeline::new("bars", "Stacked bars", "clocks", Origin::model([])), Timeline::lane)
}

fn dots() -> Picture {
    let png = include_bytes!("../../examples/dots.png").to_vec();
    Picture::new("dots", "A picture of eight by eight pixels", "a light dot above a dark one", png)
        .note("Enlarged, its pixels stay sharp.")
}

fn wide() -> Picture {
    let png = include_bytes!("../../examples/wide.png").to_vec();
    Picture::new("wide", "A picture of 900 by 120 pixels", "two rows of dark and light squares", png)
}

fn busy() -> HeatMap {
    let clocks = |y: i32, x: i32| f64::from(9000 + (x * 37 + y * 91) % 160 * 17 - (x - 2) * (y - 1) * 90);
    let rows = (0..4).map(|y| (0..4).map(|x| clocks(y, x)).collect());
    HeatMap::new("busy", "Busy clocks of each processor", "clocks", Origin::rtl([]), rows).note("A matrix of 4x4.")
}

fn fine() -> HeatMap {
    let rows = (0..12).map(|y| (0..24).map(|x| f64::from((x - 11) * (x - 11) + (y - 5) * (y - 5) * 3)).collect());
    HeatMap::new("fine", "A finer grid", "", Origin::Formula, rows)
        .note("Each cell says its number to who points at it.")
}

fn forms() -> Table {
    let row =
        |form: &str, units: f64, clocks: f64, share: f64| [form.into(), units.into(), clocks.into(), share.into()];
    Table::new(
        "forms",
        "The three forms of a raster processor",
        ["form", "coverage-test units", "clocks for the longest polygon", "utilisation"],
    )
    .row(row("stack", 1.0, 1_398_105.0, 1.0))
    .row(row("pipe", 10.0, 1_048_581.0, 0.133_333))
    .row(row("tree", 349_525.0, 5.0, 0.8))
}
