//! Draws a chart of times: a bar for each span, and above the bars the signs of events.

use super::Format;
use super::label::apart;
use super::mark::LOOKS;
use super::scale::Scale;
use super::svg::{TENTHS, tenths};
use crate::number::shown;
use crate::palette;
use crate::timeline::{Column, Event, Kind, Lane, Span, Timeline};
use maud::{Markup, html};
use plotters::coord::ranged1d::{BoldPoints, ValueFormatter};
use plotters::prelude::Ranged;

/// Heights in tenths: of a bar, of the signs above it, of the gap between two lanes, and of the axis.
const BAR: i32 = 18 * TENTHS;
const SIGNS: i32 = 18 * TENTHS;
const GAP: i32 = 10 * TENTHS;
const SMALL_GAP: i32 = 4 * TENTHS;
const AXIS: i32 = 44 * TENTHS;

/// The layout of a chart.
struct Layout<'a> {
    scale: Scale,
    /// The ends of the axis.
    ends: (i32, i32),
    /// The names of columns and spans, and the look of each.
    names: Vec<&'a str>,
    looks: Vec<Look>,
    /// Whether lanes have columns.
    has_kinds: bool,
    /// The space for squares with lanes' colours, if some lane has one.
    squares: i32,
    /// The width of a character of a name.
    character: i32,
}

/// The side of a square.
const SQUARE: i32 = 10 * TENTHS;

/// Whether a lane has columns, or kinds for columns.
fn is_of_columns(chart: &Timeline, lane: &Lane) -> bool {
    !chart.kinds.is_empty() && lane.spans.is_empty()
}

/// A chart of times as an SVG element of that format's width.
pub fn svg_of_times(chart: &Timeline, format: Format) -> Markup {
    let (inside, height) = inside(chart, format);
    html! {
        svg.chart.(format.class) viewBox={ "0 0 " (format.width) " " (height) } role="img" aria-label=(chart.alt()) { (inside) }
    }
}

/// The content of that element, and its height.
pub fn inside(chart: &Timeline, format: Format) -> (Markup, f64) {
    let longest = chart.lanes.iter().map(|lane| lane.name.chars().count() as i32).max().unwrap_or(0);
    let (width, character) = (format.width as i32 * TENTHS, format.character * TENTHS);
    let times = chart.lanes.iter().flat_map(|lane| {
        let ends = lane.spans.iter().flat_map(|span| [span.from, span.to]);
        let columns = lane.columns.iter().flat_map(|column| [column.from, column.to]);
        ends.chain(columns).chain(lane.events.iter().map(|event| event.at))
    });
    let squares = if chart.lanes.iter().any(|lane| lane.colour.is_some()) { SQUARE + 5 * TENTHS } else { 0 };
    let layout = Layout {
        scale: Scale::around(times, false),
        ends: (longest * character + 10 * TENTHS + squares, width - 12 * TENTHS),
        names: chart.names(),
        looks: looks(chart),
        has_kinds: !chart.kinds.is_empty(),
        squares,
        character,
    };
    let mut top = 0;
    let tops: Vec<i32> = chart
        .lanes
        .iter()
        .map(|lane| {
            let gap = if is_of_columns(chart, lane) { SMALL_GAP } else { GAP };
            let bar = top + if lane.events.is_empty() { gap } else { SIGNS };
            top = bar + BAR;
            bar
        })
        .collect();
    let bottom = top + GAP;
    let ticks = layout.scale.key_points(BoldPoints(format.labels.0));
    let inside = html! {
        @for tick in &ticks {
            @let x = tenths(layout.x(*tick));
            polyline.grid points={ (x) ",0 " (x) "," (tenths(bottom)) } {}
            text.tick x=(x) y=(tenths(bottom + 6 * TENTHS)) dy="0.75em" text-anchor="middle" { (layout.scale.format_ext(tick)) }
        }
        polyline.axis points={ (tenths(layout.ends.0)) "," (tenths(bottom)) " " (tenths(layout.ends.1)) "," (tenths(bottom)) } {}
        text.label x=(tenths((layout.ends.0 + layout.ends.1) / 2)) y=(tenths(bottom + AXIS)) dy="-0.25em" text-anchor="middle" { (chart.axis) }
        @for (lane, top) in chart.lanes.iter().zip(tops) { (layout.lane(lane, top)) }
    };
    (inside, tenths(bottom + AXIS))
}

/// The look of a span or of a part of a column in the legend.
pub fn sample_of_span(chart: &Timeline, number: usize) -> Markup {
    html! {
        svg.sample viewBox="-15 -7 30 14" aria-hidden="true" { (sample(chart, number)) }
    }
}

/// The same around its centre.
pub fn sample(chart: &Timeline, number: usize) -> Markup {
    let look = looks(chart).swap_remove(number);
    html! { rect class=(look.class) style=[look.style] x="-14" y="-6" width="28" height="12" {} }
}

/// The look of a kind of span.
struct Look {
    class: String,
    /// Its colour, if it is one of the palette.
    style: Option<String>,
}

/// The look of each name. Kinds of work have the palette's colours; kinds of waiting are grey.
fn looks(chart: &Timeline) -> Vec<Look> {
    let (mut work, mut waiting) = (0, 0);
    let look = |(number, _)| match chart.kinds.get(number) {
        Some(Kind { is_quiet: true, .. }) => {
            waiting += 1;
            Look { class: format!("part quiet{}", (waiting - 1) % QUIET), style: None }
        }
        Some(_) => {
            work += 1;
            Look { class: "part".to_owned(), style: Some(format!("fill:{}", palette::css(work - 1))) }
        }
        None => Look { class: look(number), style: None },
    };
    chart.names().iter().enumerate().map(look).collect()
}

/// Greys of the style sheet.
const QUIET: usize = 4;

/// Twice as many looks as colours: filled and hollow alternate, and then the other way round.
fn look(number: usize) -> String {
    let style = if (number + number / LOOKS) % 2 == 1 { "hollow" } else { "filled" };
    format!("{style} look{}", number % LOOKS)
}

impl Layout<'_> {
    fn x(&self, time: f64) -> i32 {
        self.scale.map(&time, self.ends)
    }

    fn lane(&self, lane: &Lane, top: i32) -> Markup {
        // A square is before it, if lanes have colours.
        let end = self.ends.0 - 6 * TENTHS - self.squares;
        html! {
            @if let Some(number) = lane.colour {
                rect.part style={ "fill:" (palette::css(number)) } x=(tenths(end + 5 * TENTHS)) y=(tenths(top + (BAR - SQUARE) / 2)) width=(tenths(SQUARE)) height=(tenths(SQUARE)) {}
            }
            text.tick x=(tenths(end)) y=(tenths(top + BAR / 2)) dy="0.35em" text-anchor="end" { (lane.name) }
            @if self.has_kinds && lane.spans.is_empty() { (self.columns(&lane.columns, top)) }
            @for span in &lane.spans { (self.bar(span, top)) }
            (self.signs(&lane.events, top))
        }
    }

    /// Columns side by side. Each name has the outline of all shares up to its own, and the names before it cover theirs.
    fn columns(&self, columns: &[Column], top: i32) -> Markup {
        let (left, right) = self.ends;
        html! {
            rect.part.lane x=(tenths(left)) y=(tenths(top)) width=(tenths(right - left)) height=(tenths(BAR)) {}
            @for (number, look) in self.looks.iter().enumerate().rev() {
                @let path = self.outline(columns, number, top);
                @if !path.is_empty() { path class=(look.class) style=[&look.style] d=(path) { title { (self.names[number]) } } }
            }
        }
    }

    /// The path around the shares up to that name; nothing where the name has no share.
    fn outline(&self, columns: &[Column], number: usize, top: i32) -> String {
        let is_below = |what: &str| self.names.iter().position(|name| *name == what).is_some_and(|it| it <= number);
        let height = |column: &Column| {
            let sum: f64 = column.shares.iter().filter(|(what, _)| is_below(what)).map(|(_, share)| share).sum();
            (sum.clamp(0.0, 1.0) * f64::from(BAR)).round() as i32
        };
        if !columns.iter().any(|column| column.shares.iter().any(|(what, _)| *what == self.names[number])) {
            return String::new();
        }
        let foot = top + BAR;
        let (mut path, mut at, mut high) = (String::new(), None, 0);
        for column in columns {
            let (from, to, wanted) = (self.x(column.from), self.x(column.to), height(column));
            if at != Some(from) && high > 0 {
                path += &format!("V{}", tenths(foot));
                high = 0;
            }
            if wanted != high {
                path += &match high {
                    0 => format!("M{} {}V{}", tenths(from), tenths(foot), tenths(foot - wanted)),
                    _ => format!("V{}", tenths(foot - wanted)),
                };
                high = wanted;
            }
            if high > 0 {
                path += &format!("H{}", tenths(to));
            }
            at = Some(to);
        }
        if high > 0 { path + &format!("V{}", tenths(foot)) } else { path }
    }

    /// A bar, with its name inside if that fits.
    fn bar(&self, span: &Span, top: i32) -> Markup {
        let (from, to) = (self.x(span.from), self.x(span.to));
        let number = self.names.iter().position(|name| *name == span.what).unwrap_or(0);
        let look = &self.looks[number];
        let has_room = (span.what.chars().count() as i32 + 1) * self.character <= to - from;
        html! {
            g.span {
                rect class=(look.class) style=[&look.style] x=(tenths(from)) y=(tenths(top)) width=(tenths(to - from)) height=(tenths(BAR)) {
                    title { (span.what) ": " (shown(span.from)) " to " (shown(span.to)) }
                }
                @if has_room {
                    text class={ "inside " (look.class) } x=(tenths((from + to) / 2)) y=(tenths(top + BAR / 2)) dy="0.35em" text-anchor="middle" { (span.what) }
                }
            }
        }
    }

    /// The signs of events, each with a line to its time. Signs that would overlap are moved apart.
    fn signs(&self, events: &[Event], top: i32) -> Markup {
        let places: Vec<i32> = events.iter().map(|event| self.x(event.at)).collect();
        html! {
            @for ((event, place), moved) in events.iter().zip(&places).zip(apart(&places)) {
                g.event {
                    title { (event.sign) " " (event.what) ": " (shown(event.at)) }
                    polyline.curve.plain points={
                        (tenths(moved)) "," (tenths(top - 5 * TENTHS)) " " (tenths(*place)) "," (tenths(top)) " " (tenths(*place)) "," (tenths(top + BAR))
                    } {}
                    text.label x=(tenths(moved)) y=(tenths(top - 6 * TENTHS)) text-anchor="middle" { (event.sign) }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::origin::Origin;
    use crate::plot::{NARROW, WIDE};

    #[test]
    fn twelve_looks_differ() {
        let mut looks: Vec<String> = (0..2 * LOOKS).map(look).collect();
        looks.sort_unstable();
        looks.dedup();
        assert_eq!(looks.len(), 12);
    }

    #[test]
    fn a_name_is_in_its_bar_where_there_is_room() {
        let lane = Lane::new("bus").span("sending", 0.0, 99.0).span("waiting", 99.0, 100.0);
        let chart = Timeline::new("bus", "The bus", "ms", Origin::rtl([])).lane(lane);
        for format in [WIDE, NARROW] {
            let svg = svg_of_times(&chart, format).into_string();
            assert!(svg.contains(">sending</text>") && !svg.contains(">waiting</text>"), "{svg}");
        }
    }

    /// Widths of bars are their times, and lanes are one below the other.
    #[test]
    fn bars_are_where_their_times_are() {
        let lanes = [("one", 50.0), ("two", 25.0)];
        let chart =
            lanes.into_iter().fold(Timeline::new("bus", "The bus", "ms", Origin::rtl([])), |chart, (name, to)| {
                chart.lane(Lane::new(name).span("a", 0.0, to).span("b", to, 100.0))
            });
        let svg = svg_of_times(&chart, WIDE).into_string();
        let number = |bar: &str, name: &str| {
            let rest = &bar[bar.find(&format!("{name}=\"")).unwrap() + name.len() + 2..];
            rest[..rest.find('"').unwrap()].parse::<f64>().unwrap()
        };
        let bars: Vec<[f64; 3]> =
            svg.split("<rect").skip(1).map(|bar| [" x", " y", "width"].map(|name| number(bar, name))).collect();
        let [[x, y, wide], [next, _, rest], [_, below, half], [_, _, long]] = bars[..] else { panic!("{bars:?}") };
        assert!((wide - rest).abs() < 0.2 && (next - x - wide).abs() < 0.2, "{bars:?}");
        assert!((wide - 2.0 * half).abs() < 0.2 && (long - 3.0 * half).abs() < 0.3 && below > y + 18.0, "{bars:?}");
    }
}
