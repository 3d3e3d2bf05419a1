//! A chart as a separate file.

use super::Format;
use super::legend::{Entry, entries};
use super::timeline::{inside, sample};
use crate::chart::Chart;
use crate::timeline::Timeline;
use maud::{Markup, PreEscaped, html};

/// The style of a file besides the colours and the charts of a page.
const STYLE: &str = concat!(
    include_str!("../colours.css"),
    include_str!("../charts.css"),
    "svg text, svg text.label, svg text.entry { font-size: 15px; }\nsvg text.title { font-size: 16px; font-weight: 600; }\nsvg text.title, svg text.entry { fill: var(--ink); }\n.paper { fill: var(--page); }\n",
);

/// A page shows the file as a picture, whose text shrinks with it on a telephone. So it is narrow, and its text is large.
const FORMAT: Format = Format { class: "file", width: 530, height: 0, labels: (6, 0), longest: 20, character: 8 };
/// The margin, the height of a line of text, and the approximate width of a character of the title, the note and the legend.
const MARGIN: f64 = 15.0;
const LINE: f64 = 22.0;
const CHARACTER: f64 = 7.9;

/// The size of a chart; names of series that are longer than its names stand in the legend.
const CHART: Format = Format { height: 400, labels: (6, 8), longest: 9, ..FORMAT };

/// A chart as a file.
pub fn svg_file(chart: &Chart) -> Markup {
    let (inside, height) = (super::elements(chart, CHART), f64::from(CHART.height));
    file([&chart.title, &chart.note], &chart.alt(), (inside, height), &entries(chart, CHART))
}

/// A chart of times as a file.
pub fn svg_file_of_times(chart: &Timeline) -> Markup {
    let names = chart.names();
    let entries: Vec<Entry> =
        (0..).zip(&names).map(|(number, name)| (sample(chart, number), (*name).to_owned())).collect();
    file([&chart.title, &chart.note], &chart.alt(), inside(chart, FORMAT), &entries)
}

/// Title and note above the chart, and its legend below.
fn file(texts: [&str; 2], alt: &str, (inside, height): (Markup, f64), entries: &[Entry]) -> Markup {
    let room = f64::from(FORMAT.width);
    let [title, note] = texts.map(|text| broken(text, (room / CHARACTER) as usize));
    let places = places(entries.iter().map(|(_, text)| text.as_str()), room);
    let lines = places.last().map_or(0.0, |(_, line)| line + 1.0);
    let head = MARGIN + (title.len() + note.len()) as f64 * LINE;
    let legend = head + height + LINE;
    let (width, height) = (room + 2.0 * MARGIN, legend + lines * LINE);
    let above = title.iter().map(|line| ("title", line)).chain(note.iter().map(|line| ("note", line)));
    html! {
        svg xmlns="http://www.w3.org/2000/svg" width=(width) height=(height) viewBox={ "0 0 " (width) " " (height) } role="img" aria-label=(alt) {
            style { (PreEscaped(STYLE)) }
            rect.paper width=(width) height=(height) {}
            @for (number, (class, line)) in above.enumerate() {
                text.(class) x=(MARGIN) y=(MARGIN + 14.0 + number as f64 * LINE) { (line) }
            }
            g transform={ "translate(" (MARGIN) "," (head) ")" } { (inside) }
            @for ((sample, text), (left, line)) in entries.iter().zip(&places) {
                g transform={ "translate(" (MARGIN + left + 14.0) "," (legend + line * LINE) ")" } {
                    (sample)
                    text.entry x="22" dy="0.35em" { (text) }
                }
            }
        }
    }
}

/// A text in lines of at most that many characters, if no word is longer.
fn broken(text: &str, longest: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= longest => *line += &format!(" {word}"),
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

/// The places of the entries of a legend: the distance from the left, and the line.
fn places<'a>(names: impl Iterator<Item = &'a str>, width: f64) -> Vec<(f64, f64)> {
    let (mut left, mut line) = (0.0, 0.0);
    let place = |name: &str| {
        let wide = 58.0 + CHARACTER * name.chars().count() as f64;
        if left > 0.0 && left + wide > width {
            (left, line) = (0.0, line + 1.0);
        }
        left += wide;
        (left - wide, line)
    };
    names.map(place).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_that_have_no_room_go_on_below() {
        let names = ["sending", "waiting for all of the others", "x"];
        assert_eq!(places(names.into_iter(), 300.0), [(0.0, 0.0), (0.0, 1.0), (0.0, 2.0)]);
        assert_eq!(places(names.into_iter().take(2), 900.0), [(0.0, 0.0), (58.0 + 7.0 * CHARACTER, 0.0)]);
    }

    #[test]
    fn a_long_text_has_several_lines() {
        assert_eq!(broken("", 9), [""; 0]);
        assert_eq!(broken("what each unit did", 9), ["what each", "unit did"]);
        assert_eq!(broken("a/long/path of it", 9), ["a/long/path", "of it"]);
    }
}
