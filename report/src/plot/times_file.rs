//! A chart of times as a separate file.

use super::Format;
use super::timeline::{inside, sample};
use crate::timeline::Timeline;
use maud::{Markup, PreEscaped, html};

/// The style of a file besides the colours and the charts of a page.
const STYLE: &str = concat!(
    include_str!("../colours.css"),
    include_str!("../charts.css"),
    "svg text.title { font-size: 16px; font-weight: 600; fill: var(--ink); }\nsvg text.entry { font-size: 13px; fill: var(--ink); }\n.paper { fill: var(--page); }\n",
);

const FORMAT: Format = Format { class: "file", width: 960, height: 0, labels: (12, 0), longest: 20 };
/// The margin, the distance from the top to the chart, and the height of a line of the legend.
const MARGIN: f64 = 20.0;
const HEAD: f64 = 34.0;
const LINE: f64 = 20.0;

/// The chart with its title above and its legend below.
pub fn svg_file_of_times(chart: &Timeline) -> Markup {
    let (inside, height) = inside(chart, FORMAT);
    let entries = places(&chart.names(), f64::from(FORMAT.width));
    let lines = entries.last().map_or(0.0, |(_, line)| line + 1.0);
    let legend = MARGIN + HEAD + height + 22.0;
    let (width, height) = (f64::from(FORMAT.width) + 2.0 * MARGIN, legend + lines * LINE + MARGIN / 2.0);
    html! {
        svg xmlns="http://www.w3.org/2000/svg" width=(width) height=(height) viewBox={ "0 0 " (width) " " (height) } role="img" aria-label=(chart.alt()) {
            style { (PreEscaped(STYLE)) }
            rect.paper width=(width) height=(height) {}
            text.title x=(MARGIN) y=(MARGIN + 14.0) { (chart.title) }
            text x=(width - MARGIN) y=(MARGIN + 14.0) text-anchor="end" { (chart.note) }
            g transform={ "translate(" (MARGIN) "," (MARGIN + HEAD) ")" } { (inside) }
            @for (number, (name, (left, line))) in chart.names().iter().zip(&entries).enumerate() {
                g transform={ "translate(" (MARGIN + left + 14.0) "," (legend + line * LINE) ")" } {
                    (sample(chart, number))
                    text.entry x="22" dy="0.35em" { (name) }
                }
            }
        }
    }
}

/// The places of the entries of a legend: the distance from the left, and the line.
fn places(names: &[&str], width: f64) -> Vec<(f64, f64)> {
    let (mut left, mut line) = (0.0, 0.0);
    let place = |name: &&str| {
        let wide = 58.0 + 7.0 * name.chars().count() as f64;
        if left > 0.0 && left + wide > width {
            (left, line) = (0.0, line + 1.0);
        }
        left += wide;
        (left - wide, line)
    };
    names.iter().map(place).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_that_have_no_room_go_on_below() {
        let names = ["sending", "waiting for all of the others", "x"];
        assert_eq!(places(&names, 300.0), [(0.0, 0.0), (0.0, 1.0), (0.0, 2.0)]);
        assert_eq!(places(&names[..2], 900.0), [(0.0, 0.0), (107.0, 0.0)]);
    }
}
