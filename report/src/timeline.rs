//! A chart of times: the activities of several lanes, and events in them.

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
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) kinds: Vec<Kind>,
}

/// A kind of activity in columns.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct Kind {
    pub what: String,
    /// Whether it is waiting, which is grey.
    pub is_quiet: bool,
}

/// The activities at one place.
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
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) columns: Vec<Column>,
    /// The number of its colour in the palette, if it has one in other pictures.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) colour: Option<u32>,
}

/// A time with several activities, each for a share of it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct Column {
    pub from: f64,
    pub to: f64,
    /// Each activity, with its share of the time from 0 to 1.
    pub shares: Vec<(String, f64)>,
}

/// An activity from one time to another. Spans of one name look alike.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct Span {
    pub what: String,
    pub from: f64,
    pub to: f64,
}

/// An event, with its sign in the chart.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct Event {
    pub sign: String,
    pub what: String,
    pub at: f64,
}

impl Lane {
    /// An empty lane.
    ///
    /// ```
    /// assert_eq!(tilewright_report::Lane::new("sender").name, "sender");
    /// ```
    pub fn new(name: impl Into<String>) -> Lane {
        Lane { name: name.into(), spans: Vec::new(), events: Vec::new(), columns: Vec::new(), colour: None }
    }

    /// Shows beside its name the [palette](crate::palette)'s colour of that number, which it has in other pictures.
    ///
    /// ```
    /// use tilewright_report::{Lane, Origin, Timeline};
    ///
    /// let lane = Lane::new("sender").coloured(3).span("sending", 0.0, 1.0);
    /// let svg = Timeline::new("transfer", "A transfer", "time, ms", Origin::Formula).lane(lane).svg_text();
    /// assert!(svg.contains("<rect class=\"part\" style=\"fill:#"));
    /// ```
    pub fn coloured(self, number: u32) -> Lane {
        Lane { colour: Some(number), ..self }
    }

    /// Adds an activity from one time to another.
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

    /// Adds a time with several activities, each for a share of it from 0 to 1. They are stacked in the sequence of [`Timeline::kinds`].
    ///
    /// ```
    /// use tilewright_report::{Lane, Origin, Timeline};
    ///
    /// let lane = Lane::new("bus").shares(0.0, 2.0, [("a word", 0.75), ("waiting", 0.25)]);
    /// let chart = Timeline::new("transfer", "A transfer", "time, ms", Origin::Formula).kinds(["a word"], ["waiting"]).lane(lane);
    /// assert_eq!(chart.csv_text().lines().nth(1), Some("bus,,a word,0,2,0.75,formula,"));
    /// ```
    pub fn shares(mut self, from: f64, to: f64, shares: impl IntoIterator<Item = (impl Into<String>, f64)>) -> Lane {
        let shares = shares.into_iter().map(|(what, share)| (what.into(), share)).collect();
        self.columns.push(Column { from, to, shares });
        self
    }

    /// Adds an event at a time, with a sign of one or two characters.
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
        let row = move |what, from, to, share| Row { lane, sign: "", what, from, to, share };
        let spans = self.spans.iter().map(move |it| row(&it.what, it.from, it.to, 1.0));
        let columns = self
            .columns
            .iter()
            .flat_map(move |it| it.shares.iter().map(move |(what, share)| row(what.as_str(), it.from, it.to, *share)));
        let events = self.events.iter();
        let events =
            events.map(move |it| Row { lane, sign: &it.sign, what: &it.what, from: it.at, to: it.at, share: 1.0 });
        spans.chain(columns).chain(events)
    }
}

impl Timeline {
    /// A chart without lanes. `id` names it in addresses and files: lower-case letters, digits, hyphens. `axis` is the label of the time
    /// axis, with its unit.
    ///
    /// ```
    /// use tilewright_report::{Origin, Timeline};
    ///
    /// let chart = Timeline::new("transfer", "A transfer", "time, ms", Origin::rtl([]));
    /// assert_eq!(chart.csv_text(), "lane,event,what,\"from: time, ms\",\"to: time, ms\",origin,seeds\n");
    /// ```
    pub fn new(id: impl Into<String>, title: impl Into<String>, axis: impl Into<String>, origin: Origin) -> Timeline {
        let (id, title, axis) = (id.into(), title.into(), axis.into());
        Timeline { id, title, note: String::new(), axis, origin, lanes: Vec::new(), kinds: Vec::new() }
    }

    /// A note below the title, in the caption.
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

    /// Sets the kinds of activities in columns, from bottom to top: kinds of work, then kinds of waiting, which are grey.
    ///
    /// ```
    /// use tilewright_report::{Lane, Origin, Timeline};
    ///
    /// let chart = Timeline::new("transfer", "A transfer", "time, ms", Origin::Formula).kinds(["sending"], ["waiting"]);
    /// let svg = chart.lane(Lane::new("bus").shares(0.0, 1.0, [("waiting", 0.5), ("sending", 0.5)])).svg_text();
    /// assert!(svg.find(">sending</text>") < svg.find(">waiting</text>"));
    /// ```
    pub fn kinds<W: Into<String>, Q: Into<String>>(
        mut self,
        work: impl IntoIterator<Item = W>,
        waiting: impl IntoIterator<Item = Q>,
    ) -> Timeline {
        let work = work.into_iter().map(|what| Kind { what: what.into(), is_quiet: false });
        self.kinds = work.chain(waiting.into_iter().map(|what| Kind { what: what.into(), is_quiet: true })).collect();
        self
    }

    /// The chart as a separate SVG file with its legend, light or dark like the reader's screen.
    ///
    /// ```
    /// use tilewright_report::{Lane, Origin, Timeline};
    ///
    /// let chart = Timeline::new("transfer", "A transfer", "time, ms", Origin::Formula).lane(Lane::new("bus").span("a word", 1.0, 2.0));
    /// assert!(chart.svg_text().starts_with("<svg xmlns="));
    /// ```
    pub fn svg_text(&self) -> String {
        plot::svg_file_of_times(self).into_string() + "\n"
    }

    /// A row for each span, share and event. An event has its sign, and begins and ends at the same time. Shares, if there are any, have a column.
    ///
    /// ```
    /// use tilewright_report::{Lane, Origin, Timeline};
    ///
    /// let chart = Timeline::new("transfer", "A transfer", "time, ms", Origin::Formula).lane(Lane::new("bus"));
    /// assert_eq!(chart.csv_text().lines().count(), 1);
    /// ```
    pub fn csv_text(&self) -> String {
        let [from, to] = ["from", "to"].map(|end| format!("{end}: {}", self.axis));
        let has_shares = self.lanes.iter().any(|lane| !lane.columns.is_empty());
        let share = |text: &str| has_shares.then(|| text.to_owned());
        let mut names = ["lane", "event", "what", &from, &to].map(str::to_owned).to_vec();
        names.extend(share("share").into_iter().chain(["origin", "seeds"].map(str::to_owned)));
        let rows = self.rows().into_iter().map(|row| {
            let mut cells = [row.lane, row.sign, row.what].map(str::to_owned).to_vec();
            cells.extend([csv::cell(row.from), csv::cell(row.to)].into_iter().chain(share(&csv::cell(row.share))));
            cells.extend([self.origin.name().to_owned(), self.origin.seeds_in_words()]);
            cells
        });
        String::from_utf8_lossy(&csv::csv([names].into_iter().chain(rows))).into_owned()
    }

    fn rows(&self) -> Vec<Row<'_>> {
        self.lanes.iter().flat_map(Lane::rows).collect()
    }

    /// The names of its columns and spans, each once, in their sequence.
    pub(crate) fn names(&self) -> Vec<&str> {
        let mut names: Vec<&str> = self.kinds.iter().map(|kind| kind.what.as_str()).collect();
        let spans = self.lanes.iter().flat_map(|lane| &lane.spans).map(|span| span.what.as_str());
        let columns = self.lanes.iter().flat_map(|lane| &lane.columns);
        for what in spans.chain(columns.flat_map(|it| it.shares.iter().map(|(what, _)| what.as_str()))) {
            if !names.contains(&what) {
                names.push(what);
            }
        }
        names
    }

    /// The signs of its events with their meanings, each once, sorted by sign.
    fn signs(&self) -> Vec<(&str, &str)> {
        let all = self.lanes.iter().flat_map(|lane| &lane.events);
        let mut signs: Vec<_> = all.map(|event| (event.sign.as_str(), event.what.as_str())).collect();
        signs.sort_unstable();
        signs.dedup();
        signs
    }

    /// Its problem, as the end of a sentence.
    pub(crate) fn problem(&self) -> Option<String> {
        if self.lanes.is_empty() {
            return Some("has no lanes: give it one or more".to_owned());
        }
        let is_wrong = |row: &Row| !(row.from.is_finite() && row.to.is_finite() && row.from <= row.to);
        let Row { lane, what, from, to, .. } = self.rows().into_iter().find(is_wrong)?;
        let (from, to) = (shown(from), shown(to));
        Some(format!("has `{what}` from {from} to {to} in the lane {lane}: give it numbers that do not decrease"))
    }

    pub(crate) fn html(&self) -> Markup {
        let row = |Row { lane, sign, what, from, to, .. }: Row| {
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
                @for (number, name) in self.names().into_iter().enumerate() { li { (plot::sample_of_span(self, number)) (name) } }
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

    /// A description for readers who do not see the chart.
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
    /// The sign of an event; empty for a span.
    sign: &'a str,
    what: &'a str,
    from: f64,
    to: f64,
    share: f64,
}
