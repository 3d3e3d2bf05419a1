//! The legend: the shape and the dashes of each series, and the kind of point of each origin.

use super::label::are_beside;
use super::mark::{CROSS, LOOKS, PLUS, filled, outline};
use super::svg::points;
use super::{Format, NARROW, WIDE};
use crate::chart::Chart;
use crate::origin::Origin;
use crate::statement::in_full;
use maud::{Markup, html};

/// The series' names in their looks, unless they stand beside their curves; then the origins in plain ink.
pub fn legend(chart: &Chart) -> Markup {
    let names = chart.names();
    html! {
        // Labels that do not fit a wide chart do not fit a narrow one.
        @if !are_beside(chart, NARROW) {
            ul.legend.names.narrow[are_beside(chart, WIDE)] aria-label="Legend" {
                @for (number, name) in names.iter().enumerate() {
                    li { (sample(&format!("look{}", number % LOOKS), &of_name(chart, name), number)) (name) }
                }
            }
        }
        ul.legend.origins aria-label="Kinds of marks" {
            @for origin in origins(chart) {
                li { (sample("plain", &[origin], 0)) (in_full(origin)) }
            }
        }
    }
}

/// A sample around its centre, and what it means.
pub type Entry = (Markup, String);

/// The entries of a legend in a file: the series' names, unless they stand beside their curves; then the origins.
pub fn entries(chart: &Chart, format: Format) -> Vec<Entry> {
    let names = if are_beside(chart, format) { Vec::new() } else { chart.names() };
    let name = |(number, name): (usize, &&str)| {
        (shapes(&format!("look{}", number % LOOKS), &of_name(chart, name), number), (*name).to_owned())
    };
    let names = names.iter().enumerate().map(name);
    names.chain(origins(chart).into_iter().map(|origin| (shapes("plain", &[origin], 0), in_full(origin)))).collect()
}

/// The origins of its series, each once.
fn origins(chart: &Chart) -> Vec<&Origin> {
    let mut origins: Vec<&Origin> = chart.series.iter().map(|series| &series.origin).collect();
    origins.sort();
    origins.dedup();
    origins
}

fn of_name<'a>(chart: &'a Chart, name: &str) -> Vec<&'a Origin> {
    chart.series.iter().filter(|series| series.name == name).map(|series| &series.origin).collect()
}

/// A line and a point as in the chart.
fn sample(look: &str, origins: &[&Origin], number: usize) -> Markup {
    html! { svg.sample viewBox="-15 -7 30 14" aria-hidden="true" { (shapes(look, origins, number)) } }
}

/// The elements of a sample.
fn shapes(look: &str, origins: &[&Origin], number: usize) -> Markup {
    let is_formula = origins.contains(&&Origin::Formula);
    let [is_count, is_model, is_rtl] = [1, 2, 3].map(|column| origins.iter().any(|origin| origin.column() == column));
    // The shape of its points identifies a name; strokes would hide it.
    let strokes = match (is_model || is_rtl, is_count, origins.contains(&&Origin::Paper)) {
        (false, true, _) => &PLUS[..],
        (false, false, true) => &CROSS,
        _ => &[],
    };
    html! {
        @if is_formula { polyline class={ "curve " (look) } points="-15,0 15,0" {} }
        @if is_model { polygon class={ "hollow " (look) } points=(points(outline(number))) {} }
        @if is_rtl { polygon class={ "filled " (look) } points=(points(filled(number, is_model))) {} }
        @for stroke in strokes { polyline class={ "cross " (look) } points=(points(stroke.iter().copied())) {} }
    }
}
