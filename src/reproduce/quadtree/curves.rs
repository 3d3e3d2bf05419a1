//! Figures 3 to 6 of the paper: curves of its formulas, and counted points.

use super::found::Found;
use super::{SIZES, areas, by_formula, matrix, shape};
use crate::reproduce::words::{percent, short};
use tilewright_machines::quadtree::Figures;
use tilewright_machines::quadtree::model::Measured;
use tilewright_report::{Axis, Chart, Origin, Section, Series};

const AREA: &str = "area S, pixels";

/// Figure 3: the windows of each level, a chart for each matrix.
pub fn windows(found: &Found) -> Section {
    let section = Section::new("Figure 3: windows of each level").paragraph(format!(
        "On the first levels a polygon is in one window; on the last levels it is in one window for each of its pixels there. The lines are the paper’s upper bound of the mean, equation 1. The points are \
             means over rectangles that are entirely on the screen. Corners are snapped to 1/16 pixel, so the mean area of the counted rectangles is off by up to {:.2} %.",
        100.0 * found.counted.snapping()
    ));
    SIZES.into_iter().fold(section, |section, k| {
        let matrix = matrix(k);
        let title = format!("Windows per polygon in each of {} processors (k = {k})", matrix.processors());
        let chart = Chart::new(format!("windows-{k}"), title, Axis::log(AREA), Axis::log("windows per polygon"));
        let chart = (1..=matrix.levels).fold(chart, |chart, number| {
            let (name, level) = (format!("level {number}"), number as usize);
            let counted = found.counted.of(k).map(|point| (point.sample.area, point.windows[level].mean)).collect();
            let bound = |area| matrix.windows_of(shape(area), number);
            measured(found, chart, k, &name, bound, Some(counted), |it| it.windows[level])
        });
        let last = |area| short(found.counted.at(k, area).windows[matrix.levels as usize].mean);
        let claim = format!(
            "On the last level each of {} processors has {} windows for a polygon of one pixel, and {} for one of 1000.",
            matrix.processors(),
            last(1.0),
            last(1000.0)
        );
        section.figure(claim, chart)
    })
}

/// Figure 4: the size of windows over their spacing.
pub fn window_sizes(found: &Found) -> Section {
    let chart =
        Chart::new("window-sizes", "Relative size of windows, a_i", Axis::linear("level i"), Axis::linear("a_i"));
    let chart = found.window_sizes.iter().fold(chart, |chart, sizes| {
        let (matrix, name) = (sizes.matrix, format!("k = {}", sizes.matrix.p.ilog2()));
        let by_level =
            |sizes: &[f64]| (1..).zip(sizes).map(|(level, size)| (f64::from(level), *size)).collect::<Vec<_>>();
        let by_formula: Vec<f64> = (1..=matrix.levels).map(|level| matrix.relative_window(level).0).collect();
        chart
            .series(Series::new(&name, Origin::Formula, by_level(&by_formula)))
            .series(Series::new(&name, Origin::model([]), by_level(&sizes.model)))
            .series(Series::new(&name, Origin::rtl([]), by_level(&sizes.hardware)))
    });
    Section::new("Figure 4: relative window sizes")
        .paragraph(
            "With an aperture of 2 and k > 1, the windows of the last level are smaller than their spacing. So a small polygon can lie between them. The points are measured: a square of a quarter of \
             a pixel moves along a line, and counters tell in how many windows it is.",
        )
        .figure("With more than four processors windows are smaller than their spacing, most of all on the last level.", chart)
}

/// Figure 5: the matrix of processors with stacks.
pub fn stacks(found: &Found) -> Section {
    let at = |k, area, of: fn(&Figures) -> f64| percent(of(&found.counted.at(k, area).figures));
    let speed = format!(
        "256 stacks reach {} of P_max for polygons of one pixel, and one stack {}.",
        at(4, 1.0, |it| it.p_s),
        at(0, 1.0, |it| it.p_s)
    );
    let efficiency = format!(
        "A large matrix of stacks wastes most of its work: at 100 pixels 4 stacks are {} efficient, and 256 are {}.",
        at(1, 100.0, |it| it.q_a),
        at(4, 100.0, |it| it.q_a)
    );
    Section::new("Figure 5: processors with stacks")
        .figure(speed, of_clocks(found, "stack-performance", "Performance p_s, over P_max", true, |it| it.p_s))
        .figure(efficiency, of_clocks(found, "stack-efficiency", "Efficiency Q_a", false, |it| it.q_a))
}

/// Figure 6: the matrix of pipelines.
pub fn pipelines(found: &Found) -> Section {
    let at = |k, area, of: fn(&Figures) -> f64| of(&found.counted.at(k, area).figures);
    let faster = |area| short(at(4, area, |it| it.p_p) / at(0, area, |it| it.p_p));
    let speed = format!(
        "256 pipelines are {} times as fast as one at 1000 pixels, and {} times at 100\u{202f}000.",
        faster(1000.0),
        faster(1e5)
    );
    let loads = found.counted.of(4).map(|point| (point.figures.r_p, point.sample.area));
    let greatest = loads.max_by(|one, other| one.0.total_cmp(&other.0));
    let (load, area) = greatest.expect("areas are counted");
    let load = format!("256 pipelines are loaded best, to {}, near {} pixels.", percent(load), short(area));
    let efficiency = format!(
        "At 100 pixels 256 pipelines are {} efficient, and 256 stacks {}.",
        percent(at(4, 100.0, |it| it.q_p)),
        percent(at(4, 100.0, |it| it.q_a))
    );
    Section::new("Figure 6: pipelines")
        .figure(speed, of_clocks(found, "pipeline-performance", "Performance p_p, over P_max", true, |it| it.p_p))
        .figure(load, of_clocks(found, "pipeline-load", "Load R_p", false, |it| it.r_p))
        .figure(efficiency, of_clocks(found, "pipeline-efficiency", "Efficiency Q_p", false, |it| it.q_p))
}

/// A quantity that follows from the busy clocks of the levels, from any of the programs.
fn of_clocks(found: &Found, id: &str, title: &str, logarithmic: bool, of: fn(&Figures) -> f64) -> Chart {
    figure(found, (id, title, logarithmic), of, Some(of), move |it| of(&it.figures))
}

/// A quantity of all matrices by area: by formula, counted if possible, and measured on the machines.
pub fn figure(
    found: &Found,
    (id, title, logarithmic): (&str, &str, bool),
    formula: fn(&Figures) -> f64,
    count: Option<fn(&Figures) -> f64>,
    of: impl Fn(&Measured) -> f64,
) -> Chart {
    let y = if logarithmic { Axis::log(title) } else { Axis::linear(title) };
    let chart = Chart::new(id, title, Axis::log(AREA), y);
    (0..=4).fold(chart, |chart, k| {
        let counted = |of: fn(&Figures) -> f64| {
            found.counted.of(k).map(|point| (point.sample.area, of(&point.figures))).collect::<Vec<_>>()
        };
        let curve = |area| formula(&by_formula(k, area));
        measured(found, chart, k, &format!("k = {k}"), curve, count.map(counted), &of)
    })
}

/// The chart with a curve by formula, also at the areas of all points, and with counted and measured points.
fn measured(
    found: &Found,
    chart: Chart,
    k: u32,
    name: &str,
    formula: impl Fn(f64) -> f64,
    counted: Option<Vec<(f64, f64)>>,
    of: impl Fn(&Measured) -> f64,
) -> Chart {
    let mut everywhere: Vec<f64> = areas().chain(found.counted.areas()).collect();
    everywhere.sort_by(f64::total_cmp);
    everywhere.dedup();
    let curve = everywhere.into_iter().map(|area| (area, formula(area)));
    let chart = chart.series(Series::new(name, Origin::Formula, curve));
    let chart = match counted {
        Some(points) => chart.series(Series::new(name, found.counted.origin(), points)),
        None => chart,
    };
    chart.series(Series::new(name, found.ran.model(), found.ran.on_model(k, &of))).series(Series::new(
        name,
        found.ran.rtl(),
        found.ran.on_hardware(k, &of),
    ))
}
