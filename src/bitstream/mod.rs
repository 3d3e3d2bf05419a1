//! `tilewright bitstream`: the file with which a board is loaded.

mod family;
mod flow;
mod report;

use crate::names::Names;
use crate::number::number;
use crate::shell::output::Folder;
use crate::shell::{Exit, Failure, progress, terminal};
use crate::synth::flow::Workspace;
use clap::Args;
use clap::builder::PossibleValue;
use flow::{Made, Task};
use report::Report;
use std::path::PathBuf;
use tilewright_boards::{TOPS, Top};
use tilewright_hdl::Design;

/// Makes the bitstream of a machine on a board, with Yosys, nextpnr and the packer of the FPGA
#[derive(Args)]
#[command(after_help = "\
Examples:
  tilewright bitstream --list

The folder gets the bitstream, Verilog, constraints, the script for Yosys, and what the tools print. The same versions of the tools lead to the same bytes.
A program is called by its own name, or else as its Python package names it, such as yowasp-ecppack. `tilewright bitstream vc1 --board ulx3s -o out/` takes some minutes.

Without a bitstream it ends so: exit code 1 means that the machine does not fit, or that a clock is slower than the board's. Exit code 4 means that
a program is not installed, or fails. Its log is kept.")]
pub struct Bitstream {
    /// The machine
    #[arg(value_name = "MACHINE", value_parser = machines(), required_unless_present = "list")]
    machine: Option<&'static str>,
    /// The board
    #[arg(long, value_name = "BOARD", default_value = "ulx3s", value_parser = boards())]
    board: &'static str,
    /// Folder for the bitstream and what leads to it, created if missing
    #[arg(short, long, value_name = "FOLDER", required_unless_present = "list")]
    output: Option<PathBuf>,
    /// Seed of the placer [default: 1 to 5, one after the other, until all clocks are fast enough]
    #[arg(long, value_name = "N", value_parser = number(1_u32..=1_000_000))]
    seed: Option<u32>,
    /// Write the netlist too, as Verilog for a simulator with Yosys's models of the cells
    #[arg(long)]
    netlist: bool,
    /// List machines and their boards
    #[arg(long, conflicts_with_all = ["machine", "output", "netlist", "json"])]
    list: bool,
    /// Print the report as JSON
    #[arg(long)]
    json: bool,
}

/// The different values of something that tops have.
fn each(of: fn(&Top) -> &'static str) -> Vec<&'static str> {
    let mut all: Vec<&str> = TOPS.iter().map(of).collect();
    all.sort_unstable();
    all.dedup();
    all
}

fn machines() -> Names<&'static str> {
    let about = |name| TOPS.iter().find(|top| top.name == name).map_or("", |top| top.about);
    let all = each(|top| top.name).into_iter().map(|name| (PossibleValue::new(name).help(about(name)), name));
    Names::described("machine on a board", all)
}

fn boards() -> Names<&'static str> {
    Names::new("board", each(|top| top.board).into_iter().map(|name| (name, name)))
}

impl Bitstream {
    /// Makes it, and reports.
    pub fn run(self) -> Result<Exit, Failure> {
        let (Some(machine), Some(output)) = (self.machine, &self.output) else {
            terminal::print(&list())?;
            return Ok(Exit::Done);
        };
        let top = find(machine, self.board)?;
        Folder::check(output)?;
        let task = Task::find(top, self.seed, self.netlist)?;
        let folder = Folder::make(output)?;
        progress::phase("elaborating");
        let design: Design = (top.design)().map_err(|problems| broken(&problems.to_string()))?;
        let files = top.files(&design).map_err(|problems| broken(&problems.to_string()))?;
        let space = Workspace::new()?;
        let made = task.make(&design, &files, &space);
        // A run that was interrupted, or had no room, leaves nothing.
        let is_kept = made.as_ref().err().is_none_or(|failure| failure.exit == Exit::NoTool);
        let kept = if is_kept { task.files(&files, &space, made.as_ref().ok()) } else { Vec::new() };
        let written = match is_kept {
            true => folder.fill(kept.iter().map(|(name, bytes)| (name.as_str(), bytes.as_slice())))?,
            false => Vec::new(),
        };
        let made = made?;
        let report = Report::of(top, &task, &made, written);
        match self.json {
            true => terminal::print_json(&report)?,
            false => terminal::report(&report.to_string())?,
        }
        verdict(top, &made)
    }
}

/// The top of that machine for that board.
fn find(machine: &str, board: &str) -> Result<&'static Top, Failure> {
    Top::find(machine, board).ok_or_else(|| {
        let on: Vec<&str> = TOPS.iter().filter(|top| top.name == machine).map(|top| top.board).collect();
        let sentence = format!("{machine} is not there for {board}: choose --board {}", on.join(" or "));
        Failure::new(Exit::BadInput, sentence)
    })
}

/// A built-in top that cannot be elaborated is a mistake of ours.
fn broken(problems: &str) -> Failure {
    Failure::new(Exit::Crash, problems)
}

fn list() -> String {
    let line = |top: &Top| format!("{:14} {:10} {}\n", top.name, top.board, top.about);
    TOPS.iter().map(line).collect()
}

/// Whether the machine fits, and its clocks are as fast as the board's.
fn verdict(top: &Top, made: &Made) -> Result<Exit, Failure> {
    let failed = |sentence| Err(Failure::new(Exit::CheckFailed, sentence));
    if let Some(it) = made.lacking.first() {
        return failed(format!(
            "{} does not fit {}: it takes {} {}, and there are {}: there is no bitstream",
            top.name, top.board, it.used, it.name, it.available
        ));
    }
    match made.clocks.iter().find(|clock| clock.mhz < clock.wanted) {
        Some(clock) => failed(format!(
            "{} reaches {:.1} MHz of {} MHz: there is no bitstream; another --seed places differently",
            clock.name, clock.mhz, clock.wanted
        )),
        None => Ok(Exit::Done),
    }
}
