//! Where what of a wave is in a picture.

use std::ops::Range;

use super::super::{Data, Row};
use super::escaped;

/// In pixels: around all, the height of a line, that of what it shows, and what is above a block for its axis, and between blocks.
pub const MARGIN: f64 = 14.0;
pub const LINE: f64 = 24.0;
pub const HIGH: f64 = 16.0;
const AXIS: f64 = 18.0;
const BETWEEN: f64 = 14.0;
/// The width of a character of a name, and of a value.
const LETTER: f64 = 7.3;
pub const DIGIT: f64 = 6.7;
/// What a hexagon takes beside its text.
pub const HEXAGON: f64 = 12.0;
/// The narrowest and the widest that a period of the fastest clock is drawn, and the widest block.
const PERIOD: [f64; 2] = [28.0, 84.0];
const BLOCK: f64 = 960.0;

/// A line of the picture.
pub enum Line {
    /// A clock, by number.
    Clock(usize),
    /// The name of a record whose fields follow.
    Group(String),
    /// A row, by number, with its name, and whether it is of the group above.
    Row { row: usize, name: String, is_field: bool },
}

/// Where what is.
pub struct Layout<'a> {
    data: &'a Data,
    lines: Vec<Line>,
    /// Rows of streams: valid and ready.
    streams: Vec<[usize; 2]>,
    /// What names take.
    names: f64,
    /// Pixels of a picosecond.
    scale: f64,
    /// The columns of each block.
    blocks: Vec<Range<usize>>,
}

/// Columns that are in a line.
pub struct Block<'a> {
    pub layout: &'a Layout<'a>,
    pub data: &'a Data,
    pub columns: Range<usize>,
    top: f64,
}

impl<'a> Layout<'a> {
    pub fn new(data: &'a Data) -> Layout<'a> {
        let lines = lines(data);
        let length = |line: &Line| match line {
            Line::Clock(clock) => data.clocks[*clock].name.len(),
            Line::Group(name) => name.len(),
            Line::Row { name, is_field, .. } => name.len() + if *is_field { 2 } else { 0 },
        };
        let names = LETTER * lines.iter().map(length).max().unwrap_or(0) as f64;
        let scale = scale(data);
        let mut blocks: Vec<Range<usize>> = Vec::new();
        for (number, (_, until)) in data.columns.iter().enumerate() {
            match blocks.last_mut() {
                Some(block) if (until - data.columns[block.start].0) as f64 * scale <= BLOCK => block.end = number + 1,
                _ => blocks.push(number..number + 1),
            }
        }
        let streams = if data.clocks.len() == 1 { streams(data) } else { Vec::new() };
        Layout { data, lines, streams, names, scale, blocks }
    }

    pub fn lines(&self) -> &[Line] {
        &self.lines
    }

    pub fn has_streams(&self) -> bool {
        !self.streams.is_empty()
    }

    pub fn streams(&self) -> &[[usize; 2]] {
        &self.streams
    }

    /// What it is, for those who do not see it.
    pub fn about(&self) -> String {
        let names: Vec<String> = self.data.rows.iter().map(|row| escaped(&row.source.name)).collect();
        format!("A wave of {}", names.join(", "))
    }

    fn block_height(&self) -> f64 {
        AXIS + LINE * self.lines.len() as f64 + BETWEEN
    }

    pub fn size(&self) -> (f64, f64) {
        let width = self.blocks.iter().map(|columns| self.width(columns)).fold(0.0, f64::max);
        let foot = if self.has_streams() { LINE } else { 0.0 };
        let height = self.block_height() * self.blocks.len() as f64 + 2.0 * MARGIN - BETWEEN + foot;
        // Half of the last time of the axis is beyond the wave.
        ((self.left() + width + 2.0 * MARGIN).ceil(), height)
    }

    fn width(&self, columns: &Range<usize>) -> f64 {
        (self.data.columns[columns.end - 1].1 - self.data.columns[columns.start].0) as f64 * self.scale
    }

    /// Where names end and waves begin.
    fn left(&self) -> f64 {
        MARGIN + self.names + 10.0
    }

    pub fn blocks(&self) -> impl Iterator<Item = Block<'_>> {
        let block = |(number, columns): (usize, &Range<usize>)| Block {
            layout: self,
            data: self.data,
            columns: columns.clone(),
            top: MARGIN + self.block_height() * number as f64,
        };
        self.blocks.iter().enumerate().map(block)
    }
}

impl Block<'_> {
    /// Where a time is.
    pub fn x(&self, time: u64) -> f64 {
        let begin = self.data.columns[self.columns.start].0;
        tenths(self.layout.left() + (time - begin) as f64 * self.layout.scale)
    }

    pub fn times(&self) -> Range<u64> {
        self.data.columns[self.columns.start].0..self.data.columns[self.columns.end - 1].1
    }

    /// The upper ends of what each line shows.
    pub fn tops(&self) -> impl Iterator<Item = f64> {
        let first = self.top + AXIS + (LINE - HIGH) / 2.0;
        (0..self.layout.lines.len()).map(move |line| first + LINE * line as f64)
    }

    /// From the first line to the last.
    pub fn ends(&self) -> (f64, f64) {
        let top = self.top + AXIS;
        (top, top + LINE * self.layout.lines.len() as f64)
    }

    /// Where names end.
    pub fn names_end(&self) -> f64 {
        self.layout.left() - 8.0
    }
}

/// To a tenth of a pixel.
pub fn tenths(place: f64) -> f64 {
    (10.0 * place).round() / 10.0
}

/// Clocks, and then rows: those that follow each other and are fields of one record below its name.
fn lines(data: &Data) -> Vec<Line> {
    let mut lines: Vec<Line> = (0..data.clocks.len()).map(Line::Clock).collect();
    let numbers: Vec<usize> = (0..data.rows.len()).collect();
    for rows in numbers.chunk_by(|one, next| record(data, *one) == record(data, *next)) {
        let group = record(data, rows[0]).filter(|_| rows.len() > 1);
        lines.extend(group.map(|name| Line::Group(name.to_owned())));
        for &row in rows {
            let source = &data.rows[row].source;
            let name = match group {
                Some(group) => source.path[group.len() + 1..].to_owned(),
                None => source.path.clone(),
            };
            lines.push(Line::Row { row, name, is_field: group.is_some() });
        }
    }
    lines
}

/// Rows that say that there is an item, and that it may go, of one record.
fn streams(data: &Data) -> Vec<[usize; 2]> {
    let find = |path: String| data.rows.iter().position(|row| row.source.path == path);
    let stream = |(valid, row): (usize, &Row)| {
        let record = row.source.path.strip_suffix(".valid")?;
        Some([valid, find(format!("{record}.ready"))?])
    };
    data.rows.iter().enumerate().filter_map(stream).collect()
}

/// The record that a row is a field of, if it is of one.
fn record(data: &Data, row: usize) -> Option<&str> {
    let path = &data.rows[row].source.path;
    path.rsplit_once('.').map(|(record, _)| record)
}

/// So that values can be read, as far as that makes no clock too wide.
fn scale(data: &Data) -> f64 {
    let period = data.clocks.iter().map(|clock| clock.period).min().unwrap_or(1).max(1) as f64;
    let buses = data.rows.iter().filter(|row| !row.is_bit());
    let needed = buses.flat_map(|row| row.spans(0..row.values.len())).map(|(columns, text)| {
        let time = data.columns[columns.end - 1].1 - data.columns[columns.start].0;
        (DIGIT * text.chars().count() as f64 + HEXAGON) / time as f64
    });
    needed.fold(PERIOD[0] / period, f64::max).min(PERIOD[1] / period)
}
