//! The legend: which shape and dashes are which series, and which kind of mark is which origin.

use super::mark::{CROSS, LOOKS, outline};
use super::svg::points;
use crate::chart::Chart;
use crate::origin::Origin;
use crate::statement::in_full;
use maud::{Markup, html};

/// The series' names in their looks, then the origins in plain ink.
pub fn legend(chart: &Chart) -> Markup {
    let names = chart.names();
    let mut origins: Vec<&Origin> = chart.series.iter().map(|series| &series.origin).collect();
    origins.sort();
    origins.dedup();
    html! {
        ul.legend aria-label="Legend" {
            @for (number, name) in names.iter().enumerate() {
                li { (sample(&format!("look{}", number % LOOKS), &of_name(chart, name), number)) (name) }
            }
        }
        ul.legend.origins aria-label="Kinds of marks" {
            @for origin in origins {
                li { (sample("plain", &[origin], 0)) (in_full(origin)) }
            }
        }
    }
}

fn of_name<'a>(chart: &'a Chart, name: &str) -> Vec<&'a Origin> {
    chart.series.iter().filter(|series| series.name == name).map(|series| &series.origin).collect()
}

/// A line and a mark as they are in the chart.
fn sample(look: &str, origins: &[&Origin], number: usize) -> Markup {
    let has = |wanted: fn(&Origin) -> bool| origins.iter().any(|origin| wanted(origin));
    let is_formula = has(|origin| *origin == Origin::Formula);
    let is_measured = has(Origin::is_measured);
    let is_filled = has(|origin| matches!(origin, Origin::Rtl { .. }));
    html! {
        svg.sample viewBox="-15 -7 30 14" aria-hidden="true" {
            @if is_formula { polyline class={ "curve " (look) } points="-15,0 15,0" {} }
            @if is_measured { polygon class={ (if is_filled { "filled " } else { "hollow " }) (look) } points=(points(outline(number))) {} }
            @if !is_measured && has(|origin| *origin == Origin::Paper) {
                @for stroke in CROSS { polyline class={ "cross " (look) } points=(points(stroke)) {} }
            }
        }
    }
}
