//! Frames for two eyes: both at once on halves of the nodes, or one after the other on all nodes.

use super::frames::{Drawn, Spec, of_triangles};
use super::plan::Plan;
use crate::reproduce::words::short;
use tilewright_machines::pixelflow::{Samples, Shades, Stereo, StereoReport, milliseconds};
use tilewright_report::{Axis, Cell, Chart, Origin, Rule, Section, Series, Statement, Table};

const WAYS: [(Stereo, &str); 2] = [(Stereo::Halved, "at once on halves"), (Stereo::Sequential, "one after another")];

/// Both eyes' frames.
struct Both {
    /// Triangles of each eye, in thousands.
    thousands: f64,
    /// Milliseconds until both frames are ready, by the formula and in the circuit.
    formula: f64,
    found: f64,
}

/// The frames of a system. Both eyes have the same triangles, so the circuit has drawn one frame for each way.
fn drawn(frames: &[Drawn], spec: Spec, stereo: Stereo) -> Vec<Both> {
    let both = |(thousands, drawn): (f64, &Drawn)| {
        let eyes = [drawn.report.clone(), drawn.report.clone()];
        Both {
            thousands,
            formula: drawn.software().stereo_latency(drawn.report.primitives as f64, stereo),
            found: milliseconds(StereoReport::new(stereo, 0.0, eyes).latency()),
        }
    };
    of_triangles(frames, Spec { is_half: stereo == Stereo::Halved, ..spec }).map(both).collect()
}

/// The section of both ways.
pub fn section(frames: &[Drawn], plan: &Plan) -> Section {
    Section::new("Two eyes")
        .paragraph(
            "For two eyes the paper prefers to divide the machine in half, to reduce latency, over rendering one frame after the other. In a halved machine each eye has ten nodes, one of which has its frame buffer. \
             One after the other, the front end goes on to the second frame while the first is drawn. The paper has no formula for either way; here both are composed of its formulas. Both eyes have \
             the same random triangles, so the circuit has drawn one frame for each way.",
        )
        .figure(claim(frames, plan), latencies(frames, plan))
        .part(crossings())
}

/// The faster way.
fn claim(frames: &[Drawn], plan: &Plan) -> String {
    let [halved, sequential] =
        WAYS.map(|(stereo, _)| drawn(frames, plan.stereo(), stereo).pop().expect("triangles are drawn"));
    format!(
        "With {} triangles both eyes’ frames are ready after {} ms on halves of the machine, and after {} ms one after another.",
        short(1000.0 * halved.thousands),
        short(halved.found),
        short(sequential.found)
    )
}

fn latencies(frames: &[Drawn], plan: &Plan) -> Chart {
    let chart = Chart::new(
        "stereo-latency",
        "Latency of two eyes’ frames in the circuit",
        Axis::linear("thousand primitives of each eye"),
        Axis::linear("until both are ready, ms"),
    )
    .note("The formula has the paper’s time of a triangle, and the overlap of the same triangles.");
    let spec = plan.stereo();
    WAYS.into_iter().fold(chart, |chart, (stereo, how)| {
        let (name, both) = (format!("{} {how}", spec.name()), drawn(frames, spec, stereo));
        let points = |of: fn(&Both) -> f64| both.iter().map(move |it| (it.thousands, of(it))).collect::<Vec<_>>();
        chart.series(Series::new(name.clone(), Origin::Formula, points(|it| it.formula))).series(Series::new(
            name,
            Origin::rtl([plan.effort.seed]),
            points(|it| it.found),
        ))
    })
}

/// The number of primitives from which one after another is faster, by the formulas.
fn crossings() -> Table {
    let columns = [
        "system",
        "samples",
        "least, on halves, ms",
        "least, one after another, ms",
        "primitives of each eye from which one after another is faster",
    ];
    let table = Table::new("stereo-crossings", "The faster way, by the formulas", columns)
        .note("A dash means that halves are never slower.");
    let cases = Plan::all_cases().filter(|case| case.choices.shades == Shades::EverySample);
    cases.fold(table, |table, case| {
        let samples = if case.samples == Samples::One { "one" } else { "eight" };
        let least = WAYS.map(|(stereo, _)| Cell::Number(case.formula().stereo_latency(0.0, stereo)));
        let from = case.formula().sequential_from().map_or(Cell::from("–"), |from| Cell::Number(from.round()));
        table.row([Cell::from(case.name()), Cell::from(samples)].into_iter().chain(least).chain([from]))
    })
}

/// What the paper expects.
pub fn statements(frames: &[Drawn], plan: &Plan) -> Vec<Statement> {
    let spec = plan.stereo();
    let [halved, sequential] = WAYS.map(|(stereo, _)| drawn(frames, spec, stereo));
    let ratios = |of: fn(&Both) -> f64| {
        let ratio = |(halved, sequential): (&Both, &Both)| {
            (format!("{} thousand", halved.thousands), of(sequential) / of(halved))
        };
        halved.iter().zip(&sequential).map(ratio).collect::<Vec<_>>()
    };
    let state = |how: &str, origin: Origin, found: Vec<(String, f64)>| {
        let text = "With some thousand primitives the frames of two eyes are ready sooner on halves of the machine than one after another";
        Statement::new("PFL section 3", format!("{text}: {how}, base system with 4 shaders."), Rule::AtLeast)
            .unit("time one after another, over that on halves")
            .paper([1.0])
            .found(origin, found)
    };
    vec![
        state("formula", Origin::Formula, ratios(|it| it.formula)),
        state("circuit", Origin::rtl([plan.effort.seed]), ratios(|it| it.found)),
    ]
}
