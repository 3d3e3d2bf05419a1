//! A heat map: numbers of a grid, such as clocks for each processor.

use crate::csv;
use crate::number::shown;
use crate::origin::Origin;
use crate::statement::in_full;
use maud::{Markup, html};
use serde::Serialize;

/// Numbers of a grid as colours, with their scale. Each cell shows its number under the mouse; a map of few cells has the numbers inside.
///
/// ```
/// use tilewright_report::{HeatMap, Origin};
///
/// let map = HeatMap::new("load", "Busy clocks of each processor", "clocks", Origin::rtl([]), [vec![10.0, 12.0], vec![11.0, 9.0]]);
/// assert_eq!(map.csv_text(), "row,column,clocks,origin,seeds\n0,0,10,RTL,\n0,1,12,RTL,\n1,0,11,RTL,\n1,1,9,RTL,\n");
/// ```
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct HeatMap {
    pub(crate) id: String,
    pub(crate) title: String,
    pub(crate) note: String,
    unit: String,
    origin: Origin,
    pub(crate) rows: Vec<Vec<f64>>,
}

/// The side of a cell, in units of the SVG.
const CELL: usize = 40;

impl HeatMap {
    /// A heat map of rows of equal length, from top to bottom. `id` names it in addresses and files: lower-case letters, digits, hyphens.
    ///
    /// ```
    /// use tilewright_report::{HeatMap, Origin};
    ///
    /// let map = HeatMap::new("load", "Busy clocks", "clocks", Origin::model([5]), [vec![10.0]]);
    /// assert_eq!(map.csv_text().lines().last(), Some("0,0,10,transaction model,5"));
    /// ```
    pub fn new(
        id: impl Into<String>,
        title: impl Into<String>,
        unit: impl Into<String>,
        origin: Origin,
        rows: impl IntoIterator<Item = Vec<f64>>,
    ) -> HeatMap {
        let rows = rows.into_iter().collect();
        HeatMap { id: id.into(), title: title.into(), note: String::new(), unit: unit.into(), origin, rows }
    }

    /// A note below the title, in the caption.
    ///
    /// ```
    /// use tilewright_report::{HeatMap, Origin};
    ///
    /// let map = HeatMap::new("load", "Busy clocks", "clocks", Origin::rtl([]), [vec![10.0]]).note("Of one frame.");
    /// assert_eq!(map.csv_text().lines().count(), 2);
    /// ```
    pub fn note(self, note: impl Into<String>) -> HeatMap {
        HeatMap { note: note.into(), ..self }
    }

    /// A row for each cell.
    ///
    /// ```
    /// use tilewright_report::{HeatMap, Origin};
    ///
    /// let map = HeatMap::new("load", "Busy clocks", "clocks", Origin::rtl([]), [vec![10.0, 12.0]]);
    /// assert_eq!(map.csv_text().lines().last(), Some("0,1,12,RTL,"));
    /// ```
    pub fn csv_text(&self) -> String {
        let names = ["row", "column", &self.unit, "origin", "seeds"].map(str::to_owned).to_vec();
        let cells = self
            .rows
            .iter()
            .enumerate()
            .flat_map(|(y, row)| row.iter().enumerate().map(move |(x, value)| (y, x, *value)));
        let row = |(y, x, value): (usize, usize, f64)| {
            vec![
                y.to_string(),
                x.to_string(),
                csv::cell(value),
                self.origin.name().to_owned(),
                self.origin.seeds_in_words(),
            ]
        };
        String::from_utf8_lossy(&csv::csv([names].into_iter().chain(cells.map(row)))).into_owned()
    }

    /// The least and the greatest number.
    fn ends(&self) -> (f64, f64) {
        let finite = self.rows.iter().flatten().filter(|value| value.is_finite());
        finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(*value), high.max(*value)))
    }

    pub(crate) fn html(&self) -> Markup {
        let (columns, rows) = (self.rows.first().map_or(0, Vec::len), self.rows.len());
        let (low, high) = self.ends();
        // If all numbers are equal, their colour is the middle one.
        let share = |value: f64| if high > low { (value - low) / (high - low) * 100.0 } else { 50.0 };
        let is_written = columns <= 8 && rows <= 16;
        let longest = self.rows.iter().flatten().map(|value| shown(*value).chars().count()).max().unwrap_or(1);
        let size = (CELL as f64 * 0.9 / (0.6 * longest as f64)).min(13.0);
        let style = format!("--columns:{columns};font-size:{size:.1}px");
        let cell = |y: usize, x: usize, value: f64| {
            let (share, text) = (share(value), shown(value));
            html! {
                g.high[share > 50.0] {
                    rect x=(x * CELL) y=(y * CELL) width=(CELL) height=(CELL) style={ "--share:" (format!("{share:.1}%")) } {
                        title { "row " (y) ", column " (x) ": " (text) " " (self.unit) }
                    }
                    @if is_written {
                        text x=(x * CELL + CELL / 2) y=(y * CELL + CELL / 2) dy="0.35em" text-anchor="middle" { (text) }
                    }
                }
            }
        };
        let (width, height) = (columns * CELL, rows * CELL);
        html! {
            svg.heat.dense[columns > 32] viewBox={ "0 0 " (width) " " (height) } style=(style) role="img" aria-label=(self.alt()) {
                @for (y, row) in self.rows.iter().enumerate() {
                    @for (x, value) in row.iter().enumerate().filter(|(_, value)| value.is_finite()) { (cell(y, x, *value)) }
                }
            }
            p.scale {
                span { (shown(low)) } span.ramp aria-hidden="true" {} span { (shown(high)) " " (self.unit) }
                span.origin { (in_full(&self.origin)) }
            }
        }
    }

    fn alt(&self) -> String {
        let (low, high) = self.ends();
        let (columns, rows) = (self.rows.first().map_or(0, Vec::len), self.rows.len());
        format!("{}. {rows} rows of {columns} cells, from {} to {} {}.", self.title, shown(low), shown(high), self.unit)
    }
}
