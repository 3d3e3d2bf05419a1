//! What is told of a comparison, as text and as JSON.

use super::cone::Cone;
use super::run::Instant;
use crate::first_difference::{
    self, AFTER, BEFORE, Both, Columns, Differing, MOST, Matched, Row, differing, lines, listed, waves,
};
use crate::shell::{Failure, terminal};
use crate::why::node;
use serde::Serialize;
use std::collections::{BTreeMap, HashSet};
use tilewright_hdl::catalog::{Entry, Values};
use tilewright_sim::Trace;

/// Two runs that were compared.
pub struct Compared<'a> {
    pub entry: &'static Entry,
    pub values: &'a Values,
    /// The file that has the same run as ours, if it is one of two files.
    pub same: Option<&'a str>,
    pub both: &'a Both<'a>,
    pub matched: &'a Matched,
    pub memories: Memories<'a>,
    /// The instants that were compared.
    pub instants: &'a [Instant],
    /// The first one that differs.
    pub place: Option<usize>,
}

/// What was compared of memories.
pub struct Memories<'a> {
    /// The variables of our run that are words.
    pub words: &'a HashSet<u32>,
    /// The memories for whose words there is no room.
    pub left_out: &'a [String],
    /// Those of which the other run lacks words.
    pub lacking: Vec<String>,
    /// The reads that may give any value.
    pub reads: Vec<String>,
}

#[derive(Serialize)]
struct Report<'a> {
    format: u32,
    block: &'a str,
    parameters: BTreeMap<&'a str, u64>,
    /// The names of both runs.
    runs: [&'a str; 2],
    /// The file that has the same run as the first of them, if it is one of two files.
    #[serde(skip_serializing_if = "Option::is_none")]
    same: Option<&'a str>,
    /// The signals and the clocks that were compared.
    signals: usize,
    clocks: usize,
    /// The words of memories that were compared.
    words: usize,
    /// The signals that only one run has.
    only: &'a [Vec<String>; 2],
    /// The memories for whose words there is no room.
    left_out: &'a [String],
    /// Those of which the other run lacks words.
    lacking: &'a [String],
    /// The reads that were not compared: they may give any value.
    reads: &'a [String],
    difference: Option<Difference<'a>>,
}

#[derive(Serialize)]
struct Difference<'a> {
    /// The cycle of the first clock, and the time at which it begins.
    cycle: Option<u64>,
    picoseconds: u64,
    /// The first one is that at which the difference begins.
    signals: Vec<Differing>,
    /// The causes of its value, as `why --json` has them.
    cause: Option<serde_json::Value>,
    /// What its value comes from in the same clock and was not compared.
    uncompared: &'a [String],
}

impl Compared<'_> {
    /// Prints it, with the cone of the first difference.
    ///
    /// # Errors
    /// Standard output takes nothing.
    pub fn print(&self, cone: Option<&Cone>, json: bool) -> Result<(), Failure> {
        let first = self.place.map(|place| &self.instants[place]).zip(cone);
        if json {
            terminal::print_json(&self.report(first))
        } else {
            let names = self.both.files.map(|file| file.name.as_str());
            let same = self.same.map(|file| format!("tilewright has the same run of {} as {file}\n", self.entry.name));
            let head = same.unwrap_or_default() + &first_difference::only(names, self.matched) + &self.not_compared();
            terminal::print(&(head + &first.map_or_else(|| self.same(), |(instant, cone)| self.text(instant, cone))))
        }
    }

    fn report<'b>(&'b self, first: Option<(&'b Instant, &'b Cone)>) -> Report<'b> {
        let difference = first.map(|(instant, cone)| Difference {
            cycle: instant.cycle,
            picoseconds: instant.picoseconds,
            signals: differing(self.both, &cone.pairs, instant.until - 1),
            cause: cone.cause.as_ref().map(node),
            uncompared: &cone.uncompared,
        });
        Report {
            format: 1,
            block: self.entry.name,
            parameters: self.values.iter().collect(),
            runs: self.both.files.map(|file| file.name.as_str()),
            same: self.same,
            signals: self.both.pairs.len() - self.words(),
            clocks: self.instants.len(),
            words: self.words(),
            only: &self.matched.only,
            left_out: self.memories.left_out,
            lacking: &self.memories.lacking,
            reads: &self.memories.reads,
            difference,
        }
    }

    fn same(&self) -> String {
        let clocks = self.instants.len();
        let counts = self.counts().join(", ");
        format!("no difference in {counts} and {clocks} clock{}\n", if clocks == 1 { "" } else { "s" })
    }

    /// The numbers of signals and of words that were compared, as text.
    fn counts(&self) -> Vec<String> {
        let signals = first_difference::signals(self.both.pairs.len() - self.words());
        let words = match self.words() {
            0 => None,
            1 => Some("1 word of a memory".to_owned()),
            words => Some(format!("{words} words of memories")),
        };
        [signals].into_iter().chain(words).collect()
    }

    /// The number of words of memories that were compared.
    fn words(&self) -> usize {
        self.both.pairs.iter().filter(|pair| self.memories.words.contains(&pair.variables[0])).count()
    }

    /// Lines on what was not compared of memories.
    fn not_compared(&self) -> String {
        let Memories { left_out, lacking, reads, .. } = &self.memories;
        let of = |memories: &[String]| match memories {
            [memory] => format!("the memory {memory}"),
            memories => format!("the memories {}", listed(memories)),
        };
        let mut text = String::new();
        if !lacking.is_empty() {
            text += &format!("only in {}: words of {}\n", self.both.files[0].name, of(lacking));
        }
        if !left_out.is_empty() {
            text += &format!("not compared: words of {}, as the limit is {} words\n", of(left_out), Trace::MOST_WORDS);
        }
        if !reads.is_empty() {
            let names = listed(reads);
            text += &format!(
                "not compared: {names}, as a read of a word that is written at the same edge may give any value\n"
            );
        }
        text
    }

    fn text(&self, instant: &Instant, cone: &Cone) -> String {
        let (count, of) = (cone.pairs.len(), self.counts().join(" and "));
        let cycle = instant.cycle.map(|cycle| format!("in cycle {cycle}, ")).unwrap_or_default();
        let mut text = format!("the first difference is {cycle}at {} ps, in {count} of {of}:\n", instant.picoseconds);
        text += &lines(self.both, &cone.pairs, instant.until - 1);
        let shown = &cone.pairs[..cone.pairs.len().min(MOST)];
        let names = self.both.files.map(|file| file.name.as_str());
        text += &format!("\n{}", waves(self.both, shown, self.columns(), names));
        if let Some(cause) = &cone.cause {
            text += &format!("\nwhy it has its value in {}:\n{}", names[0], tree(cone, cause.to_string(), names[1]));
            let name = &cause.name;
            text += &match &cone.uncompared[..] {
                [] => format!("the difference begins at {name}: what its value comes from is the same in both\n"),
                others => {
                    let others = others.join(", ");
                    format!("the difference begins at {name}, or before it at what was not compared: {others}\n")
                }
            };
        }
        text
    }

    /// The clocks around the first difference.
    fn columns(&self) -> Columns {
        let place = self.place.unwrap_or(0);
        let around = &self.instants[place.saturating_sub(BEFORE)..self.instants.len().min(place + AFTER + 1)];
        let row = |label: &str, cell: &dyn Fn(&Instant) -> Option<u64>| {
            let cells: Option<Vec<String>> =
                around.iter().map(|it| cell(it).map(|number| number.to_string())).collect();
            Some(Row { label: label.to_owned(), cells: cells? })
        };
        let cycles = row("cycle", &|instant| instant.cycle);
        let times = row("time in ps", &|instant| Some(instant.picoseconds));
        let heads = cycles.into_iter().chain(times).collect();
        Columns { heads, samples: around.iter().map(|instant| instant.until - 1).collect() }
    }
}

/// The tree of causes, with the other value where it is another one. Notes on what is left out are not for this command's users.
fn tree(cone: &Cone, text: String, other: &str) -> String {
    let line = |(line, value): (&str, &Option<String>)| match value {
        Some(value) => format!("{line}  ({value} in {other})\n"),
        None => format!("{line}\n"),
    };
    text.lines().zip(&cone.others).map(line).collect()
}
