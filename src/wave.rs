//! `tilewright wave`: a block's scenario as a waveform file, ready to be looked at, or as text.

use crate::block::BlockArguments;
use crate::player::{check_length, play};
use crate::save_file;
use crate::shell::output::{self, quoted};
use crate::shell::{Exit, Failure};
use crate::trace::TraceOptions;
use clap::Args;
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use tilewright_hdl::Scenario;
use tilewright_rtl::catalog::{Entry, Values};
use tilewright_sim::{Probe, Simulation};

/// Runs a block's scenario and shows it as a waveform
#[derive(Args)]
#[command(after_help = "\
Examples:
  tilewright wave merging-unit -o mu.vcd
  tilewright wave merging-unit --ascii
  tilewright wave image-merger --set units=8 -o merger.vcd --scope 'u_merging_unit[*].**' --to 2us

Beside the waveform file stands a .gtkw file with which GTKWave opens it with the signals in place.")]
pub struct Wave {
    #[command(flatten)]
    block: BlockArguments,
    /// The waveform, a VCD file
    #[arg(short, long, value_name = "FILE", required_unless_present = "ascii", value_parser = waveform)]
    output: Option<PathBuf>,
    /// Print the ports' waves as text
    #[arg(long, conflicts_with = "json")]
    ascii: bool,
    /// Print the report as JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    filters: TraceOptions,
}

#[derive(Serialize)]
struct Report<'a> {
    format: u32,
    block: &'a str,
    parameters: BTreeMap<&'a str, u64>,
    scenario: &'a str,
    /// Simulated time, the reset included.
    picoseconds: u64,
    /// How often each clock rose, by its name.
    clocks: BTreeMap<String, u64>,
    files: [&'a Path; 2],
}

impl Wave {
    /// Runs the scenario, writes the files and reports.
    pub fn run(self) -> Result<Exit, Failure> {
        let (entry, values) = self.block.find()?;
        let scenario = entry.scenario(&values)?;
        let mut sim = Simulation::from_design(&entry.design(&values)?)?;
        let text = if self.ascii { Some(record_ports(&mut sim, &scenario)?) } else { None };
        if let Some(vcd) = self.filters.vcd(self.output.as_deref(), "-o")? {
            sim.trace(vcd)?;
        }
        let played = play(&mut sim, &scenario);
        // An interrupted or failed run leaves its waves too.
        let ended = played.and(sim.finish().map_err(Failure::from));
        let written = self.output.as_ref().filter(|_| Failure::leaves_a_waveform(&ended));
        let files = written.map(|path| self.save(path, sim.time())).transpose()?;
        ended?;
        if let Some(text) = text {
            output::print(&text.to_string())?;
        }
        if let Some([path, save]) = &files {
            match self.json {
                true => output::print_json(&report(entry, &values, &scenario, &sim, [path, save]))?,
                false => output::print(&viewers(path, save))?,
            }
        }
        Ok(Exit::Done)
    }

    /// Writes the save file beside the waveform, which ends at `end` picoseconds; the names of both.
    fn save(&self, path: &Path, end: u64) -> Result<[PathBuf; 2], Failure> {
        output::talk(&format!("wrote {}", path.display()));
        let save = path.with_extension("gtkw");
        let times = self.filters.times();
        let text = save_file::of(path, times.start..times.end.min(end), self.filters.is_scoped())?;
        output::write_file(&save, text.as_bytes())?;
        Ok([path.to_owned(), save])
    }
}

/// A waveform's name, which is not that of the save file beside it.
fn waveform(text: &str) -> Result<PathBuf, &'static str> {
    let path = PathBuf::from(text);
    let is_save_file = path.extension().is_some_and(|it| it == "gtkw");
    if is_save_file { Err("the .gtkw file is written beside the waveform: name the waveform .vcd") } else { Ok(path) }
}

fn record_ports(sim: &mut Simulation, scenario: &Scenario) -> Result<tilewright_sim::Wave, Failure> {
    check_length(sim, scenario, "a wave in text")?;
    let program = sim.program();
    let ports = program.inputs.iter().chain(&program.outputs);
    let probes: Vec<Probe> = ports.map(|port| Probe::Path(port.name.clone())).collect();
    Ok(sim.record(probes))
}

/// The lines that open the waveform.
fn viewers(path: &Path, save: &Path) -> String {
    let (path, save) = (quoted(path), quoted(save));
    format!("gtkwave {path} {save}\nsurfer {path}\n")
}

fn report<'a>(
    entry: &'a Entry,
    values: &Values,
    scenario: &'a Scenario,
    sim: &Simulation,
    files: [&'a Path; 2],
) -> Report<'a> {
    let cycles = |name: &str| sim.cycles(name).expect("it is a clock of the block");
    Report {
        format: 1,
        block: entry.name,
        parameters: values.iter().collect(),
        scenario: scenario.about,
        picoseconds: sim.time(),
        clocks: sim.program().clocks.iter().map(|clock| (clock.name.clone(), cycles(&clock.name))).collect(),
        files,
    }
}
