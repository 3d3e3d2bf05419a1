//! A chart: curves and points over one axis, each with its origin.

use crate::csv;
use crate::number::shown;
use crate::origin::Origin;
use crate::plot;
use crate::statement::in_full;
use maud::{Markup, html};
use serde::Serialize;

/// A quantity along one side of a chart.
///
/// ```
/// use tilewright_report::Axis;
///
/// let axis = Axis::log("area S, pixels");
/// assert!(axis.logarithmic);
/// assert!(!Axis::linear("load").logarithmic);
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Axis {
    /// The quantity and its unit.
    pub label: String,
    /// Whether equal steps are equal factors. Such an axis has no place for a point that is not above zero. The point is not drawn, and
    /// the chart says so.
    pub logarithmic: bool,
}

impl Axis {
    /// An axis of equal steps.
    ///
    /// ```
    /// assert_eq!(tilewright_report::Axis::linear("load").label, "load");
    /// ```
    pub fn linear(label: impl Into<String>) -> Axis {
        Axis { label: label.into(), logarithmic: false }
    }

    /// An axis of equal factors.
    ///
    /// ```
    /// assert_eq!(tilewright_report::Axis::log("windows").label, "windows");
    /// ```
    pub fn log(label: impl Into<String>) -> Axis {
        Axis { label: label.into(), logarithmic: true }
    }

    /// Whether a value has a place on it.
    pub(crate) fn shows(&self, value: f64) -> bool {
        value.is_finite() && (value > 0.0 || !self.logarithmic)
    }
}

/// Points of one origin, (x, y) from left to right. Series of the same name share their colour, the dashes of their lines, the shape of
/// their points, and rows of the CSV file.
///
/// ```
/// use tilewright_report::{Origin, Series};
///
/// let series = Series::new("k = 4", Origin::rtl([1, 2]), [(1.0, 0.22), (10.0, 0.19)]);
/// assert_eq!(series.points.len(), 2);
/// ```
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Series {
    /// What the curve shows.
    pub name: String,
    /// Where its numbers come from. Formulas are lines, plain counts are plus signs, and a paper's numbers are crosses. A transaction-level
    /// model's points are hollow, and the hardware's are filled. Beside a model's they are small, so that equal points are both visible.
    pub origin: Origin,
    /// The points.
    pub points: Vec<(f64, f64)>,
}

impl Series {
    /// A series.
    ///
    /// ```
    /// use tilewright_report::{Origin, Series};
    ///
    /// assert_eq!(Series::new("k = 4", Origin::Paper, [(157.0, 1.0)]).name, "k = 4");
    /// ```
    pub fn new(name: impl Into<String>, origin: Origin, points: impl IntoIterator<Item = (f64, f64)>) -> Series {
        Series { name: name.into(), origin, points: points.into_iter().collect() }
    }
}

/// A chart of several series. Its legend is readable without colours, and its numbers are also a table and a CSV file.
///
/// ```
/// use tilewright_report::{Axis, Chart, Origin, Series};
///
/// let chart = Chart::new("load", "Load of the pipelines", Axis::log("area S, pixels"), Axis::linear("load"))
///     .series(Series::new("k = 1", Origin::Formula, [(1.0, 0.9), (10.0, 0.95)]))
///     .series(Series::new("k = 1", Origin::rtl([7]), [(10.0, 0.93)]))
///     .note("Rectangles of 5:1 at random angles.");
/// assert_eq!(chart.csv_text().lines().nth(2), Some("k = 1,10,0.95,,,0.93,,,,7"));
/// ```
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Chart {
    pub(crate) id: String,
    pub(crate) title: String,
    pub(crate) note: String,
    pub(crate) x: Axis,
    pub(crate) y: Axis,
    pub(crate) series: Vec<Series>,
}

impl Chart {
    /// A chart without series. `id` names it in addresses and files: lower-case letters, digits, hyphens.
    ///
    /// ```
    /// use tilewright_report::{Axis, Chart};
    ///
    /// let chart = Chart::new("load", "Load", Axis::log("area"), Axis::linear("load"));
    /// assert_eq!(chart.csv_text(), "series,area,formula,plain count,transaction model,RTL,paper,plain count seeds,transaction model seeds,RTL seeds\n");
    /// ```
    pub fn new(id: impl Into<String>, title: impl Into<String>, x: Axis, y: Axis) -> Chart {
        Chart { id: id.into(), title: title.into(), note: String::new(), x, y, series: Vec::new() }
    }

    /// A note below the title, in the caption.
    ///
    /// ```
    /// use tilewright_report::{Axis, Chart};
    ///
    /// let chart = Chart::new("load", "Load", Axis::log("area"), Axis::linear("load")).note("Of 10 000 polygons.");
    /// assert_eq!(chart.csv_text().lines().count(), 1);
    /// ```
    pub fn note(self, note: impl Into<String>) -> Chart {
        Chart { note: note.into(), ..self }
    }

    /// Adds a series.
    ///
    /// ```
    /// use tilewright_report::{Axis, Chart, Origin, Series};
    ///
    /// let chart = Chart::new("load", "Load", Axis::log("area"), Axis::linear("load"));
    /// let chart = chart.series(Series::new("k = 1", Origin::Formula, [(1.0, 0.9)]));
    /// assert_eq!(chart.csv_text().lines().nth(1), Some("k = 1,1,0.9,,,,,,,"));
    /// ```
    pub fn series(mut self, series: Series) -> Chart {
        self.series.push(series);
        self
    }

    /// The chart as a separate SVG file with its legend, light or dark like the reader's screen. Its text is large, as a page shows a picture
    /// smaller on a narrow screen.
    ///
    /// ```
    /// use tilewright_report::{Axis, Chart, Origin, Series};
    ///
    /// let chart = Chart::new("load", "Load by area", Axis::log("area"), Axis::linear("load"));
    /// let svg = chart.series(Series::new("k = 1", Origin::Formula, [(1.0, 0.9), (10.0, 0.8)])).svg_text();
    /// assert!(svg.starts_with("<svg xmlns=") && svg.contains(">Load by area</text>"));
    /// ```
    pub fn svg_text(&self) -> String {
        plot::svg_file(self).into_string() + "\n"
    }

    /// The numbers: a row for each x of each name, a column for each origin, and the seeds of measurements.
    ///
    /// ```
    /// use tilewright_report::{Axis, Chart, Origin, Series};
    ///
    /// let chart = Chart::new("load", "Load", Axis::log("area"), Axis::linear("load"));
    /// let chart = chart.series(Series::new("k = 1", Origin::model([3, 4]), [(1.0, 0.9)]));
    /// assert_eq!(chart.csv_text().lines().nth(1), Some("k = 1,1,,,0.9,,,,3 4,"));
    /// ```
    pub fn csv_text(&self) -> String {
        let mut names = vec!["series".to_owned(), self.x.label.clone()];
        names.extend(Origin::NAMES.map(str::to_owned));
        names.extend(Origin::NAMES[Origin::MEASURED].iter().map(|name| format!("{name} seeds")));
        let rows = self.rows().into_iter().map(|row| {
            let mut cells = vec![row.name.to_owned(), csv::cell(row.x)];
            cells.extend(row.values.iter().map(|value| value.map_or(String::new(), |(value, _)| csv::cell(value))));
            let seeds =
                |value: &Option<(f64, &Origin)>| value.map_or(String::new(), |(_, origin)| origin.seeds_in_words());
            cells.extend(row.values[Origin::MEASURED].iter().map(seeds));
            cells
        });
        String::from_utf8_lossy(&csv::csv([names].into_iter().chain(rows))).into_owned()
    }

    /// Names in the sequence of their first series, each with its sorted x.
    fn rows(&self) -> Vec<Row<'_>> {
        let mut rows: Vec<Row> = Vec::new();
        for name in self.names() {
            let first = rows.len();
            for series in self.series.iter().filter(|series| series.name == name) {
                let column = series.origin.column();
                for &(x, y) in &series.points {
                    // Two measurements at one place with different seeds are two rows.
                    let free = rows[first..]
                        .iter()
                        .position(|row| row.x.total_cmp(&x).is_eq() && row.values[column].is_none());
                    let row = free.map_or(rows.len(), |index| first + index);
                    if row == rows.len() {
                        rows.push(Row { name, x, values: [None; 5] });
                    }
                    rows[row].values[column] = Some((y, &series.origin));
                }
            }
            rows[first..].sort_by(|one, other| one.x.total_cmp(&other.x));
        }
        rows
    }

    /// The names of its series, each once, in their sequence.
    pub(crate) fn names(&self) -> Vec<&str> {
        let mut names = Vec::new();
        for series in &self.series {
            if !names.contains(&series.name.as_str()) {
                names.push(series.name.as_str());
            }
        }
        names
    }

    /// The number of points without a place on its axes.
    fn not_drawn(&self) -> usize {
        let all = self.series.iter().flat_map(|series| &series.points);
        all.filter(|(x, y)| !(self.x.shows(*x) && self.y.shows(*y))).count()
    }

    pub(crate) fn html(&self) -> Markup {
        let not_drawn = match self.not_drawn() {
            0 => None,
            1 => Some("One point is outside of these axes, and is not drawn.".to_owned()),
            several => Some(format!("{several} points are outside of these axes, and are not drawn.")),
        };
        html! {
            (plot::svg(self, plot::WIDE)) (plot::svg(self, plot::NARROW))
            (plot::legend(self))
            @if let Some(not_drawn) = not_drawn { p.missing { (not_drawn) } }
            details {
                summary { "Numbers" }
                div.scroll tabindex="0" role="region" aria-label={ "Numbers of " (self.title) } { (self.table()) }
            }
        }
    }

    fn table(&self) -> Markup {
        let used: Vec<usize> = (0..Origin::NAMES.len())
            .filter(|column| self.series.iter().any(|series| series.origin.column() == *column))
            .collect();
        html! {
            table.data {
                thead {
                    tr {
                        th scope="col" { "Series" }
                        th.number scope="col" { (self.x.label) }
                        @for column in &used { th.number scope="col" { (Origin::NAMES[*column]) } }
                    }
                }
                tbody {
                    @for row in self.rows() {
                        tr {
                            th scope="row" { (row.name) }
                            td.number { (shown(row.x)) }
                            @for value in used.iter().map(|column| row.values[*column]) {
                                td.number {
                                    @if let Some((value, origin)) = value { span title=(in_full(origin)) { (shown(value)) } }
                                }
                            }
                        }
                    }
                }
            }
        }
    }

    /// A description for readers who do not see the chart.
    pub(crate) fn alt(&self) -> String {
        let series = self.series.iter().map(|series| format!("{} ({})", series.name, in_full(&series.origin)));
        format!("{}. {} against {}: {}.", self.title, self.y.label, self.x.label, series.collect::<Vec<_>>().join(", "))
    }
}

/// The values at one x.
struct Row<'a> {
    name: &'a str,
    x: f64,
    values: [Option<(f64, &'a Origin)>; 5],
}
