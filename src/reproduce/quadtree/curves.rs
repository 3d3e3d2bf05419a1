//! Figures 3 to 6 of the paper: curves of its formulas, and points that were counted.

use super::{Counted, SIZES, areas, built_size, matrix, shape};
use tilewright_machines::quadtree::Figures;
use tilewright_report::{Axis, Chart, Origin, Section, Series};

const AREA: &str = "area S, pixels";

/// Figure 3: the windows of each level, a chart for each matrix.
pub fn windows(counted: &Counted) -> Section {
    let section = Section::new("Figure 3: windows of each level").paragraph(
        "On the first levels a polygon is in one window, on the last ones in as many as it has pixels there. The lines are the paper's upper \
         bound of the mean, equation 1; the points are means over rectangles that lie on the screen as a whole.",
    );
    SIZES.into_iter().fold(section, |section, k| {
        let matrix = matrix(k);
        let title = format!("Windows per polygon in each of {} processors (k = {k})", matrix.processors());
        let chart = Chart::new(format!("windows-{k}"), title, Axis::log(AREA), Axis::log("windows per polygon"));
        section.part((1..=matrix.levels).fold(chart, |chart, level| {
            let name = format!("level {level}");
            let bound = areas().map(|area| (area, matrix.windows_of(shape(area), level)));
            let found = counted.of(k).map(|point| (point.area, point.windows[level as usize].mean));
            beside(chart, &name, bound, Origin::model([counted.seed]), found)
        }))
    })
}

/// Figure 4: how large windows are, in parts of their spacing.
pub fn window_sizes() -> Section {
    let chart =
        Chart::new("window-sizes", "Relative size of windows, a_i", Axis::linear("level i"), Axis::linear("a_i"));
    let chart = SIZES.into_iter().fold(chart, |chart, k| {
        let matrix = matrix(k);
        let by_formula = (1..=matrix.levels).map(|level| (f64::from(level), matrix.relative_window(level).0));
        let as_built = (1..=matrix.levels).map(|level| (f64::from(level), built_size(k, level)));
        beside(chart, &format!("k = {k}"), by_formula, Origin::model([]), as_built)
    });
    Section::new("Figure 4: relative window sizes")
        .paragraph(
            "With an aperture of 2 the windows of the last level are smaller than their spacing if k > 1: a small polygon can fall between \
             them. The points are sizes in whole pixels as the coverage tests have them, over the spacing.",
        )
        .part(chart)
}

/// Figure 5: the matrix of processors with stacks.
pub fn stacks(counted: &Counted) -> Section {
    Section::new("Figure 5: processors with stacks")
        .part(figure(counted, "stack-performance", "Performance p_s, in parts of P_max", true, |it| it.p_s))
        .part(figure(counted, "stack-efficiency", "Efficiency Q_a", false, |it| it.q_a))
}

/// Figure 6: the matrix of pipelines.
pub fn pipelines(counted: &Counted) -> Section {
    Section::new("Figure 6: pipelines")
        .part(figure(counted, "pipeline-performance", "Performance p_p, in parts of P_max", true, |it| it.p_p))
        .part(figure(counted, "pipeline-load", "Load R_p", false, |it| it.r_p))
        .part(figure(counted, "pipeline-efficiency", "Efficiency Q_p", false, |it| it.q_p))
}

/// A quantity of all matrices over the area: by formula, and from clocks counted.
fn figure(counted: &Counted, id: &str, title: &str, logarithmic: bool, of: fn(&Figures) -> f64) -> Chart {
    let y = if logarithmic { Axis::log(title) } else { Axis::linear(title) };
    let chart = Chart::new(id, title, Axis::log(AREA), y);
    (0..=4).fold(chart, |chart, k| {
        let by_formula = areas().map(|area| (area, of(&super::by_formula(k, area))));
        let found = counted.of(k).map(|point| (point.area, of(&point.figures)));
        beside(chart, &format!("k = {k}"), by_formula, Origin::model([counted.seed]), found)
    })
}

/// The chart with a curve by formula, and what was found beside it.
fn beside(
    chart: Chart,
    name: &str,
    by_formula: impl Iterator<Item = (f64, f64)>,
    origin: Origin,
    found: impl Iterator<Item = (f64, f64)>,
) -> Chart {
    chart.series(Series::new(name, Origin::Formula, by_formula)).series(Series::new(name, origin, found))
}
