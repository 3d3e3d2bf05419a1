//! `tilewright verilog --equal-to`: a module written by hand is proved equal to a block, or a run shows a difference.

use crate::block::ports;
use crate::number::number;
use crate::shell::{Exit, Failure, interrupt, progress, terminal};
use clap::Args;
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::PathBuf;
use tilewright_hdl::catalog::{Entry, Values};
use tilewright_hdl::{Bits, Design};
use tilewright_prove::{Difference, Equivalence, Stage, Value, Verdict};
use tilewright_sim::Simulation;

/// What a block is compared with.
#[derive(Args)]
pub struct EqualOptions {
    /// Prove a module in this Verilog file equal to the block; may be repeated for the files of its parts
    #[arg(long, value_name = "FILE", conflicts_with_all = ["output", "testbench", "constraints", "pins"])]
    equal_to: Vec<PathBuf>,
    /// The module's name [default: the block's, or the one that no other contains]
    #[arg(long, value_name = "NAME", requires = "equal_to", conflicts_with = "output")]
    module: Option<String>,
    /// Value of a parameter of the module; may be repeated
    #[arg(short = 'P', value_name = "NAME=VALUE", value_parser = parameter, requires = "equal_to", conflicts_with = "output")]
    parameters: Vec<(String, i64)>,
    /// The number of clocks in which a difference is searched if there is no proof
    #[arg(long, value_name = "CLOCKS", default_value_t = 50, value_parser = number(1_u32..=10_000), requires = "equal_to", conflicts_with = "output")]
    depth: u32,
    /// End the search after this number of seconds
    #[arg(long, value_name = "SECONDS", default_value_t = 60, value_parser = number(1_u64..=1_000_000), requires = "equal_to", conflicts_with = "output")]
    seconds: u64,
}

fn parameter(text: &str) -> Result<(String, i64), &'static str> {
    let (name, value) = text.split_once('=').ok_or("write it as NAME=VALUE, such as WIDTH=16")?;
    let is_name = name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
        && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
    let value = value.parse().map_err(|_| "the value has to be a whole number, such as WIDTH=16");
    if is_name { Ok((name.to_owned(), value?)) } else { Err("the name has to be a parameter's, such as WIDTH=16") }
}

#[derive(Serialize)]
struct Report<'a> {
    format: u32,
    block: &'a str,
    parameters: BTreeMap<&'a str, u64>,
    /// `equal`, `differs` or `open`.
    result: &'static str,
    /// The clocks in which they are known to be equal, where it is open.
    clocks: Option<u32>,
    run: Option<RunReport<'a>>,
}

/// The run at whose end outputs differ.
#[derive(Serialize)]
struct RunReport<'a> {
    /// The clock, from 0.
    clock: u32,
    module: &'a str,
    /// The outputs that differ.
    differ: &'a [String],
    /// In each clock, whether the reset is active.
    reset: Vec<bool>,
    /// In each clock, the value in hexadecimal, by port.
    inputs: BTreeMap<&'a str, Vec<String>>,
    outputs: BTreeMap<&'a str, Vec<String>>,
    /// Those of the module.
    theirs: BTreeMap<&'a str, Vec<String>>,
}

impl EqualOptions {
    /// Whether there is something to compare with.
    pub fn is_asked(&self) -> bool {
        !self.equal_to.is_empty()
    }

    /// Compares, and prints what was found.
    ///
    /// # Errors
    /// A program is missing, or the module is not one that can be compared.
    pub fn compare(&self, entry: &Entry, values: &Values, design: &Design, json: bool) -> Result<Exit, Failure> {
        let mut asked = Equivalence::to(self.equal_to.iter()).depth(self.depth).seconds(self.seconds);
        if let Some(module) = &self.module {
            asked = asked.module(module);
        }
        for (name, value) in &self.parameters {
            asked = asked.parameter(name, *value);
        }
        // The flag is raised instead of the program being ended, so that Yosys and ABC are ended, too.
        interrupt::flag();
        progress::phase("proving");
        let verdict = asked.prove_watched(design, &interrupt::asked)?;
        if json {
            terminal::print_json(&report(entry, values, design, &verdict))?;
        } else {
            terminal::print(&self.text(design, &verdict)?)?;
        }
        Ok(match verdict {
            Verdict::Equal => Exit::Done,
            Verdict::Differs(_) => Exit::CheckFailed,
            Verdict::Open { .. } => Exit::Undecided,
        })
    }

    fn text(&self, design: &Design, verdict: &Verdict) -> Result<String, Failure> {
        let files: Vec<String> = self.equal_to.iter().map(|file| file.display().to_string()).collect();
        let (own, files) = (&design.top().name, files.join(", "));
        Ok(match verdict {
            Verdict::Equal => format!("{files} is equal to {own}, for all inputs\n"),
            Verdict::Open { clocks: 0, late } => {
                let at = match late {
                    Some(Stage::Conversion) => "while Yosys made a circuit of both modules",
                    _ => "before a clock was searched",
                };
                format!(
                    "not settled: the time was over {at}, so nothing is known of {files} and {own}: give more --seconds, or both smaller parameters\n"
                )
            }
            Verdict::Open { clocks, .. } => format!(
                "not settled: {files} is equal to {own} in {clocks} clock{}, and nothing is known of later ones: give more --seconds, or a larger --depth\n",
                if *clocks == 1 { "" } else { "s" }
            ),
            Verdict::Differs(run) => {
                let (clock, module, outputs) = (run.clock, &run.module, run.outputs.join("`, `"));
                format!(
                    "`{outputs}` of {module} in {files} differs from {own} in clock {clock}{}:\n\n{}",
                    resets(run),
                    wave(design, run)?
                )
            }
        })
    }
}

/// The clocks in which the reset is active, which the wave does not show.
fn resets(run: &Difference) -> String {
    let steps = run.recording.steps.iter().enumerate();
    let clocks = steps.filter(|(_, step)| !step.resets.is_empty()).map(|(clock, _)| clock.to_string());
    match &clocks.collect::<Vec<String>>()[..] {
        [] => String::new(),
        [one] => format!(", after a reset in clock {one}"),
        several => format!(", after resets in clocks {}", several.join(", ")),
    }
}

/// The ports of the run, with the module's outputs behind those from which they differ.
fn wave(design: &Design, run: &Difference) -> Result<String, Failure> {
    let mut sim = Simulation::from_design(design)?;
    let lanes: BTreeMap<String, u32> =
        sim.program().outputs.iter().map(|port| (port.name.clone(), port.lanes)).collect();
    let mut wave = sim.record(ports(&sim));
    // An assertion may fail in it, which does not matter here.
    match sim.replay(&run.recording) {
        Ok(()) | Err(tilewright_sim::Error::Violated(_)) => {}
        Err(error) => return Err(error.into()),
    }
    for Value { name, clocks } in &run.theirs {
        let ours = design.top().outputs.iter().position(|port| port.name == *name);
        let is_same = |port| clocks.iter().zip(&run.recording.steps).all(|(value, step)| step.outputs[port] == *value);
        if ours.is_none_or(is_same) {
            continue;
        }
        let count = lanes.get(name).copied().unwrap_or(1);
        for lane in 0..count {
            let row = if count > 1 { format!("{name}[{lane}]") } else { name.clone() };
            let part = |value: &Bits| {
                let width = value.width() / count;
                value.slice(lane * width..(lane + 1) * width)
            };
            wave = wave.beside(&row, format!("{row} of {}", run.module), clocks.iter().map(part));
        }
    }
    Ok(wave.to_string())
}

fn report<'a>(entry: &'a Entry, values: &'a Values, design: &'a Design, verdict: &'a Verdict) -> Report<'a> {
    let (result, clocks, run) = match verdict {
        Verdict::Equal => ("equal", None, None),
        Verdict::Differs(run) => ("differs", None, Some(run_report(design, run))),
        Verdict::Open { clocks, .. } => ("open", Some(*clocks), None),
    };
    Report { format: 1, block: entry.name, parameters: values.iter().collect(), result, clocks, run }
}

fn run_report<'a>(design: &'a Design, run: &'a Difference) -> RunReport<'a> {
    let (top, steps) = (design.top(), &run.recording.steps);
    let hex = |value: &Bits| format!("{value:x}");
    let inputs = top.inputs.iter().enumerate();
    let inputs =
        inputs.map(|(at, port)| (port.name.as_str(), steps.iter().map(|step| hex(&step.inputs[at])).collect()));
    let outputs = top.outputs.iter().enumerate();
    let outputs =
        outputs.map(|(at, port)| (port.name.as_str(), steps.iter().map(|step| hex(&step.outputs[at])).collect()));
    RunReport {
        clock: run.clock,
        module: &run.module,
        differ: &run.outputs,
        reset: steps.iter().map(|step| !step.resets.is_empty()).collect(),
        inputs: inputs.collect(),
        outputs: outputs.collect(),
        theirs: run.theirs.iter().map(|it| (it.name.as_str(), it.clocks.iter().map(hex).collect())).collect(),
    }
}
