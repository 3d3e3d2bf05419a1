//! What a bitstream takes of its FPGA, as text and as JSON.

use super::flow::{Made, Speed, Task};
use crate::synth::report::Resource;
use serde::Serialize;
use std::fmt;
use tilewright_boards::Top;

/// A machine on a board.
#[derive(Serialize)]
pub struct Report<'a> {
    format: u32,
    machine: &'static str,
    board: &'static str,
    part: &'static str,
    /// Yosys and nextpnr, with their versions.
    tools: [&'a str; 2],
    seed: u32,
    resources: &'a [Resource],
    /// What there is too little of.
    lacking: &'a [Resource],
    clocks: &'a [Speed],
    /// The path of the bitstream, if there is one.
    bitstream: Option<String>,
    /// What loads it.
    loader: &'static str,
    /// The files that were written.
    files: Vec<String>,
}

impl<'a> Report<'a> {
    pub fn of(top: &'static Top, task: &'a Task, made: &'a Made, files: Vec<String>) -> Report<'a> {
        let programs = &task.programs;
        let bitstream = made.bitstream.as_ref().and_then(|_| files.last().cloned());
        Report {
            format: 1,
            machine: top.name,
            board: top.board,
            part: task.device.part(),
            tools: [&programs.yosys.version, &programs.nextpnr.version],
            seed: made.seed,
            resources: &made.resources,
            lacking: &made.lacking,
            clocks: &made.clocks,
            bitstream,
            loader: top.loader,
            files,
        }
    }
}

impl fmt::Display for Report<'_> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        writeln!(f, "{} on {} ({})\n", self.machine, self.board, self.part)?;
        writeln!(f, "{:14} {:>8} {:>10} {:>8}", "", "used", "available", "%")?;
        for it in self.resources {
            writeln!(f, "{:14} {:>8} {:>10} {:>8.1}", it.name, it.used, it.available, it.percent())?;
        }
        for Resource { name, used, available } in self.lacking {
            writeln!(f, "\ndoes not fit: {} {name} too many, {used} of {available}", used - available)?;
        }
        if !self.clocks.is_empty() {
            writeln!(f, "\n{:14} {:>8} {:>10}", "clock", "MHz", "needs")?;
        }
        for Speed { name, mhz, wanted } in self.clocks {
            writeln!(f, "{name:14} {mhz:>8.1} {wanted:>10.1}")?;
        }
        if let Some(bitstream) = &self.bitstream {
            writeln!(f, "\n{} {bitstream} loads it onto the board.", self.loader)?;
        }
        let [yosys, nextpnr] = self.tools;
        writeln!(f, "\n{yosys}, {nextpnr}, seed {}", self.seed)
    }
}
