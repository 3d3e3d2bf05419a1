//! The waves of both files around a difference, as text.

use super::compare::{Both, State};
use super::file::TEXT;
use std::fmt::Write;

/// The columns before and after the time of the difference.
pub const BEFORE: usize = 5;
pub const AFTER: usize = 3;
/// The most characters of a value.
const LONGEST: usize = 24;

/// The columns of waves: the rows above them, and the times whose values they show.
pub struct Columns {
    pub heads: Vec<Row>,
    pub samples: Vec<u64>,
}

/// The waves of these pairs in these columns, two rows for each.
pub fn waves(both: &Both, pairs: &[usize], columns: Columns, names: [&str; 2]) -> String {
    let mut rows = columns.heads;
    let mut state = both.start();
    let start = rows.len();
    for pair in pairs {
        let label = |side: usize| format!("{} {}", names[side], both.pairs[*pair].name);
        rows.extend((0..2).map(|side| Row { label: label(side), cells: Vec::new() }));
    }
    for sample in columns.samples {
        state.go_to(sample);
        for (number, pair) in pairs.iter().enumerate() {
            for side in 0..2 {
                rows[start + 2 * number + side].cells.push(cell(&state, *pair, side));
            }
        }
    }
    draw(&rows)
}

/// Columns around a time: each lasts from an edge of the clock to the next one.
pub fn around(both: &Both, pairs: &[usize], time: u64) -> Columns {
    let begins = begins(both, pairs, time);
    let (_, end) = both.times();
    let ends = begins[1..].iter().map(|next| next - 1).chain([end.max(begins[begins.len() - 1])]);
    // A later change within the clock must not hide the difference.
    let samples = begins.iter().zip(ends).map(|(begin, end)| if *begin == time { time } else { end }).collect();
    let label = format!("time in {}", unit(both.exponent));
    Columns { heads: vec![Row { label, cells: begins.iter().map(u64::to_string).collect() }], samples }
}

/// The name of the unit of 10^`exponent` seconds.
pub fn unit(exponent: i32) -> &'static str {
    match exponent {
        0 => "s",
        -3 => "ms",
        -6 => "us",
        -9 => "ns",
        -12 => "ps",
        -15 => "fs",
        _ => "units",
    }
}

/// A value as text: bits in hexadecimal.
pub fn cell(state: &State, pair: usize, side: usize) -> String {
    let Some(value) = state.value(pair, side) else { return String::new() };
    if state.width(pair) == TEXT {
        return String::from_utf8_lossy(value).into_owned();
    }
    let digit = |bits: &[u8]| match bits {
        _ if bits.iter().all(|bit| matches!(bit, b'0' | b'1')) => {
            let number = bits.iter().fold(0, |number, bit| number << 1 | u32::from(bit - b'0'));
            char::from_digit(number, 16).unwrap_or('?')
        }
        _ if bits.iter().all(|bit| *bit == b'z') => 'z',
        _ => 'x',
    };
    let text: String = value.rchunks(4).rev().map(digit).collect();
    let short = text.trim_start_matches('0');
    if short.is_empty() { "0".to_owned() } else { short.to_owned() }
}

/// Where the columns begin: at rising edges of a clock around the time, or else where one of the pairs changes, and at
/// the time itself.
fn begins(both: &Both, pairs: &[usize], time: u64) -> Vec<u64> {
    let is_clock = |name: &str| name == "clk" || name == "clock" || name.ends_with("_clk");
    let clock = both.pairs.iter().position(|pair| pair.width == 1 && is_clock(&pair.name));
    let watched = clock.map_or_else(|| pairs.to_vec(), |clock| vec![clock]);
    let mut begins = Vec::new();
    let (begin, end) = both.times();
    let (mut state, mut after) = (both.start(), 0);
    state.go_to(begin);
    let values = |state: &State| -> Vec<_> {
        watched.iter().flat_map(|pair| [0, 1].map(|side| state.value(*pair, side).map(<[u8]>::to_vec))).collect()
    };
    let mut last = values(&state);
    begins.push(begin);
    while let Some(next) = state.next_time().filter(|next| *next <= end && after <= AFTER) {
        state.go_to(next);
        let now = values(&state);
        let is_edge = now != last && (clock.is_none() || now[0].as_deref() == Some(b"1") && last[0] != now[0]);
        if is_edge || next == time {
            begins.push(next);
            after += usize::from(next > time);
        }
        last = now;
    }
    begins.dedup();
    let place = begins.iter().position(|begin| *begin == time).unwrap_or(0);
    begins.drain(..place.saturating_sub(BEFORE));
    begins
}

/// A name and a text for each column.
pub struct Row {
    pub label: String,
    pub cells: Vec<String>,
}

fn draw(rows: &[Row]) -> String {
    let label = rows.iter().map(|row| row.label.len()).max().unwrap_or(0);
    let cells = || rows.iter().flat_map(|row| &row.cells);
    let width = cells().map(|cell| cell.chars().count().min(LONGEST)).max().unwrap_or(0);
    let mut text = String::new();
    for row in rows {
        let _ = write!(text, "{:label$} |", row.label);
        for run in row.cells.chunk_by(|one, other| one == other) {
            let room = run.len() * (width + 3) - 3;
            let cell: String = match run[0].chars().count() > room {
                true => run[0].chars().take(room.saturating_sub(2)).chain("..".chars()).collect(),
                false => run[0].clone(),
            };
            let _ = write!(text, " {cell:room$} |");
        }
        text.push('\n');
    }
    text
}
