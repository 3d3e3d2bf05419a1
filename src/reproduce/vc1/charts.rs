//! The paper's figures, each by time T and by drawing time D, and the clocks by class.

use super::found::Found;
use super::frames::Drawn;
use super::plan::{BLANKINGS, CAPACITIES, Capacity, Case, Plan, SPLITS, THRESHOLD, split};
use super::run::Timed;
use super::statements::derived;
use super::words;
use super::{claims, estimate};
use tilewright_machines::vc1::Clocks;
use tilewright_report::{Axis, Chart, Lane, Origin, Section, Series, Timeline};
use tilewright_rtl::gfb::Blanking;
use tilewright_scenes::Size;

/// The quantity of a case in a chart.
type Quantity = (&'static str, &'static str, fn(&Timed) -> f64);

const TIME: Quantity = ("", "T, ms", |it| it.time);
const DRAWING: Quantity = ("-drawing", "D, ms", |it| it.drawing);

/// Figure 7.
pub fn figure_7(found: &Found, frames: &[Drawn]) -> Section {
    let terrain = if found.plan.is_quick() { "ter1k" } else { "ter250" };
    Section::new("Figure 7: time by the number of processing elements")
        .paragraph(words::TIMES)
        .paragraph(
            "The interval between two swaps is a whole number of refreshes, at least two, or 33.3 ms. So with 35 ms of drawing some frames take two refreshes and some take three. T cannot be below 33.3 ms, \
             while D can.",
        )
        .paragraph(
            "Crosses are the numbers that the text gives. The line follows for ter250 from the paper’s rates and its speed-up.",
        )
        .figure(claims::time(found), by_processors(found, frames, TIME))
        .figure(claims::drawing(found), by_processors(found, frames, DRAWING))
        .figure(claims::estimate(found), estimate::chart(found))
        .paragraph(
            "These are the mean clocks of a processing element, in percent of the time from frame to frame. “Stalled” is an access that waits for its local frame buffer, and “bus” a word \
             that waits for the bus. “Overflow” waits for the swap of an overflow, “sync” for the other processing elements, and “swap” for the swap at the end of a frame.",
        )
        .figure(claims::waiting(found, "table"), classes(found, "table"))
        .figure(claims::waiting(found, terrain), classes(found, terrain))
}

fn by_processors(found: &Found, frames: &[Drawn], (id, label, of): Quantity) -> Chart {
    let plan = &found.plan;
    let modelled = |scene, n| Some(of(found.of(plan.case(scene, n))?));
    let chart = modelled_by_processors(plan, (id, label), &modelled);
    if id.is_empty() {
        return from_the_text(chart, plan);
    }
    plan.scenes().iter().fold(chart, |chart, scene| {
        let drawn = frames.iter().filter(|it| it.spec.case == plan.case(scene, it.spec.case.processors));
        let drawn: Vec<_> = drawn.map(|it| (f64::from(it.spec.case.processors), it.drawing())).collect();
        chart.series(Series::new(*scene, Origin::rtl([]), drawn))
    })
}

/// Figure 7 with the model's numbers.
fn modelled_by_processors(
    plan: &Plan,
    (id, label): (&str, &str),
    of: &dyn Fn(&'static str, u32) -> Option<f64>,
) -> Chart {
    let chart = Chart::new(
        format!("figure-7{id}"),
        format!("Figure 7: {label} by the number of processing elements"),
        Axis::log("processing elements n"),
        Axis::log(label),
    );
    plan.scenes().iter().fold(chart, |chart, scene| {
        let points = plan.processors().iter().filter_map(|n| Some((f64::from(*n), of(scene, *n)?)));
        chart.series(Series::new(*scene, Origin::model([]), points))
    })
}

/// Adds the numbers that the text gives for Figure 7, and those that follow from them.
fn from_the_text(chart: Chart, plan: &Plan) -> Chart {
    let paper = |chart: Chart, scene: &&str| chart.series(Series::new(*scene, Origin::Paper, [(256.0, 33.3)]));
    let chart = plan.scenes().iter().fold(chart, paper);
    match plan.scenes().contains(&"ter250") {
        true => chart.series(Series::new("ter250", Origin::Formula, derived().map(|(n, time)| (f64::from(n), time)))),
        false => chart,
    }
}

/// The clocks of a scene by class.
fn classes(found: &Found, scene: &'static str) -> Timeline {
    let chart = Timeline::new(
        format!("classes-{scene}"),
        format!("Where the clocks of a processing element go: {scene}"),
        "percent of the time from frame to frame",
        found.model(),
    );
    let lane = |n: &u32| {
        let timed = found.of(found.plan.case(scene, *n))?;
        let all: f64 = timed.clocks.iter().sum();
        let (mut lane, mut end) = (Lane::new(format!("n = {n}")), 0.0);
        for (name, clocks) in Clocks::NAMES.iter().zip(timed.clocks) {
            let from = end;
            end += 100.0 * clocks / all;
            lane = lane.span(*name, from, end);
        }
        Some(lane)
    };
    found.plan.processors().iter().filter_map(lane).fold(chart, Timeline::lane)
}

/// Figure 8.
pub fn figure_8(found: &Found) -> Section {
    let section = Section::new("Figure 8: time by image memory").paragraph(
        "With a capacity c each of the two buffers of a processing element has floor(19,200 c) pages of 4x4 pixels. The threshold is 500 pixels with 16 processing elements and 31 with 256.",
    );
    ["figure-8a", "figure-8b"].into_iter().zip(found.plan.figure_8()).fold(section, |section, (id, n)| {
        [TIME, DRAWING].into_iter().fold(section, |section, quantity| {
            section.figure(claims::memory(found, *n, &quantity.1[..1], quantity.2), by_memory(found, id, *n, quantity))
        })
    })
}

fn by_memory(found: &Found, id: &str, n: u32, (kind, label, of): Quantity) -> Chart {
    let plan = &found.plan;
    let chart = Chart::new(
        format!("{id}{kind}"),
        format!("Figure 8: {label} by image memory, n = {n}"),
        Axis::log("capacity c, parts of the screen"),
        Axis::log(label),
    );
    plan.scenes().iter().fold(chart, |chart, scene| {
        let point = |part: &u32| Some((1.0 / f64::from(*part), of(found.of(plan.in_memory(scene, n, *part))?)));
        chart.series(Series::new(*scene, found.model(), plan.capacities().iter().rev().filter_map(point)))
    })
}

/// Where no threshold is drawn: no packet is larger than the screen.
fn place(threshold: Option<u32>) -> f64 {
    threshold.map_or(Size::VGA.pixels() as f64, f64::from)
}

fn when(blanking: Blanking) -> &'static str {
    if blanking == Blanking::AtStart { "at start" } else { "in blanking" }
}

/// Figure 9.
pub fn figure_9(found: &Found) -> Section {
    let plan = &found.plan;
    let paper = |apr| plan.at_threshold(Capacity::Paper, Blanking::AtStart, apr);
    Section::new("Figure 9: time by the threshold")
        .paragraph(
            "The scene is the table, with 16 processing elements. The text says neither how much memory they have in the figure, nor where in the blanking the global frame buffer swaps. So there are two \
             capacities, two ways to swap, and a machine with pages for all patches, which never overflows. The rightmost points, at the pixels of the whole screen, have no threshold. The cross is \
             the paper’s 75 %.",
        )
        .figure(claims::saved(found), relative(found))
        .figure(
            claims::least(found),
            by_threshold(found, "figure-9-times", "T and D by the threshold, 1/4.7 of the screen", &[
                ("T", TIME.2, &paper),
                ("D", DRAWING.2, &paper),
            ]),
        )
        .paragraph(
            "The text gives no costs of the steps of rasterization, only their sum for ter1k, 754 clocks a polygon. The figure has three ways to split it: 500, 300 or 100 clocks for the set-up of a \
             packet, and the rest for its rows.",
        )
        .figure(claims::splits(found), splits(found))
}

/// T over T without a threshold.
fn relative(found: &Found) -> Chart {
    let plan = &found.plan;
    let chart = Chart::new(
        "figure-9",
        "Figure 9: time by the threshold, over that without",
        Axis::log("threshold, pixels"),
        Axis::linear("T / T(off)"),
    );
    let machines = CAPACITIES.into_iter().flat_map(|capacity| BLANKINGS.map(|blanking| (capacity, blanking)));
    let chart = machines.chain([(Capacity::Part(1), Blanking::AtStart)]).fold(chart, |chart, (capacity, blanking)| {
        let time = |apr| Some(found.of(plan.at_threshold(capacity, blanking, apr))?.time);
        let points = plan.thresholds().filter_map(|apr| Some((place(apr), time(apr)? / time(None)?)));
        chart.series(Series::new(format!("{}, {}", capacity.name(), when(blanking)), found.model(), points))
    });
    chart.series(Series::new("75 %", Origin::Paper, [(f64::from(THRESHOLD), 0.75)]))
}

type Curve<'a> = (&'a str, fn(&Timed) -> f64, &'a dyn Fn(Option<u32>) -> Case);

fn by_threshold(found: &Found, id: &str, title: &str, curves: &[Curve]) -> Chart {
    let chart = Chart::new(id, format!("Figure 9: {title}"), Axis::log("threshold, pixels"), Axis::linear("ms"));
    curves.iter().fold(chart, |chart, (name, of, case)| {
        let points = found.plan.thresholds().filter_map(|apr| Some((place(apr), of(found.of(case(apr))?))));
        chart.series(Series::new(*name, found.model(), points))
    })
}

fn splits(found: &Found) -> Chart {
    let chart = Chart::new(
        "figure-9-splits",
        "Figure 9: T and D by the threshold, for three splits of the clocks",
        Axis::log("threshold, pixels"),
        Axis::linear("ms"),
    );
    SPLITS.into_iter().fold(chart, |chart, set_up| {
        let row = split(set_up).row;
        [TIME, DRAWING].into_iter().fold(chart, |chart, (_, label, of)| {
            let point = |apr| Some((place(apr), of(found.of(found.plan.with_split(set_up, apr))?)));
            let name = format!("{}, set-up {set_up}, row {row}", &label[..1]);
            chart.series(Series::new(name, found.model(), found.plan.thresholds().filter_map(point)))
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reproduce::effort::Effort;
    use crate::reproduce::vc1::run::Job;
    use std::path::PathBuf;

    /// A file of the documentation.
    fn kept(name: &str) -> PathBuf {
        [env!("CARGO_MANIFEST_DIR"), "docs", name].iter().collect()
    }

    /// The chart is drawn of the numbers in the file beside it, and those of fast machines are compared with the model's. With `UPDATE_GOLDEN=1` both files
    /// are made anew, which takes minutes.
    #[test]
    fn figure_7_of_the_documentation_is_the_pages() -> Result<(), Box<dyn std::error::Error>> {
        let plan = Plan::new(Effort { seed: 1, most: None });
        let [csv, svg] = ["vc1-figure-7.csv", "vc1-figure-7.svg"].map(kept);
        if std::env::var_os("UPDATE_GOLDEN").is_some() {
            let of_scene = |scene: &&'static str| plan.processors().iter().map(|n| plan.case(scene, *n)).collect();
            let cases: Vec<Vec<Case>> = plan.scenes().iter().map(of_scene).collect();
            let chart = by_processors(&Found::of_cases(&plan, &cases.concat()), &[], TIME);
            std::fs::write(&csv, chart.csv_text())?;
            std::fs::write(&svg, chart.svg_text())?;
        }
        let (numbers, drawn) = (std::fs::read_to_string(csv)?, std::fs::read_to_string(svg)?);
        let number = |scene: &str, n: u32| {
            let row = numbers.lines().find_map(|line| line.strip_prefix(&format!("{scene},{n},")))?;
            row.split(',').nth(2)?.parse::<f64>().ok()
        };
        let chart = from_the_text(modelled_by_processors(&plan, (TIME.0, TIME.1), &number), &plan);
        assert_eq!(chart.csv_text(), numbers);
        assert!(chart.svg_text() == drawn, "UPDATE_GOLDEN=1 cargo test --bin tilewright figure_7_of draws it anew");
        for (scene, n) in [("teapot", 1), ("teapot", 16)] {
            let timed = Job::of(&plan.case(scene, n), &plan)?.run(&plan)?;
            assert_eq!(Some(timed.time), number(scene, n), "{scene} {n}");
        }
        Ok(())
    }
}
