//! The cause of a value in a block's scenario.

use crate::block::{blocks, design, setting, simulation, values};
use crate::moment::{Moment, play_remembered};
use crate::number::number;
use crate::shell::{Exit, Failure, progress, terminal};
use clap::Args;
use serde::Serialize;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::ffi::OsStr;
use tilewright_sim::{Cause, EngineKind, Limits, Part};

/// The options for a block alone.
#[derive(Args)]
#[command(next_help_heading = "Options for a block")]
pub struct BlockOptions {
    /// Name of a net, a register, a port or a word of a memory
    #[arg(long, value_name = "NET", conflicts_with = "pixel")]
    pub signal: Option<String>,
    #[command(flatten)]
    moment: Moment,
    /// The most steps back
    #[arg(long, value_name = "STEPS", default_value_t = 8, value_parser = number::<usize>(0..=1000), conflicts_with = "pixel")]
    depth: usize,
    /// About the most causes
    #[arg(long, value_name = "CAUSES", default_value_t = 100, value_parser = number::<usize>(1..=1_000_000), conflicts_with = "pixel")]
    most: usize,
    /// Tell operations without a name, too
    #[arg(long, conflicts_with = "pixel")]
    operations: bool,
    /// Tell also why a register or a word was not written since
    #[arg(long, conflicts_with = "pixel")]
    kept: bool,
    /// Value of a parameter; may be repeated. `tilewright list BLOCK` shows names and ranges
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = setting, conflicts_with = "pixel")]
    settings: Vec<(String, u64)>,
}

#[derive(Serialize)]
struct Report<'a> {
    format: u32,
    block: &'a str,
    parameters: BTreeMap<&'a str, u64>,
    signal: &'a str,
    /// Whether nothing was left out for `--depth` and `--most`, and all of the past was remembered.
    complete: bool,
    cause: Value,
}

impl BlockOptions {
    /// Plays the scenario of the block of that name, goes back to the cycle and prints the cause, as text or as JSON.
    pub fn run(&self, name: &OsStr, signal: &str, json: bool) -> Result<Exit, Failure> {
        let entry = blocks().find(name).map_err(|sentence| Failure::new(Exit::BadInput, sentence))?;
        let values = values(entry, &self.settings)?;
        let mut sim = simulation(&design(entry, &values)?, EngineKind::default())?;
        let scenario = entry.scenario(&values)?;
        // A name that there is not costs no run.
        sim.why_within(signal, &Limits { depth: 0, ..Limits::default() })?;
        let failed = play_remembered(&mut sim, &scenario)?;
        sim.go_to(self.moment.time(&sim)?)?;
        progress::phase("looking for causes");
        let cause = sim.why_within(signal, &self.limits())?;
        if json {
            let (parameters, complete) = (values.iter().collect(), cause.notes().is_empty());
            let cause = node(&cause);
            let block = entry.name;
            terminal::print_json(&Report { format: 1, block, parameters, signal, complete, cause })?;
        } else {
            terminal::print(&text(&cause))?;
        }
        failed.map_or(Ok(Exit::Done), Err)
    }

    fn limits(&self) -> Limits {
        Limits { depth: self.depth, nodes: self.most, operations: self.operations, kept: self.kept }
    }
}

/// The tree, a line for each cause; what was left out is told in the words of the command line.
fn text(cause: &Cause) -> String {
    let whole = cause.to_string();
    let lines: Vec<&str> = whole.lines().collect();
    let notes = cause.notes();
    let mut text: String = lines[..lines.len() - notes.len()].iter().map(|line| format!("{line}\n")).collect();
    if !notes.is_empty() {
        text += "causes are left out: a greater --depth or --most tells more\n";
    }
    text
}

/// A cause and its causes, as JSON.
pub fn node(cause: &Cause) -> Value {
    json!({
        "name": cause.name,
        "label": cause.label(),
        "kind": kind(cause.part),
        "role": if cause.chooses { "when" } else { "from" },
        "value": cause.number(),
        "clock": cause.clock,
        "cycle": cause.cycle,
        "picoseconds": cause.time,
        "source": cause.loc.as_ref().map(|loc| format!("{}:{}", loc.file(), loc.line())),
        "end": cause.end.map(|end| end.to_string()),
        "causes": cause.causes.iter().map(node).collect::<Vec<_>>(),
    })
}

fn kind(part: Part) -> &'static str {
    match part {
        Part::Input => "input",
        Part::Register => "register",
        Part::ReadData => "read data",
        Part::Word => "word",
        Part::Net => "net",
        Part::Operation => "operation",
    }
}
