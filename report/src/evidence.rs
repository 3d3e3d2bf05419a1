//! The numbers that a verdict follows from, as a small table: a place a row, beside each other the reference and what was found.

use crate::number::shown;
use crate::origin::Origin;
use crate::statement::in_full;
use crate::verdict::Point;
use maud::{Markup, html};
use serde::Serialize;

/// Numbers of one origin.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Numbers {
    pub origin: Origin,
    pub points: Vec<Point>,
}

impl Numbers {
    pub fn new<P: Into<Point>>(origin: Origin, points: impl IntoIterator<Item = P>) -> Numbers {
        Numbers { origin, points: points.into_iter().map(Into::into).collect() }
    }

    /// The number of a place. One without a place counts for all.
    pub fn at(&self, at: &str) -> Option<f64> {
        self.points.iter().find(|point| point.at == at || point.at.is_empty()).map(|point| point.value)
    }
}

/// How many places are shown besides those that a verdict names; the CSV file has all.
const SHOWN: usize = 6;

/// The places of both, in order: of what was found, or of the reference if nothing was.
pub fn places<'a>(reference: &'a Option<Numbers>, found: &'a Option<Numbers>) -> Vec<&'a str> {
    let both = [found, reference].into_iter().flatten().map(|numbers| &numbers.points);
    let points = both.into_iter().find(|points| !points.is_empty());
    points.map_or_else(Vec::new, |points| points.iter().map(|point| point.at.as_str()).collect())
}

/// Both beside each other. `named` are the places of which a verdict speaks.
pub fn evidence(reference: &Option<Numbers>, found: &Option<Numbers>, unit: &str, named: &[String]) -> Markup {
    let places = places(reference, found);
    if places.is_empty() {
        return html! {};
    }
    let is_named = |at: &str| named.iter().any(|it| it == at);
    let wanted = places.iter().enumerate().filter(|(index, at)| *index < SHOWN || is_named(at));
    let wanted: Vec<&str> = wanted.map(|(_, at)| *at).collect();
    let left = places.len() - wanted.len();
    let columns: Vec<&Numbers> = [reference, found].into_iter().flatten().filter(|it| !it.points.is_empty()).collect();
    html! {
        div.evidence {
            table {
                thead { tr {
                    th scope="col" { (unit) }
                    @for Numbers { origin, .. } in &columns { th.number scope="col" { (in_full(origin)) } }
                } }
                tbody {
                    @for at in wanted {
                        tr.named[is_named(at)] {
                            th scope="row" { (at) }
                            @for numbers in &columns { td.number { (numbers.at(at).map_or("–".to_owned(), shown)) } }
                        }
                    }
                }
            }
            @if left > 0 { p.detail { "and " (left) " more" } }
        }
    }
}
