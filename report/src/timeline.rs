//! A chart of times: what goes on in each of several lanes, and when something happens in one.

use crate::csv;
use crate::number::shown;
use crate::origin::Origin;
use crate::plot;
use crate::statement::in_full;
use maud::{Markup, html};
use serde::Serialize;

/// Lanes over a common axis of time, each with spans and events. Lanes whose spans follow one another from zero are stacked bars.
///
/// ```
/// use tilewright_report::{Lane, Origin, Timeline};
///
/// let lane = Lane::new("sender").span("sending", 0.0, 2.5).span("waiting", 2.5, 4.0).event("1", "the last word", 2.5);
/// let chart = Timeline::new("transfer", "A transfer", "time, ms", Origin::rtl([])).lane(lane);
/// assert_eq!(chart.csv_text().lines().nth(2), Some("sender,,waiting,2.5,4,RTL,"));
/// assert_eq!(chart.csv_text().lines().nth(3), Some("sender,1,the last word,2.5,2.5,RTL,"));
/// ```
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Timeline {
    pub(crate) id: String,
    pub(crate) title: String,
    pub(crate) note: String,
    pub(crate) axis: String,
    origin: Origin,
    pub(crate) lanes: Vec<Lane>,
}

/// What goes on in one place.
///
/// ```
/// use tilewright_report::Lane;
///
/// assert_eq!(Lane::new("sender").span("sending", 0.0, 2.5).name, "sender");
/// ```
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Lane {
    /// Its name, some characters long.
    pub name: String,
    pub(crate) spans: Vec<Span>,
    pub(crate) events: Vec<Event>,
}

/// Something that goes on for a time. Spans of one name look alike.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct Span {
    pub what: String,
    pub from: f64,
    pub to: f64,
}

/// Something that happens, with the sign by which the chart has it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct Event {
    pub sign: String,
    pub what: String,
    pub at: f64,
}

impl Lane {
    /// A lane in which nothing happens.
    ///
    /// ```
    /// assert_eq!(tilewright_report::Lane::new("sender").name, "sender");
    /// ```
    pub fn new(name: impl Into<String>) -> Lane {
        Lane { name: name.into(), spans: Vec::new(), events: Vec::new() }
    }

    /// Adds what goes on from one time to another.
    ///
    /// ```
    /// use tilewright_report::{Lane, Origin, Timeline};
    ///
    /// let chart = Timeline::new("transfer", "A transfer", "time, ms", Origin::Formula).lane(Lane::new("bus").span("a word", 1.0, 2.0));
    /// assert_eq!(chart.csv_text().lines().last(), Some("bus,,a word,1,2,formula,"));
    /// ```
    pub fn span(mut self, what: impl Into<String>, from: f64, to: f64) -> Lane {
        self.spans.push(Span { what: what.into(), from, to });
        self
    }

    /// Adds what happens at a time, with a sign of one or two characters.
    ///
    /// ```
    /// use tilewright_report::{Lane, Origin, Timeline};
    ///
    /// let chart = Timeline::new("transfer", "A transfer", "time, ms", Origin::Formula).lane(Lane::new("bus").event("1", "a word", 1.0));
    /// assert_eq!(chart.csv_text().lines().last(), Some("bus,1,a word,1,1,formula,"));
    /// ```
    pub fn event(mut self, sign: impl Into<String>, what: impl Into<String>, at: f64) -> Lane {
        self.events.push(Event { sign: sign.into(), what: what.into(), at });
        self
    }
}

impl Lane {
    fn rows(&self) -> impl Iterator<Item = Row<'_>> {
        let lane = self.name.as_str();
        let spans = self.spans.iter().map(move |it| Row { lane, sign: "", what: &it.what, from: it.from, to: it.to });
        spans.chain(self.events.iter().map(move |it| Row {
            lane,
            sign: &it.sign,
            what: &it.what,
            from: it.at,
            to: it.at,
        }))
    }
}

impl Timeline {
    /// A chart without lanes. `id` names it in addresses and files: lower-case letters, digits, hyphens. `axis` is what lies along the
    /// time, with its unit.
    ///
    /// ```
    /// use tilewright_report::{Origin, Timeline};
    ///
    /// let chart = Timeline::new("transfer", "A transfer", "time, ms", Origin::rtl([]));
    /// assert_eq!(chart.csv_text(), "lane,event,what,\"from: time, ms\",\"to: time, ms\",origin,seeds\n");
    /// ```
    pub fn new(id: impl Into<String>, title: impl Into<String>, axis: impl Into<String>, origin: Origin) -> Timeline {
        let (id, title, axis) = (id.into(), title.into(), axis.into());
        Timeline { id, title, note: String::new(), axis, origin, lanes: Vec::new() }
    }

    /// What the caption says besides the title.
    ///
    /// ```
    /// use tilewright_report::{Origin, Timeline};
    ///
    /// let chart = Timeline::new("transfer", "A transfer", "time, ms", Origin::rtl([])).note("Of one word.");
    /// assert_eq!(chart.csv_text().lines().count(), 1);
    /// ```
    pub fn note(self, note: impl Into<String>) -> Timeline {
        Timeline { note: note.into(), ..self }
    }

    /// Adds a lane below the others.
    ///
    /// ```
    /// use tilewright_report::{Lane, Origin, Timeline};
    ///
    /// let chart = Timeline::new("transfer", "A transfer", "time, ms", Origin::model([7])).lane(Lane::new("bus").span("a word", 1.0, 2.0));
    /// assert_eq!(chart.csv_text().lines().last(), Some("bus,,a word,1,2,transaction model,7"));
    /// ```
    pub fn lane(mut self, lane: Lane) -> Timeline {
        self.lanes.push(lane);
        self
    }

    /// A row for each span, and for each event with its sign, which begins and ends at once.
    ///
    /// ```
    /// use tilewright_report::{Lane, Origin, Timeline};
    ///
    /// let chart = Timeline::new("transfer", "A transfer", "time, ms", Origin::Formula).lane(Lane::new("bus"));
    /// assert_eq!(chart.csv_text().lines().count(), 1);
    /// ```
    pub fn csv_text(&self) -> String {
        let [from, to] = ["from", "to"].map(|end| format!("{end}: {}", self.axis));
        let names = ["lane", "event", "what", &from, &to, "origin", "seeds"].map(str::to_owned).to_vec();
        let rows = self.rows().into_iter().map(|Row { lane, sign, what, from, to }| {
            let mut cells = [lane, sign, what].map(str::to_owned).to_vec();
            cells.extend([csv::cell(from), csv::cell(to)]);
            cells.extend([self.origin.name().to_owned(), self.origin.seeds_in_words()]);
            cells
        });
        String::from_utf8_lossy(&csv::csv([names].into_iter().chain(rows))).into_owned()
    }

    fn rows(&self) -> Vec<Row<'_>> {
        self.lanes.iter().flat_map(Lane::rows).collect()
    }

    /// What its spans are of, each once, in order.
    pub(crate) fn names(&self) -> Vec<&str> {
        let mut names = Vec::new();
        for span in self.lanes.iter().flat_map(|lane| &lane.spans) {
            if !names.contains(&span.what.as_str()) {
                names.push(span.what.as_str());
            }
        }
        names
    }

    /// The signs of its events with what they mean, each once, in the order of signs.
    fn signs(&self) -> Vec<(&str, &str)> {
        let all = self.lanes.iter().flat_map(|lane| &lane.events);
        let mut signs: Vec<_> = all.map(|event| (event.sign.as_str(), event.what.as_str())).collect();
        signs.sort_unstable();
        signs.dedup();
        signs
    }

    /// What is wrong with it, as the end of a sentence.
    pub(crate) fn problem(&self) -> Option<String> {
        if self.lanes.is_empty() {
            return Some("has no lanes: give it one or more".to_owned());
        }
        let is_wrong = |row: &Row| !(row.from.is_finite() && row.to.is_finite() && row.from <= row.to);
        let Row { lane, what, from, to, .. } = self.rows().into_iter().find(is_wrong)?;
        let (from, to) = (shown(from), shown(to));
        Some(format!("has `{what}` from {from} to {to} in the lane {lane}: give it numbers that do not fall"))
    }

    pub(crate) fn html(&self) -> Markup {
        let row = |Row { lane, sign, what, from, to }: Row| {
            html! {
                tr {
                    th scope="row" { (lane) }
                    td { (sign) }
                    td { (what) }
                    td.number { (shown(from)) }
                    td.number { (shown(to)) }
                }
            }
        };
        html! {
            (plot::svg_of_times(self, plot::WIDE)) (plot::svg_of_times(self, plot::NARROW))
            ul.legend aria-label="Legend" {
                @for (number, name) in self.names().into_iter().enumerate() { li { (plot::sample_of_span(number)) (name) } }
                @for (sign, what) in self.signs() { li { strong { (sign) } " " (what) } }
            }
            ul.legend.origins aria-label="Origin" { li { (in_full(&self.origin)) } }
            details {
                summary { "Numbers" }
                div.scroll tabindex="0" role="region" aria-label={ "Numbers of " (self.title) } {
                    table.data {
                        thead {
                            tr {
                                @for name in ["Lane", "Event", "What"] { th scope="col" { (name) } }
                                @for end in ["from", "to"] { th.number scope="col" { (end) ": " (self.axis) } }
                            }
                        }
                        tbody { @for it in self.rows() { (row(it)) } }
                    }
                }
            }
        }
    }

    /// What it shows, for those who do not see it.
    pub(crate) fn alt(&self) -> String {
        let lanes: Vec<&str> = self.lanes.iter().map(|lane| lane.name.as_str()).collect();
        let signs = self.signs().into_iter().map(|(sign, what)| format!("{sign} {what}"));
        let what: Vec<String> = self.names().into_iter().map(str::to_owned).chain(signs).collect();
        format!("{}. {} of {}: {}.", self.title, self.axis, lanes.join(", "), what.join(", "))
    }
}

/// A span, or an event.
struct Row<'a> {
    lane: &'a str,
    /// Nothing of a span.
    sign: &'a str,
    what: &'a str,
    from: f64,
    to: f64,
}
