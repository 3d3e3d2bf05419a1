//! Draws charts. `plotters` lays out axes and grid. This module has the scales, the points, and the SVG backend.

mod file;
mod label;
mod legend;
mod mark;
mod scale;
mod svg;
mod timeline;

pub use file::{svg_file, svg_file_of_times};
pub use legend::legend;
pub use timeline::{sample_of_span, svg_of_times};

use crate::chart::{Chart, Series};
use crate::origin::Origin;
use label::Label;
use mark::{Paint, mark};
use maud::{Markup, PreEscaped, html};
use plotters::chart::ChartContext;
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters_backend::DrawingErrorKind;
use scale::Scale;
use std::cell::RefCell;
use std::convert::Infallible;
use std::rc::Rc;
use svg::{Svg, TENTHS};

/// The size of a chart in CSS pixels. Text does not shrink with a picture, so narrow screens have a chart of their own.
#[derive(Debug, Clone, Copy)]
pub struct Format {
    class: &'static str,
    width: u32,
    height: u32,
    /// The approximate number of labels along an axis.
    labels: (usize, usize),
    /// The most characters in a line of a name beside its curve.
    longest: usize,
    /// The approximate width of a character of the names of lanes and bars.
    character: i32,
}

/// A chart as wide as the text.
pub const WIDE: Format = Format { class: "wide", width: 720, height: 420, labels: (8, 10), longest: 20, character: 7 };
/// A chart for a telephone.
pub const NARROW: Format =
    Format { class: "narrow", width: 350, height: 320, labels: (4, 6), longest: 9, character: 7 };

/// A chart as an SVG element of that format.
pub fn svg(chart: &Chart, format: Format) -> Markup {
    html! {
        svg.chart.(format.class) viewBox={ "0 0 " (format.width) " " (format.height) } role="img" aria-label=(chart.alt()) {
            (elements(chart, format))
        }
    }
}

/// The elements of a chart.
fn elements(chart: &Chart, format: Format) -> Markup {
    let elements = Rc::default();
    let Ok(()) = drawn(chart, format, Rc::clone(&elements)).map_err(|error| match error {
        DrawingAreaErrorKind::BackendError(DrawingErrorKind::DrawingError(never)) => never,
        // Fonts and locked pictures are not involved, so nothing can fail.
        other => unreachable!("{other}"),
    });
    PreEscaped(elements.take())
}

/// The drawable part of a series.
struct Shown<'a> {
    /// The number of the series' name.
    number: usize,
    series: &'a Series,
    points: Vec<(f64, f64)>,
}

/// The series of a chart with the points that have a place on its axes.
fn shown(chart: &Chart) -> Vec<Shown<'_>> {
    let names = chart.names();
    let number = |series: &Series| names.iter().position(|name| *name == series.name).unwrap_or(0);
    let drawable = |(x, y): &(f64, f64)| chart.x.shows(*x) && chart.y.shows(*y);
    let points = |series: &Series| series.points.iter().copied().filter(drawable).collect();
    chart.series.iter().map(|series| Shown { number: number(series), series, points: points(series) }).collect()
}

type Area = DrawingArea<Svg, Shift>;
type Plot<'a> = ChartContext<'a, Svg, Cartesian2d<Scale, Scale>>;
type Drawn = Result<(), DrawingAreaErrorKind<Infallible>>;

fn drawn(chart: &Chart, format: Format, elements: Rc<RefCell<String>>) -> Drawn {
    let shown = shown(chart);
    let labels = label::labels(chart, &shown, format);
    let root = Svg::new(elements, (format.width, format.height)).into_drawing_area();
    let mut plot = axes(&root, chart, format, &shown, labels.iter().map(|label| label.width(format.character)).max())?;
    // Lines first, so that they hide no point.
    for Shown { number, series, points } in &shown {
        if let Some(paint) = line(chart, series) {
            plot.draw_series(LineSeries::new(points.iter().copied(), paint.line(*number)))?;
        }
    }
    for Shown { number, series, points } in &shown {
        let has_model = has_model(chart, series);
        plot.draw_series(points.iter().flat_map(|point| mark(*number, &series.origin, has_model, *point)))?;
    }
    names(&root, &plot, &labels)?;
    root.present()
}

/// The grid and the axes with their labels; that of the vertical axis is on top. `right` is the space for names at the ends of curves, in
/// tenths.
fn axes<'a>(
    root: &'a Area,
    chart: &Chart,
    format: Format,
    shown: &[Shown],
    right: Option<i32>,
) -> Result<Plot<'a>, DrawingAreaErrorKind<Infallible>> {
    let all = || shown.iter().flat_map(|it| &it.points);
    let x = Scale::around(all().map(|point| point.0), chart.x.logarithmic);
    let y = Scale::around(all().map(|point| point.1), chart.y.logarithmic);
    // Fine lines are at 2 to 9 between two powers of ten.
    let fine = |logarithmic| if logarithmic { 10 } else { 1 };
    let mut plot = ChartBuilder::on(root)
        .margin_top(26 * TENTHS)
        .margin_right(right.unwrap_or(0).max(12 * TENTHS))
        .x_label_area_size(44 * TENTHS)
        .y_label_area_size(y.label_width(format.labels.1))
        .build_cartesian_2d(x, y)?;
    plot.configure_mesh()
        .axis_style(Paint::Axis.line(0))
        .bold_line_style(Paint::Grid.line(0))
        .light_line_style(Paint::FineGrid.line(0))
        .x_labels(format.labels.0)
        .y_labels(format.labels.1)
        .x_max_light_lines(fine(chart.x.logarithmic))
        .y_max_light_lines(fine(chart.y.logarithmic))
        .set_all_tick_mark_size(4 * TENTHS)
        .label_style(Paint::Tick.text(0))
        .axis_desc_style(Paint::Label.text(0))
        .x_desc(chart.x.label.as_str())
        .draw()?;
    root.draw(&Text::new(chart.y.label.as_str(), (0, 4 * TENTHS), Paint::Label.text(0)))?;
    Ok(plot)
}

/// Whether there are points of a model with the series' name.
fn has_model(chart: &Chart, series: &Series) -> bool {
    chart.series.iter().any(|it| it.name == series.name && matches!(it.origin, Origin::Model { .. }))
}

/// The line through the points of a series, if it has one.
fn line(chart: &Chart, series: &Series) -> Option<Paint> {
    let has_curve = || chart.series.iter().any(|it| it.name == series.name && it.origin == Origin::Formula);
    match series.origin {
        Origin::Formula => Some(Paint::Curve),
        // The few points of the hardware lie on its model's line.
        Origin::Rtl { .. } if has_model(chart, series) => None,
        // Points without a curve are joined for the eye.
        Origin::Count { .. } | Origin::Model { .. } | Origin::Rtl { .. } => (!has_curve()).then_some(Paint::Thread),
        Origin::Paper => None,
    }
}

/// Names beside the ends of their curves. A name that had to move has a line to its curve. If curves meet on the right but not on the left,
/// names stand above their beginnings.
fn names(root: &Area, plot: &Plot, labels: &[Label]) -> Drawn {
    let sizes: Vec<i32> = labels.iter().map(Label::height).collect();
    let placed = |of: fn(&Label) -> (f64, f64), above: i32| {
        let points: Vec<(i32, i32)> = labels.iter().map(|label| plot.backend_coord(&of(label))).collect();
        let heights: Vec<i32> = points.iter().map(|point| point.1 - above).collect();
        let moved = label::apart_by(&heights, &sizes);
        let way: i32 = moved.iter().zip(&heights).map(|(moved, wanted)| (moved - wanted).abs()).sum();
        (way, points, moved)
    };
    let (right, ends, heights) = placed(|label| label.last, 0);
    let (left, starts, above) = placed(|label| label.first, ABOVE);
    let is_right = right <= left + label::LINE;
    let (points, heights, gap) = if is_right { (ends, heights, 16 * TENTHS) } else { (starts, above, 8 * TENTHS) };
    for ((label, point), height) in labels.iter().zip(points).zip(heights) {
        let style = Paint::Name.text(label.number).pos(Pos::new(HPos::Left, VPos::Center));
        if is_right && (height - point.1).abs() > label::LINE / 2 {
            let line = vec![(point.0 + 6 * TENTHS, point.1), (point.0 + 14 * TENTHS, height)];
            root.draw(&PathElement::new(line, Paint::Thread.line(label.number)))?;
        }
        for (number, line) in (0..).zip(&label.lines) {
            let place = height - label.height() / 2 + label::LINE / 2 + number * label::LINE;
            root.draw(&Text::new(*line, (point.0 + gap, place), style.clone()))?;
        }
    }
    Ok(())
}

/// The distance of a name above the beginning of its curve, in tenths.
const ABOVE: i32 = 10 * TENTHS;
