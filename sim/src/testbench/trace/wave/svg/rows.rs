//! What a block of columns shows: its axis, names, clocks, levels and values.

use std::fmt::Write;
use std::ops::Range;

use super::super::{ClockLine, Row};
use super::escaped;
use super::layout::{Block, DIGIT, HEXAGON, HIGH, Line, tenths};
use tilewright_circuit::ir::Kind;

/// How far a slope goes to both sides of its time, and how far the end of a hexagon reaches.
const SLOPE: f64 = 1.5;
const POINT: f64 = 4.0;
/// Pixels between two times of the axis, at least.
const TICK: f64 = 64.0;

impl Block<'_> {
    /// The edges of the first clock, and the times of some of them.
    pub fn axis(&self, svg: &mut String) {
        let Some(ClockLine { period, .. }) = self.data.clocks.first() else { return };
        let ((top, bottom), times) = (self.ends(), self.times());
        let (mut path, mut last) = (String::new(), f64::NEG_INFINITY);
        for edge in (times.start.div_ceil(*period)..=times.end / period).map(|number| number * period) {
            let x = self.x(edge);
            let _ = write!(path, "M{x} {top}V{bottom}");
            if x - last >= TICK {
                let y = top - 5.0;
                let _ = writeln!(
                    svg,
                    "<text class=\"time\" x=\"{x}\" y=\"{y}\" text-anchor=\"middle\">{}</text>",
                    time(edge)
                );
                last = x;
            }
        }
        let _ = writeln!(svg, "<path class=\"edge\" d=\"{path}\"/>");
    }

    /// The name of a line.
    pub fn label(&self, svg: &mut String, line: &Line, top: f64) {
        let (class, name) = match line {
            Line::Clock(clock) => ("", self.data.clocks[*clock].name.as_str()),
            Line::Group(name) => (" class=\"group\"", name.as_str()),
            Line::Row { name, .. } => ("", name.as_str()),
        };
        let (x, y) = (self.names_end(), top + HIGH / 2.0 + 4.0);
        let _ = writeln!(svg, "<text{class} x=\"{x}\" y=\"{y}\" text-anchor=\"end\">{}</text>", escaped(name));
    }

    /// A clock has an edge at every multiple of its period, and returns half a period later.
    pub fn clock(&self, svg: &mut String, clock: &ClockLine, top: f64) {
        let (times, period) = (self.times(), clock.period);
        let level = |is_past_edge: bool| if is_past_edge != clock.falls { top } else { top + HIGH };
        let is_past_edge = |time: u64| time >= period && time % period < period / 2;
        let mut path = format!("M{} {}", self.x(times.start), level(is_past_edge(times.start)));
        let mut at = times.start - times.start % period;
        while at < times.end {
            for (change, is_past_edge) in [(at, at >= period), (at + period / 2, false)] {
                if change > times.start && change < times.end {
                    let _ = write!(path, "H{}V{}", self.x(change), level(is_past_edge));
                }
            }
            at += period;
        }
        let _ = writeln!(svg, "<path class=\"clock\" d=\"{path}H{}\"/>", self.x(times.end));
    }

    pub fn row(&self, svg: &mut String, row: &Row, top: f64) {
        if row.is_bit() { self.levels(svg, row, top) } else { self.values(svg, row, top) }
    }

    fn levels(&self, svg: &mut String, row: &Row, top: f64) {
        let level = |column: usize| if row.values[column].bit(0) { top } else { top + HIGH };
        let times = self.times();
        let mut path = format!("M{} {}", self.x(times.start), level(self.columns.start));
        for column in self.columns.start + 1..self.columns.end {
            if level(column) != level(column - 1) {
                let x = self.x(self.data.columns[column].0);
                let (before, after) = (tenths(x - SLOPE), tenths(x + SLOPE));
                let _ = write!(path, "H{before}L{after} {}", level(column));
            }
        }
        let _ = writeln!(svg, "<path class=\"bit\" d=\"{path}H{}\"/>", self.x(times.end));
    }

    /// A hexagon for each value, with what of its text has room.
    fn values(&self, svg: &mut String, row: &Row, top: f64) {
        let class = if matches!(row.source.kind, Kind::Code(_)) { "code" } else { "bus" };
        for (columns, text) in row.spans(self.columns.clone()) {
            let [left, right] =
                [self.data.columns[columns.start].0, self.data.columns[columns.end - 1].1].map(|time| self.x(time));
            let (middle, foot, point) = (top + HIGH / 2.0, top + HIGH, POINT.min((right - left) / 2.0));
            let (from, to) = (tenths(left + point), tenths(right - point));
            let _ = write!(
                svg,
                "<g><title>{}</title><path class=\"{class}\" d=\"M{left} {middle}L{from} {top}H{to}L{right} {middle}L{to} {foot}H{from}Z\"/>",
                escaped(&text)
            );
            let room = ((right - left - HEXAGON) / DIGIT + 1e-6).max(0.0) as usize;
            let shown = shortened(&text, room);
            if !shown.is_empty() {
                let (x, y) = (tenths((left + right) / 2.0), middle + 4.0);
                let _ = write!(
                    svg,
                    "<text class=\"value\" x=\"{x}\" y=\"{y}\" text-anchor=\"middle\">{}</text>",
                    escaped(&shown)
                );
            }
            svg.push_str("</g>\n");
        }
    }

    /// A dot at each edge at which an item of a stream is taken.
    pub fn taken(&self, svg: &mut String) {
        let [ClockLine { period, .. }] = &self.data.clocks[..] else { return };
        for [valid, ready] in self.layout.streams() {
            let is_high = |row: usize, column: usize| self.data.rows[row].values[column].bit(0);
            let lines = self.layout.lines().iter().zip(self.tops());
            let Some((_, top)) =
                lines.into_iter().find(|(line, _)| matches!(line, Line::Row { row, .. } if row == valid))
            else {
                continue;
            };
            for column in self.columns.clone().filter(|column| is_high(*valid, *column) && is_high(*ready, *column)) {
                let edge = self.data.columns[column].1;
                if edge.is_multiple_of(*period) {
                    let _ = writeln!(svg, "<circle class=\"taken\" cx=\"{}\" cy=\"{top}\" r=\"3.5\"/>", self.x(edge));
                }
            }
        }
    }
}

impl Row {
    /// The values of some columns, each with the columns that it lasts.
    pub(super) fn spans(&self, columns: Range<usize>) -> Vec<(Range<usize>, String)> {
        let mut at = columns.start;
        let span = |(text, count): (String, usize)| {
            at += count;
            (at - count..at, text)
        };
        self.runs(columns).into_iter().map(span).collect()
    }
}

/// What of a text has room for so many characters; nothing if that is too little to read.
fn shortened(text: &str, room: usize) -> String {
    let length = text.chars().count();
    match (length <= room, room) {
        (true, _) => text.to_owned(),
        (false, 0 | 1) => String::new(),
        (false, _) => text.chars().take(room - 1).chain(['…']).collect(),
    }
}

/// A time in the largest unit of which it is a whole number, from nanoseconds on.
fn time(picoseconds: u64) -> String {
    let nanoseconds = picoseconds as f64 / 1000.0;
    match picoseconds {
        0 => "0".to_owned(),
        _ if picoseconds.is_multiple_of(1_000_000) => format!("{} µs", picoseconds / 1_000_000),
        _ => format!("{nanoseconds} ns"),
    }
}
