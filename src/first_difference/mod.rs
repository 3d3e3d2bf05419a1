//! `tilewright wave --diff`: the first time at which two waveform files differ, and in which signals.

mod compare;
mod file;
mod names;
mod text;

use crate::shell::{Exit, Failure, terminal};
use compare::Both;
use file::Waves;
use std::path::{Path, PathBuf};

/// The most signals that are shown, and the most names that are listed of those that only one file has.
const MOST: usize = 8;

/// Compares two files, and prints where they differ first.
///
/// # Errors
/// One cannot be read, or they have no signal or no time in common.
pub fn run(paths: &[PathBuf]) -> Result<Exit, Failure> {
    let [one, other] = paths else {
        return Err(Failure::new(Exit::BadInput, "--diff takes two waveform files: name both"));
    };
    let files = [Waves::read(one)?, Waves::read(other)?];
    let files = [&files[0], &files[1]];
    let matched = names::matched(files);
    let names = [one, other].map(|path| path.as_path());
    if matched.pairs.is_empty() {
        let sentence =
            format!("{} and {} have no signal in common: name files of the same design", files[0].name, files[1].name);
        return Err(Failure::new(Exit::BadInput, sentence));
    }
    let both = Both::new(files, &matched.pairs);
    let (begin, end) = both.times();
    if begin > end {
        let sentence =
            format!("{} and {} have no time in common: name files of the same run", files[0].name, files[1].name);
        return Err(Failure::new(Exit::BadInput, sentence));
    }
    let mut report = String::new();
    for (file, only) in files.iter().zip(&matched.only).filter(|(_, only)| !only.is_empty()) {
        report += &format!("only in {}: {}\n", file.name, listed(only));
    }
    let unit = text::unit(both.exponent);
    let count = matched.pairs.len();
    let difference = both.first_difference();
    match difference {
        None => report += &format!("no difference in {} from {begin} to {end} {unit}\n", signals(count)),
        Some(time) => report += &shown(&both, time, names),
    }
    terminal::print(&report)?;
    Ok(if difference.is_some() { Exit::CheckFailed } else { Exit::Done })
}

/// What differs at a time, and the waves around it.
fn shown(both: &Both, time: u64, names: [&Path; 2]) -> String {
    let mut state = both.start();
    state.go_to(time);
    let pairs: Vec<usize> = (0..both.pairs.len()).filter(|pair| state.differs(*pair)).collect();
    let (unit, count) = (text::unit(both.exponent), both.pairs.len());
    let mut report = format!("the first difference is at {time} {unit}, in {} of {}:\n", pairs.len(), signals(count));
    for pair in pairs.iter().take(MOST) {
        let [one, other] = [0, 1].map(|side| text::cell(&state, *pair, side));
        report += &format!(
            "  {}: {one} in {}, {other} in {}\n",
            both.pairs[*pair].name, both.files[0].name, both.files[1].name
        );
    }
    if pairs.len() > MOST {
        report += &format!("  and {} more\n", pairs.len() - MOST);
    }
    let is_same = names[0].file_name() == names[1].file_name();
    let labels = if is_same { ["1st", "2nd"] } else { [0, 1].map(|side: usize| both.files[side].name.as_str()) };
    report + "\n" + &text::waves(both, &pairs[..pairs.len().min(MOST)], time, labels)
}

fn signals(count: usize) -> String {
    if count == 1 { "1 signal".to_owned() } else { format!("{count} signals") }
}

/// The first of these names, and how many there are more.
fn listed(names: &[String]) -> String {
    let more = names.len().saturating_sub(MOST);
    let first = names[..names.len() - more].join(", ");
    if more > 0 { format!("{first} and {more} more") } else { first }
}
