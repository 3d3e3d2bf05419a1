//! The load of the renderers, P_w: its bounds for every scene, its balance, and that of random vectors.

use super::bins::EXAMPLE;
use super::frames::Drawn;
use super::loads::{Load, Loads, renderers};
use super::plan::RENDERERS;
use crate::reproduce::words::short;
use tilewright_machines::pixel_planes::{greatest_load, greatest_load_of_whole_regions};
use tilewright_report::{Axis, Cell, Chart, Origin, Section, Series, Table};

/// The section of the loads.
pub fn section(loads: &Loads, frames: &[Drawn]) -> Section {
    let (regions, size) = (loads.regions.count(), loads.regions.size());
    Section::new("Load of the renderers, P_w")
        .paragraph(format!(
            "P_w is the number of primitives of the busiest renderer; a primitive counts once for each of its regions. By the paper P_w is at least P/B. That is reached if each primitive is in one \
             region and all B renderers have the same number. It is at most P R/B, which is reached if each primitive is in all R regions. Here the screen of {size} pixels has {regions} regions of \
             {side}x{side}. If B does not divide R, some renderer has one region more than others, and the greatest load is P ⌈R/B⌉.",
            side = loads.regions.side()
        ))
        .paragraph(
            "Plus signs are counted by a plain allocator. It takes the largest bins first and gives each region to the renderer that is free first; all primitives take equally long. Filled \
             marks are frames that the circuit drew, whose allocator goes by the clock.",
        )
        .figure(worst(loads, &SURFACES), between_bounds(loads, frames, "surfaces", &SURFACES))
        .figure(worst(loads, &LINES), between_bounds(loads, frames, "lines", &LINES))
        .part(table(loads, frames))
        .paragraph(
            "Balance compares the busiest renderer with the mean. With few regions per renderer, the fullest region decides.",
        )
        .figure(imbalance(loads), balance(loads, frames))
        .paragraph(
            "In perfect balance P_w of V vectors is H_v V/B, which by the paper’s H_v is 1.63 V/B. Chance matters less with more vectors. Two effects remain: regions are assigned as a \
             whole, and regions at the border have fewer vectors.",
        )
        .figure(crowded(loads), of_vectors(loads, frames))
}

const SURFACES: [&str; 3] = ["teapot", "ter1k", "ter250"];
const LINES: [&str; 3] = ["wireframe", "star", "vectors"];

/// The greatest load of these scenes, beside the upper bound.
fn worst(loads: &Loads, names: &[&str]) -> String {
    let all = names.iter().filter_map(|name| loads.of(name));
    let worst = all.map(|load| load.worst(RENDERERS) as f64 / load.least(RENDERERS)).fold(0.0, f64::max);
    format!(
        "With {RENDERERS} renderers no worst load is above {} P/B, where the bound is {} P/B.",
        short(worst),
        loads.regions.count()
    )
}

/// The balance of few and of many renderers.
fn imbalance(loads: &Loads) -> String {
    let most = tilewright_machines::pixel_planes::Config::MOST_RENDERERS;
    let worst = |b| short(loads.scenes.iter().map(|load| load.imbalance(b)).fold(0.0, f64::max));
    format!(
        "The worst load is at most {} times the mean with {RENDERERS} renderers, and {} times with {most}.",
        worst(RENDERERS),
        worst(most)
    )
}

/// The balance of the most vectors.
fn crowded(loads: &Loads) -> String {
    let crowd = loads.crowds.last().expect("vectors are counted");
    let worst = crowd.worst.by_box as f64 * f64::from(RENDERERS) / crowd.vectors as f64;
    let (vectors, balanced) = (short(crowd.vectors as f64), short(EXAMPLE.by_box(super::plan::SIDE)));
    format!(
        "Of {vectors} vectors the busiest renderer has {} V/B by boxes; in perfect balance that is {balanced} V/B.",
        short(worst)
    )
}

const RENDERER_AXIS: &str = "renderers B";

fn between_bounds(loads: &Loads, frames: &[Drawn], id: &str, names: &[&str]) -> Chart {
    let names: Vec<&str> = names.iter().copied().filter(|name| loads.of(name).is_some()).collect();
    let title = format!("The worst load between its bounds: {}", names.join(", "));
    let chart = Chart::new(format!("load-{id}"), title, Axis::linear(RENDERER_AXIS), Axis::log("P_w over P/B"));
    let regions = loads.regions.count();
    // In parts of P/B, whatever P is.
    let bound =
        |of: fn(usize, u32) -> f64| renderers().map(move |b| (f64::from(b), of(regions, b))).collect::<Vec<_>>();
    let bounds = [
        ("P/B", bound(|_, _| 1.0)),
        ("P R/B", bound(|regions, b| greatest_load(1.0, regions, b as usize) * f64::from(b))),
        ("P ⌈R/B⌉", bound(|regions, b| greatest_load_of_whole_regions(1, regions, b as usize) as f64 * f64::from(b))),
    ];
    let chart = bounds
        .into_iter()
        .fold(chart, |chart, (name, points)| chart.series(Series::new(name, Origin::Formula, points)));
    of_scenes(
        chart,
        loads,
        frames,
        &names,
        |load, b| load.worst(b) as f64 / load.least(b),
        |drawn| drawn.report.worst_load() as f64 / drawn.load.least(drawn.report.machine.renderers),
    )
}

fn balance(loads: &Loads, frames: &[Drawn]) -> Chart {
    let axis = Axis::linear("worst load over the mean");
    let chart = Chart::new("balance", "The worst load over the mean load", Axis::linear(RENDERER_AXIS), axis);
    let names: Vec<&str> = loads.scenes.iter().map(|load| load.name).collect();
    of_scenes(chart, loads, frames, &names, Load::imbalance, Drawn::imbalance)
}

/// A quantity of scenes by the number of renderers: counted, and of frames.
fn of_scenes(
    chart: Chart,
    loads: &Loads,
    frames: &[Drawn],
    names: &[&str],
    counted: impl Fn(&Load, u32) -> f64,
    drawn: impl Fn(&Drawn) -> f64,
) -> Chart {
    names.iter().filter_map(|name| loads.of(name)).fold(chart, |chart, load| {
        let points = renderers().map(|b| (f64::from(b), counted(load, b)));
        let frames = frames.iter().filter(|it| it.load.name == load.name);
        let frames: Vec<_> = frames.map(|it| (f64::from(it.report.machine.renderers), drawn(it))).collect();
        let chart = chart.series(Series::new(load.name, load.origin(), points));
        match frames.is_empty() {
            true => chart,
            false => chart.series(Series::new(load.name, Origin::rtl(load.seeds.clone()), frames)),
        }
    })
}

fn table(loads: &Loads, frames: &[Drawn]) -> Table {
    let columns = ["scene", "P", "in bins", "regions of one", "P/B", "P_w, plain count", "P_w, RTL", "P R/B"];
    let title = format!("Primitives and loads with {RENDERERS} renderers");
    let table = Table::new("loads", title, columns).note(
        "The last two scenes reach the bounds: one has a square in the middle of each region, the other the same number of squares that cover the whole screen.",
    );
    let drawn = |load: &Load| frames.iter().find(|it| it.load.name == load.name);
    let made = frames.iter().map(|it| &it.load).filter(|load| loads.of(load.name).is_none());
    loads.scenes.iter().chain(made).fold(table, |table, load| {
        let greatest = greatest_load(load.primitives as f64, loads.regions.count(), RENDERERS as usize);
        table.row([
            load.name.into(),
            (load.primitives as f64).into(),
            (load.binned() as f64).into(),
            load.regions().into(),
            load.least(RENDERERS).into(),
            (load.worst(RENDERERS) as f64).into(),
            drawn(load).map_or(Cell::from("–"), |it| Cell::Number(it.report.worst_load() as f64)),
            greatest.into(),
        ])
    })
}

fn of_vectors(loads: &Loads, frames: &[Drawn]) -> Chart {
    let chart = Chart::new(
        "load-of-vectors",
        format!("The worst load of random vectors of 45 degrees, with {RENDERERS} renderers"),
        Axis::log("vectors V"),
        Axis::linear("P_w over V/B"),
    )
    .note("Vectors of 50 pixels where regions have 128 a side.");
    let each = |number: u64, vectors: u64| number as f64 * f64::from(RENDERERS) / vectors as f64;
    let ends = || [loads.crowds.first(), loads.crowds.last()].into_iter().flatten().map(|it| it.vectors as f64);
    let level = |value: f64| ends().map(move |vectors| (vectors, value)).collect::<Vec<_>>();
    let counted = |of: fn(&super::loads::Crowd) -> u64| {
        loads.crowds.iter().map(move |crowd| (crowd.vectors as f64, each(of(crowd), crowd.vectors))).collect::<Vec<_>>()
    };
    // The length over a region's side is the same on all screens, and so are the formulas.
    let side = super::plan::SIDE;
    let chart = chart
        .series(Series::new("box", Origin::Formula, level(EXAMPLE.by_box(side))))
        .series(Series::new("box", loads.origin(), counted(|crowd| crowd.worst.by_box)))
        .series(Series::new("itself", Origin::Formula, level(EXAMPLE.tight(side))))
        .series(Series::new("itself", loads.origin(), counted(|crowd| crowd.worst.tight)));
    let drawn = frames.iter().filter(|it| it.load.name == "vectors");
    let points: Vec<_> =
        drawn.map(|it| (it.load.primitives as f64, each(it.report.worst_load(), it.load.primitives))).collect();
    chart.series(Series::new("itself", Origin::rtl(loads.origin().seeds()), points))
}
