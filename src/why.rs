//! `tilewright why`: the cause of a value in a block's scenario.

use crate::block::{BlockArguments, design, simulation};
use crate::moment::{Moment, play_remembered};
use crate::number::number;
use crate::shell::{Exit, Failure, progress, terminal};
use clap::Args;
use serde::Serialize;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use tilewright_sim::{Cause, EngineKind, Limits, Part};

/// Tells why a net has its value in a block's scenario: what decided it, step by step back
#[derive(Args)]
#[command(after_help = "\
Examples:
  tilewright why fifo --signal used
  tilewright why patch-table --signal page --at 12
  tilewright why scan-counter --signal pixel_x --depth 3 --json

A line is a cause of the line above it that stands further left: `from` for what the value came from, `when` for what chose it, as a condition or an
enable does. It has the value, the cycle since when, and the source line. A choice counts its condition and its chosen side alone, an AND that is 0 its zeros.
The name is that of a waveform, such as `u_cell[3].sum`, or `squares[5]` for a word of a memory. Nothing has to be recorded before.

Exit code 1 means that an assertion of the block fails. The cause is told all the same.")]
pub struct Why {
    #[command(flatten)]
    block: BlockArguments,
    /// Name of a net, a register, a port or a word of a memory
    #[arg(long, value_name = "NET")]
    signal: String,
    #[command(flatten)]
    moment: Moment,
    /// The most steps back
    #[arg(long, value_name = "STEPS", default_value_t = 8, value_parser = number::<usize>(0..=1000))]
    depth: usize,
    /// About the most causes
    #[arg(long, value_name = "CAUSES", default_value_t = 100, value_parser = number::<usize>(1..=1_000_000))]
    most: usize,
    /// Tell operations without a name, too
    #[arg(long)]
    operations: bool,
    /// Tell also why a register or a word was not written since
    #[arg(long)]
    kept: bool,
    /// Print the tree as JSON
    #[arg(long)]
    json: bool,
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

impl Why {
    /// Plays the scenario, goes back to the cycle and prints the cause.
    pub fn run(self) -> Result<Exit, Failure> {
        let (entry, values) = self.block.find()?;
        let mut sim = simulation(&design(entry, &values)?, EngineKind::Compiled)?;
        let scenario = entry.scenario(&values)?;
        // A name that there is not costs no run.
        sim.why_within(self.signal.as_str(), &Limits { depth: 0, ..Limits::default() })?;
        let failed = play_remembered(&mut sim, &scenario)?;
        sim.go_to(self.moment.time(&sim)?)?;
        progress::phase("looking for causes");
        let cause = sim.why_within(self.signal.as_str(), &self.limits())?;
        if self.json {
            let (parameters, complete) = (values.iter().collect(), cause.notes().is_empty());
            let cause = node(&cause);
            let (block, signal) = (entry.name, self.signal.as_str());
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

/// A cause and its causes.
fn node(cause: &Cause) -> Value {
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
