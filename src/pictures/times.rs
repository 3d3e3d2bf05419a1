//! What units did over time, as a chart.

use tilewright_machines::{History, Lane, Span};
use tilewright_report::{Lane as Bars, Origin, Timeline};

/// Classes in which a unit waits for others that still work.
const WAITING: [&str; 6] =
    ["stalled", "sync", "swap", "waiting for instructions", "waiting for the store", "waiting for the blanking"];

const NOTE: &str = "A square is the unit's colour in the picture of --owners.";

/// Columns of a chart, and the most spans of a lane that are drawn one by one.
const COLUMNS: u64 = 240;
const FEW: usize = 120;

/// The chart. A lane with few spans shows each of them. A lane with many shows the share of each class in each part of the time. A unit that draws has its
/// colour beside its name.
pub fn chart(history: &History, title: &str) -> Timeline {
    let (kinds, working) = kinds(history);
    let (work, waiting) = kinds.split_at(working);
    let end = history.lanes.iter().filter_map(|lane| Some(lane.spans.last()?.to)).max().unwrap_or(0);
    let chart = Timeline::new("timeline", title, "time, ms", Origin::rtl([])).kinds(work.to_vec(), waiting.to_vec());
    let is_painter = |lane: &Lane| history.painters.contains(&lane.name);
    let chart = if history.lanes.iter().any(is_painter) { chart.note(NOTE) } else { chart };
    let lane = |lane: &Lane| {
        let painter = (0..).zip(&history.painters).find(|(_, name)| **name == lane.name);
        let bars = bars(lane, &kinds, end);
        match painter {
            Some((number, _)) => bars.coloured(number),
            None => bars,
        }
    };
    history.lanes.iter().map(lane).fold(chart, Timeline::lane)
}

/// The activities: first those of work, of which there is that number, then those of waiting.
pub fn kinds(history: &History) -> (Vec<&'static str>, usize) {
    let mut kinds: Vec<&'static str> = Vec::new();
    for span in history.lanes.iter().flat_map(|lane| &lane.spans) {
        if !kinds.contains(&span.what) {
            kinds.push(span.what);
        }
    }
    let (waiting, work): (Vec<&str>, Vec<&str>) = kinds.iter().partition(|kind| WAITING.contains(kind));
    let count = work.len();
    ([work, waiting].concat(), count)
}

/// A lane's parts of the time until that end, with the share of each activity: its spans if they are few, or else columns.
pub fn parts(lane: &Lane, kinds: &[&'static str], end: u64) -> Vec<Column> {
    let follow = lane.spans.array_windows().all(|[one, next]| one.to <= next.from);
    match follow && lane.spans.len() <= FEW {
        true => lane
            .spans
            .iter()
            .map(|span| (span.from, span.to, vec![(span.what, share(span.amount as f64, lane, span.from, span.to))]))
            .collect(),
        false => columns(lane, kinds, end),
    }
}

fn bars(lane: &Lane, kinds: &[&'static str], end: u64) -> Bars {
    parts(lane, kinds, end).into_iter().fold(Bars::new(&lane.name), |bars, (from, to, shares)| {
        bars.shares(milliseconds(from), milliseconds(to), shares)
    })
}

/// Begin and end, and the share of each class in that time.
pub type Column = (u64, u64, Vec<(&'static str, f64)>);

/// The shares in equal parts of the time; equal neighbours are joined.
fn columns(lane: &Lane, kinds: &[&'static str], end: u64) -> Vec<Column> {
    let edge = |number: u64| end * number / COLUMNS;
    let mut amounts = vec![vec![0.0; kinds.len()]; COLUMNS as usize];
    for span in &lane.spans {
        let Some(kind) = kinds.iter().position(|kind| *kind == span.what) else { continue };
        // The column of a time begins at that time or before.
        let first = (span.from * COLUMNS / end.max(1)).min(COLUMNS - 1);
        for column in (first..COLUMNS).take_while(|column| edge(*column) < span.to) {
            amounts[column as usize][kind] += part(span, edge(column), edge(column + 1));
        }
    }
    let mut all: Vec<Column> = Vec::new();
    for (column, amounts) in (0..).zip(&amounts) {
        let (from, to) = (edge(column), edge(column + 1));
        let shares = kinds.iter().zip(amounts).filter(|(_, amount)| **amount > 0.0);
        let shares: Vec<_> = shares.map(|(kind, amount)| (*kind, share(*amount, lane, from, to))).collect();
        match all.last_mut() {
            Some((_, end, before)) if *before == shares && shares.len() == 1 => *end = to,
            _ if shares.is_empty() => {}
            _ => all.push((from, to, shares)),
        }
    }
    all
}

/// The part of a span in that time.
fn part(span: &Span, from: u64, to: u64) -> f64 {
    let common = span.to.min(to).saturating_sub(span.from.max(from));
    span.amount as f64 * common as f64 / (span.to - span.from) as f64
}

/// As a share of the lane's capacity in that time, rounded to a millionth, so that equal neighbours compare equal.
fn share(amount: f64, lane: &Lane, from: u64, to: u64) -> f64 {
    (1e6 * amount / (lane.rate * (to - from) as f64)).round() / 1e6
}

fn milliseconds(picoseconds: u64) -> f64 {
    picoseconds as f64 / 1e9
}

#[cfg(test)]
mod tests {
    use super::*;
    use tilewright_scenes::Size;

    fn history(lanes: Vec<Lane>) -> History {
        let size = Size::new(1, 1).expect("in range");
        History {
            size,
            background: [0; 3],
            region: None,
            painters: Vec::new(),
            writes: Vec::new(),
            lanes,
            areas: Vec::new(),
        }
    }

    /// The bars of a lane in the chart: class and milliseconds.
    fn sum(chart: &Timeline, lane: &str, what: &str) -> f64 {
        let text = chart.csv_text();
        let cells = text.lines().map(|line| line.rsplitn(7, ',').collect::<Vec<_>>());
        let rows = cells.filter(|it| it[it.len() - 1] == format!("{lane},") && it[5] == what);
        rows.map(|it| (it[3].parse::<f64>().unwrap() - it[4].parse::<f64>().unwrap()) * it[2].parse::<f64>().unwrap())
            .sum()
    }

    /// Few spans and many give the same sums, whatever the columns are.
    #[test]
    fn bars_have_the_clocks_of_the_spans() {
        let period = 1_000_000;
        let lane = |name: &str, spans: Vec<Span>| Lane {
            name: name.to_owned(),
            of: "clocks",
            rate: 1.0 / period as f64,
            spans,
        };
        let span = |what, from: u64, to: u64| Span { what, from: from * period, to: to * period, amount: to - from };
        let many = (0..700)
            .map(|it| span(if it % 7 == 0 { "sync" } else { "raster" }, 10 * it, 10 * it + 1 + it % 9))
            .collect();
        let few = vec![span("raster", 3, 17), span("swap", 17, 6_997)];
        let history = history(vec![lane("many", many), lane("few", few)]);
        let chart = chart(&history, "a test");
        for lane in &history.lanes {
            for what in ["sync", "raster", "swap"] {
                let (found, expected) = (sum(&chart, &lane.name, what), lane.amount(what) as f64 * period as f64 / 1e9);
                assert!(
                    (found - expected).abs() < 1e-4 * expected.max(1.0),
                    "{}: {what}: {found} {expected}",
                    lane.name
                );
            }
        }
        assert!(sum(&chart, "many", "sync") > 0.0);
    }
}
