//! The numbers behind a verdict, as a small table. Each row is a place, with the reference beside the number found.

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

    /// The number at a place. A number without a place counts for all places.
    pub fn at(&self, at: &str) -> Option<f64> {
        self.points.iter().find(|point| point.at == at || point.at.is_empty()).map(|point| point.value)
    }
}

/// The number of places that are shown besides those that a verdict names. The CSV file has all places.
const SHOWN: usize = 6;

/// The places in their sequence: those of the numbers found, or of the reference if there are none.
pub fn places<'a>(reference: &'a Option<Numbers>, found: &'a Option<Numbers>) -> Vec<&'a str> {
    let both = [found, reference].into_iter().flatten().map(|numbers| &numbers.points);
    let points = both.into_iter().find(|points| !points.is_empty());
    points.map_or_else(Vec::new, |points| points.iter().map(|point| point.at.as_str()).collect())
}

/// The table of both. `named` are the places that a verdict names.
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
