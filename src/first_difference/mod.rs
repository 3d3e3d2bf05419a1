//! The first time at which two waveforms differ, and in which signals: `tilewright wave --diff`, and what `--against` shares with it.

mod compare;
mod file;
mod lanes;
mod names;
mod text;

pub use compare::{Both, State};
pub use file::Waves;
pub use names::{Matched, matched, name};
pub use text::{AFTER, BEFORE, Columns, Row, cell, waves};

use crate::shell::{Exit, Failure, terminal};
use serde::Serialize;
use std::path::{Path, PathBuf};

/// The most signals that are shown, and the most names that are listed of those that only one file has.
pub const MOST: usize = 8;

#[derive(Serialize)]
struct Report<'a> {
    format: u32,
    files: [&'a str; 2],
    /// The unit of all times.
    unit: &'static str,
    /// The times that both files have.
    from: u64,
    to: u64,
    /// The signals that both have.
    signals: usize,
    /// Those that only one has.
    only: &'a [Vec<String>; 2],
    difference: Option<Difference>,
}

#[derive(Serialize)]
struct Difference {
    time: u64,
    signals: Vec<Differing>,
}

/// A signal with different values.
#[derive(Serialize)]
pub struct Differing {
    name: String,
    /// In hexadecimal, with x and z; or texts.
    values: [String; 2],
}

/// Compares two files, and prints where they differ first.
///
/// # Errors
/// One cannot be read, or they have no signal or no time in common.
pub fn run(paths: &[PathBuf], json: bool) -> Result<Exit, Failure> {
    let [one, other] = paths else {
        return Err(Failure::new(Exit::BadInput, "--diff takes two waveform files: name both"));
    };
    let files = [Waves::read(one)?, Waves::read(other)?];
    let files = [&files[0], &files[1]];
    let matched = checked(matched(files), files)?;
    let both = Both::new(files, &matched.pairs);
    let (begin, end) = both.times();
    if begin > end {
        return Err(no_time(files));
    }
    let (unit, difference) = (text::unit(both.exponent), both.first_difference());
    if json {
        let difference =
            difference.map(|time| Difference { time, signals: differing(&both, &pairs_at(&both, time), time) });
        terminal::print_json(&Report {
            format: 1,
            files: files.map(|file| file.name.as_str()),
            unit,
            from: begin,
            to: end,
            signals: matched.pairs.len(),
            only: &matched.only,
            difference,
        })?;
    } else {
        let mut report = only(files.map(|file| file.name.as_str()), &matched);
        let count = signals(matched.pairs.len());
        match difference {
            None => report += &format!("no difference in {count} from {begin} to {end} {unit}\n"),
            Some(time) => report += &shown(&both, time, [one, other].map(|path| path.as_path())),
        }
        terminal::print(&report)?;
    }
    Ok(if difference.is_some() { Exit::CheckFailed } else { Exit::Done })
}

/// The signals that both files have.
///
/// # Errors
/// There are none.
pub fn checked(matched: Matched, [one, other]: [&Waves; 2]) -> Result<Matched, Failure> {
    if !matched.pairs.is_empty() {
        return Ok(matched);
    }
    let sentence = format!("{} and {} have no signal in common: name files of the same design", one.name, other.name);
    Err(Failure::new(Exit::BadInput, sentence))
}

/// The files have no time in common.
pub fn no_time([one, other]: [&Waves; 2]) -> Failure {
    let sentence = format!("{} and {} have no time in common: name files of the same run", one.name, other.name);
    Failure::new(Exit::BadInput, sentence)
}

/// Lines on the signals that only one of two files has.
pub fn only(names: [&str; 2], matched: &Matched) -> String {
    let lines = names.into_iter().zip(&matched.only).filter(|(_, only)| !only.is_empty());
    lines.map(|(name, only)| format!("only in {name}: {}\n", listed(only))).collect()
}

/// The pairs that differ at a time.
pub fn pairs_at(both: &Both, time: u64) -> Vec<usize> {
    let mut state = both.start();
    state.go_to(time);
    (0..both.pairs.len()).filter(|pair| state.differs(*pair)).collect()
}

/// The values of these pairs at a time.
pub fn differing(both: &Both, pairs: &[usize], time: u64) -> Vec<Differing> {
    let mut state = both.start();
    state.go_to(time);
    let values = |pair: usize| [0, 1].map(|side| cell(&state, pair, side));
    pairs.iter().map(|pair| Differing { name: both.pairs[*pair].name.clone(), values: values(*pair) }).collect()
}

/// A line for each of these pairs with both values at a time.
pub fn lines(both: &Both, pairs: &[usize], time: u64) -> String {
    let [one, other] = both.files.map(|file| &file.name);
    let shown = differing(both, &pairs[..pairs.len().min(MOST)], time);
    let line = |it: &Differing| format!("  {}: {} in {one}, {} in {other}\n", it.name, it.values[0], it.values[1]);
    let mut lines: String = shown.iter().map(line).collect();
    if pairs.len() > MOST {
        lines += &format!("  and {} more\n", pairs.len() - MOST);
    }
    lines
}

/// What differs at a time, and the waves around it.
fn shown(both: &Both, time: u64, names: [&Path; 2]) -> String {
    let pairs = pairs_at(both, time);
    let (unit, count) = (text::unit(both.exponent), signals(both.pairs.len()));
    let report = format!("the first difference is at {time} {unit}, in {} of {count}:\n", pairs.len());
    let is_same = names[0].file_name() == names[1].file_name();
    let labels = if is_same { ["1st", "2nd"] } else { both.files.map(|file| file.name.as_str()) };
    let first = &pairs[..pairs.len().min(MOST)];
    let waves = waves(both, first, text::around(both, first, time), labels);
    format!("{report}{}\n{waves}", lines(both, &pairs, time))
}

/// A number of signals in words.
pub fn signals(count: usize) -> String {
    if count == 1 { "1 signal".to_owned() } else { format!("{count} signals") }
}

/// The first of these names, and how many there are more.
pub fn listed(names: &[String]) -> String {
    let more = names.len().saturating_sub(MOST);
    let first = names[..names.len() - more].join(", ");
    if more > 0 { format!("{first} and {more} more") } else { first }
}
