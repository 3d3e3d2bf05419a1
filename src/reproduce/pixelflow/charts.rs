//! The paper's figures, and where the time goes.

use super::found::{Curve, Found, Gain, Point};
use super::plan::{Case, EIGHT, GOAL, LATENCIES, Plan};
use crate::reproduce::words::{percent, short};
use tilewright_machines::pixelflow::{Samples, Shades, Simulated, System, Times};
use tilewright_report::{Axis, Cell, Chart, Origin, Section, Series, Table};

const THOUSANDS: f64 = 1000.0;

fn primitives() -> Axis {
    Axis::linear("thousand primitives")
}

/// Latency against primitives.
pub fn latencies(found: &Found) -> Section {
    Section::new("Latency")
        .paragraph(
            "One of the twenty nodes has the frame buffer, one or four shade, and the others rasterize. The number behind a system is that of its shaders; the non-texturing system needs none. The screen \
             of 640x512 pixels has 40 regions, and primitives are 10 pixels wide and high. Lines are the paper’s formulas with its constants. Hollow marks are the transaction model with random \
             boxes. The boxes are assigned to the rasterizers one after another, so that no load is balanced perfectly.",
        )
        .paragraph(
            "With eight samples the array has four of a pixel side by side, so a region has 64x32 pixels. There are 160 regions, and all are drawn twice. The formulas still compose and shade 40 \
             regions; the model composes all 320. In the first figure it shades each pixel once, from what its samples have in common. In the second it shades every sample.",
        )
        .figure(
            claim(found, EIGHT, Shades::OncePerPixel),
            figure(found, "figure-3", "Figure 3: eight samples, a pixel is shaded once", EIGHT, Shades::OncePerPixel),
        )
        .figure(
            claim(found, EIGHT, Shades::EverySample),
            figure(found, "figure-3-every-sample", "Figure 3: eight samples, every sample is shaded", EIGHT, Shades::EverySample),
        )
        .figure(
            claim(found, Samples::One, Shades::EverySample),
            figure(found, "figure-4", "Figure 4: one sample", Samples::One, Shades::EverySample),
        )
        .paragraph("The systems differ most in how many primitives they draw within the paper’s goal of 30 to 40 ms.")
        .part(within(found))
}

/// The primitives that the systems draw within the shortest latency of the goal; in a quick look, the time of the least frame.
fn claim(found: &Found, samples: Samples, shades: Shades) -> String {
    let curve = |system, shaders| found.curve(Plan::case(system, shaders, samples, shades));
    let [base, sorted, plain] =
        [(System::Base, 1), (System::PreSort, 1), (System::NonTexturing, 0)].map(|(s, n)| curve(s, n));
    let thousands = |curve: &Curve| curve.within(GOAL[0]).map(|it| short(it as f64 / THOUSANDS));
    match (thousands(base), thousands(sorted), thousands(plain)) {
        (Some(base), Some(sorted), Some(plain)) => format!(
            "In {} ms the base system with one shader draws {base} thousand primitives, pre-sorting {sorted}, and the non-texturing system {plain}.",
            GOAL[0]
        ),
        _ => format!(
            "The least frame takes {} ms on the base system with one shader, and {} ms on the non-texturing one.",
            short(base.least()),
            short(plain.least())
        ),
    }
}

fn figure(found: &Found, id: &str, title: &str, samples: Samples, shades: Shades) -> Chart {
    let chart = Chart::new(id, title, primitives(), Axis::linear("latency, ms"));
    Plan::cases(samples, shades).fold(chart, |chart, case| {
        let curve = found.curve(case);
        let at = |point: &Point| point.primitives as f64 / THOUSANDS;
        let formula = curve.points.iter().map(|point| (at(point), case.formula().latency(point.primitives as f64)));
        let model = curve.points.iter().map(|point| (at(point), point.found.latency));
        chart.series(Series::new(case.name(), Origin::Formula, formula)).series(Series::new(
            case.name(),
            found.origin(),
            model,
        ))
    })
}

fn within(found: &Found) -> Table {
    let latencies =
        LATENCIES.iter().flat_map(|latency| [format!("{latency} ms, formula"), format!("{latency} ms, model")]);
    let columns = ["system".to_owned(), "samples".to_owned()].into_iter().chain(latencies);
    let table = Table::new("primitives", "Primitives of a frame within a latency", columns).note(
        "A dash means that the least frame takes longer, or that more primitives would be needed than were tried.",
    );
    found.curves.iter().fold(table, |table, curve| {
        let Curve { case, within, .. } = curve;
        let counts = LATENCIES.iter().zip(within).flat_map(|(latency, model)| {
            let formula = case.formula().primitives_within(*latency).floor();
            [Some(formula).filter(|it| *it > 0.0), model.map(|it| it as f64)]
        });
        let numbers = counts.map(|count| count.map_or(Cell::from("–"), Cell::Number));
        table.row([Cell::from(case.name()), Cell::from(in_words(case))].into_iter().chain(numbers))
    })
}

fn in_words(case: &Case) -> &'static str {
    match (case.samples, case.choices.shades) {
        (Samples::One, _) => "one",
        (_, Shades::OncePerPixel) => "eight, shaded once",
        (_, Shades::EverySample) => "eight, each one shaded",
    }
}

/// The time of a stage.
type Stage = fn(&Times) -> f64;

/// The stages of a frame.
const STAGES: [(&str, Stage); 6] = [
    ("front end", |it| it.front),
    ("second pass", |it| it.generate),
    ("rasterizers", |it| it.rasterize),
    ("network", |it| it.compose),
    ("shaders", |it| it.shade),
    ("frame buffer", |it| it.load),
];

/// Where the time goes.
pub fn stages(found: &Found) -> Section {
    let section = Section::new("Where the time goes").paragraph(
        "These are the times in which each stage was busy in the model; of several nodes, that of the busiest. In a system that sorts, latency is the sum of three times: that of the front end, that of the \
             slowest stage behind it, and that to fill the pipe. The non-texturing system’s front end works while it rasterizes.",
    );
    let of = |system, shaders, samples| Plan::case(system, shaders, samples, Shades::OncePerPixel);
    [
        ("stages-base", of(System::Base, 1, EIGHT)),
        ("stages-pre-sort", of(System::PreSort, 1, EIGHT)),
        ("stages-non-texturing", of(System::NonTexturing, 0, EIGHT)),
        ("stages-base-one-sample", of(System::Base, 1, Samples::One)),
    ]
    .into_iter()
    .fold(section, |section, (id, case)| section.figure(slowest(found, case), busy(found, id, case)))
}

/// The slowest stage with the most primitives.
fn slowest(found: &Found, case: Case) -> String {
    let last = found.curve(case).points.last().expect("there are points");
    let times = STAGES.map(|(name, of)| (name, of(&last.found.busy)));
    let (name, time) = times.into_iter().rev().max_by(|one, other| one.1.total_cmp(&other.1)).unwrap_or_default();
    format!(
        "At {} thousand primitives the bottleneck is the {name}: {} of {} ms.",
        short(last.primitives as f64 / THOUSANDS),
        short(time),
        short(last.found.latency)
    )
}

fn busy(found: &Found, id: &str, case: Case) -> Chart {
    let title = format!("Stages: {}, samples: {}", case.name(), in_words(&case));
    let curve = |of: &dyn Fn(&Simulated) -> f64| {
        let points = found.curve(case).points.iter();
        points.map(|point| (point.primitives as f64 / THOUSANDS, of(&point.found))).collect::<Vec<_>>()
    };
    let chart = Chart::new(id, title, primitives(), Axis::linear("ms"));
    let chart = chart.series(Series::new("latency", found.origin(), curve(&|it| it.latency)));
    STAGES.iter().fold(chart, |chart, (name, of)| {
        let points = curve(&|it| of(&it.busy));
        if points.iter().all(|(_, time)| *time == 0.0) {
            chart
        } else {
            chart.series(Series::new(*name, found.origin(), points))
        }
    })
}

/// Whether pre-sorting pays.
pub fn pre_sorting(found: &Found) -> Section {
    let chart = Chart::new(
        "pre-sorting",
        "The gain of pre-sorting at 35 ms, with one shader",
        Axis::linear("µs to rasterize a primitive in a region"),
        Axis::linear("times the primitives of the base system"),
    )
    .note("A pixel of eight samples is shaded once. The paper’s own time of a primitive is 0.83 µs.");
    let chart =
        [(Samples::One, "one sample"), (EIGHT, "eight samples")].into_iter().fold(chart, |chart, (samples, name)| {
            let gains = || found.gains.iter().filter(move |gain| gain.of.samples == samples);
            chart
                .series(Series::new(name, Origin::Formula, gains().map(|gain| (gain.of.rasterizes, gain.formula))))
                .series(Series::new(
                    name,
                    found.origin(),
                    gains().filter_map(|gain| Some((gain.of.rasterizes, gain.model?))),
                ))
        });
    let of_circuit = |samples| {
        let is_here =
            move |gain: &&Gain| gain.of.samples == samples && (gain.of.latency, gain.of.set_up) == (35.0, 0.0);
        found.gains_of_circuit.iter().filter(is_here).filter_map(|gain| Some((gain.of.rasterizes, gain.model?)))
    };
    let chart = [(Samples::One, "one sample, our circuit’s time"), (EIGHT, "eight samples, our circuit’s time")]
        .into_iter()
        .fold(chart, |chart, (samples, name)| chart.series(Series::new(name, found.origin(), of_circuit(samples))));
    Section::new("Does pre-sorting pay?")
        .paragraph(
            "The paper finds that a separate pass for sorting gains 10 to 15 % between 30 and 40 ms, and nothing without antialiasing. That does not follow from its constants. At a \
             fixed latency a primitive takes 1.85 µs and its rasterization. With pre-sorting it takes 0.74 µs, and 1.45 µs or its rasterization, whichever is longer. So the gain is greatest where \
             the second pass and rasterization take equally long. Without antialiasing it is 10 to 15 % only if a primitive is rasterized in 0.45 to 0.55 µs, faster than in the paper. With eight \
             samples rasterization would have to take longer than was tried here.",
        )
        .figure(gained(found), chart)
        .paragraph(answer(found))
        .part(gains_of_circuit(found))
}

/// The gain of pre-sorting with the paper's own time of a primitive.
fn gained(found: &Found) -> String {
    let of = |samples| {
        let gain = found.gains.iter().find(|it| it.of.samples == samples && it.of.rasterizes == PAPERS_TIME);
        percent(gain.expect("the paper’s time is among them").formula - 1.0)
    };
    let (one, eight) = (of(Samples::One), of(EIGHT));
    format!(
        "By its own constants the paper’s pre-sorting gains {one} with one sample and {eight} with eight. The paper states no gain, and 10 to 15\u{a0}%."
    )
}

/// Microseconds to rasterize a primitive in the paper (PFL-TRAST).
const PAPERS_TIME: f64 = 0.83;

/// The gain in the circuit.
fn answer(found: &Found) -> String {
    let gains = |samples| {
        let all = found.gains_of_circuit.iter().filter(move |gain| gain.of.samples == samples);
        let percents = || all.clone().filter_map(|gain| Some(100.0 * (gain.model? - 1.0)));
        let (least, most) =
            percents().fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), it| (least.min(it), most.max(it)));
        match least <= most {
            true => format!("{least:.0} to {most:.0} %"),
            false => "an amount that was not measured".to_owned(),
        }
    };
    format!(
        "Our circuit differs in three ways. A triangle takes less time than in the paper, loads are not balanced, and each composition has a set-up, which the paper leaves out. So pre-sorting gains {} at 30 to 40 \
             ms without antialiasing, and {} with eight samples.",
        gains(Samples::One),
        gains(EIGHT)
    )
}

/// The gain of pre-sorting with the circuit's own times.
fn gains_of_circuit(found: &Found) -> Table {
    let columns = ["samples", "µs a primitive", "µs to set up", "latency, ms", "formula", "model"];
    let table = Table::new("pre-sorting-circuit", "The gain of pre-sorting with the circuit’s time of a triangle, with one shader", columns)
        .note("The gain is the number of primitives over that of the base system. The time of a triangle is the extra time of additional triangles in the circuit’s frames, below. The formula has no set-up.");
    found.gains_of_circuit.iter().fold(table, |table, Gain { of, formula, model }| {
        let samples = if of.samples == Samples::One { "one" } else { "eight, shaded once" };
        let numbers = [of.rasterizes, of.set_up, of.latency, *formula].map(Cell::Number);
        let model = model.map_or(Cell::from("–"), Cell::Number);
        table.row([Cell::from(samples)].into_iter().chain(numbers).chain([model]))
    })
}
