//! `tilewright verilog`: a block as Verilog, and a testbench that replays its scenario.

use crate::block::{BlockArguments, design, design_with, simulation};
use crate::constraints::ConstraintOptions;
use crate::equal::EqualOptions;
use crate::names;
use crate::player::{check_length, play};
use crate::shell::output::{Folder, quoted};
use crate::shell::{Exit, Failure, progress, terminal};
use clap::{Args, ValueEnum};
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use tilewright_gen::tools::{WITH_COVERS, WITH_MODELS, sources};
use tilewright_gen::{VerilogFile, testbench, verilog};
use tilewright_hdl::catalog::{Entry, Values};
use tilewright_hdl::{Design, Recording, Reset, Scenario};
use tilewright_sim::{EngineKind, Simulation};

/// Writes a block as Verilog, one file for each module
#[derive(Args)]
#[command(after_help = "\
Examples:
  tilewright verilog merging-unit -o out/
  tilewright verilog merging-unit -o out/ --testbench
  tilewright verilog image-merger --set units=8 -o out/ --testbench --json
  tilewright verilog merging-unit -o out/ --constraints sdc
  tilewright verilog counter --reset async-low -o out/
  tilewright verilog counter --equal-to hand.v
  tilewright verilog counter --set limit=6 --equal-to hand.v --module hand_counter -P LIMIT=6

The testbench replays the block's scenario and compares every output at every clock edge. It prints `PASS: n cycles` or the first mismatch.
After a mismatch the printed commands end with a non-zero status. It runs in Icarus Verilog and in Verilator.
A simulation of foreign modules or pads needs the macro TILEWRIGHT_MODELS, which puts their models in their places; a synthesizer must not have it.

The constraints have the block's name: `merging_unit.sdc`. A file of pins has a row for each bit of each port: the port, the pin, and settings.
`#` begins a comment. Settings are an io type, pull-up or pull-down, and NAME=VALUE in the words of the dialect.

--equal-to proves, by Yosys and ABC, that a module written by hand has the same outputs as the block in each clock, whatever the inputs are. Ports are
matched by name. A run begins with a clock in which the reset is active and all inputs are zero. The reset may come again, and outputs are not compared
while it is active. What starts without a value is zero on both sides. Exit code 1 means that a run shows a difference; 5 that there is neither a proof nor such a run.")]
pub struct Verilog {
    #[command(flatten)]
    block: BlockArguments,
    /// Folder for the files, created if missing; either all files are written, or none
    #[arg(short, long, value_name = "FOLDER", required_unless_present = "equal_to")]
    output: Option<PathBuf>,
    /// How the clock resets registers. A kind other than `sync` is part of the modules' names
    #[arg(long, value_name = "KIND", value_parser = names::of::<Kind>("kind of reset"))]
    reset: Option<Kind>,
    /// Write a testbench as well, recorded from a run of the block's scenario
    #[arg(long)]
    testbench: bool,
    #[command(flatten)]
    constraints: ConstraintOptions,
    #[command(flatten)]
    equal: EqualOptions,
    /// Print the report as JSON
    #[arg(long)]
    json: bool,
}

/// A kind of reset.
#[derive(Clone, Copy, ValueEnum)]
enum Kind {
    /// Synchronous, active high: `rst`
    Sync,
    /// Synchronous, active low: `rst_n`
    SyncLow,
    /// Asynchronous, active high: `rst`
    Async,
    /// Asynchronous, active low: `rst_n`
    AsyncLow,
    /// No reset: values at power-on alone
    PowerOn,
}

impl From<Kind> for Reset {
    fn from(kind: Kind) -> Reset {
        match kind {
            Kind::Sync => Reset::Synchronous,
            Kind::SyncLow => Reset::SynchronousLow,
            Kind::Async => Reset::Asynchronous,
            Kind::AsyncLow => Reset::AsynchronousLow,
            Kind::PowerOn => Reset::PowerOn,
        }
    }
}

#[derive(Serialize)]
struct Report<'a> {
    format: u32,
    block: &'a str,
    parameters: BTreeMap<&'a str, u64>,
    /// The top module.
    top: &'a str,
    /// Cycles that the testbench compares, if there is one.
    cycles: Option<usize>,
    files: Vec<String>,
    /// The commands that run the testbench, if there is one.
    commands: Vec<String>,
}

impl Verilog {
    /// Writes the files and reports them, or compares the block with a module.
    pub fn run(self) -> Result<Exit, Failure> {
        match (&self.output, self.equal.is_asked()) {
            (Some(output), false) => self.write(output),
            _ => self.compare(),
        }
    }

    fn compare(&self) -> Result<Exit, Failure> {
        let (entry, values) = self.block.find()?;
        self.equal.compare(entry, &values, &self.design(entry, &values)?, self.json)
    }

    fn design(&self, entry: &Entry, values: &Values) -> Result<Design, Failure> {
        match self.reset {
            Some(reset) => design_with(entry, values, reset.into()),
            None => design(entry, values),
        }
    }

    fn write(&self, output: &Path) -> Result<Exit, Failure> {
        Folder::check(output)?;
        let (entry, values) = self.block.find()?;
        let pins = self.constraints.pins()?;
        let folder = Folder::make(output)?;
        let design = self.design(entry, &values)?;
        progress::phase("printing");
        let mut files = verilog(&design);
        files.extend(self.constraints.print(&design, &pins)?);
        let mut cycles = None;
        if self.testbench {
            let mut sim = simulation(&design, EngineKind::default())?;
            let recording = record(&mut sim, &entry.scenario(&values)?)?;
            cycles = Some(recording.steps.len());
            files.push(testbench(&design, &recording));
        }
        let commands = if self.testbench { simulators(output, &files, needs_models(&design)) } else { Vec::new() };
        let written = folder.fill(files.iter().map(|file| (file.name.as_str(), file.text.as_bytes())))?;
        if self.json {
            terminal::print_json(&Report {
                format: 1,
                block: entry.name,
                parameters: values.iter().collect(),
                top: &design.top().name,
                cycles,
                files: written,
                commands,
            })?;
        } else {
            commands.iter().try_for_each(|line| terminal::report(&format!("{line}\n")))?;
        }
        Ok(Exit::Done)
    }
}

/// The run of the scenario, as a testbench replays it.
fn record(sim: &mut Simulation, scenario: &Scenario) -> Result<Recording, Failure> {
    check_length(sim, scenario, "a testbench")?;
    let recording = sim.recording();
    play(sim, scenario, u64::MAX)?;
    Ok(recording.take())
}

/// Whether a simulation of the Verilog needs models.
fn needs_models(design: &Design) -> bool {
    design.modules().iter().any(|module| module.foreign.is_some() || module.is_pad)
}

/// The commands that run the testbench, the last of the files, in two simulators. Each has a shell of its own, so that one can follow
/// the other. `-n` stops Icarus from asking what to do at `$stop`, and the macro prints covers.
fn simulators(folder: &Path, files: &[VerilogFile], with_models: bool) -> Vec<String> {
    let folder = quoted(folder);
    let top = files.last().map_or("", |bench| bench.name.trim_end_matches(".v"));
    let sources = sources(files).join(" ");
    let macros = if with_models { format!("{WITH_COVERS} {WITH_MODELS}") } else { WITH_COVERS.to_owned() };
    vec![
        format!("(cd {folder} && iverilog -g2005 {macros} -s {top} -o bench.vvp {sources} && vvp -n bench.vvp)"),
        format!("(cd {folder} && verilator --binary {macros} --top-module {top} -o bench {sources} && obj_dir/bench)"),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use tilewright_hdl::{DefaultClock, Foreign, Module, bit, block, elaborate_at};

    block! {
        /// A buffer of a chip, or one that is described.
        struct Buffer;
        foreign = Foreign::module("BUF");
        in BufferIn { word: bit() }
        out BufferOut { same: bit() }
    }

    impl Buffer {
        fn build(&self, _: Module, i: BufferIn) -> BufferOut {
            BufferOut { same: i.word }
        }
    }

    #[test]
    fn models_are_named_where_the_verilog_has_foreign_modules() {
        let foreign = elaborate_at(&Buffer, DefaultClock::new(tilewright_hdl::DEFAULT_PERIOD)).unwrap();
        let counter = crate::block::entries().find(|entry| entry.name == "counter").unwrap();
        let plain = counter.design(&counter.values([]).unwrap()).unwrap();
        for (design, has) in [(&foreign, true), (&plain, false)] {
            let commands = simulators(Path::new("out"), &verilog(design), needs_models(design));
            assert!(commands.iter().all(|line| line.contains(" -DTILEWRIGHT_MODELS ") == has), "{commands:?}");
        }
    }
}
