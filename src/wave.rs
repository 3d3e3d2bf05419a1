//! `tilewright wave`: a block's scenario as a waveform file, ready to be looked at, or as text.

use crate::block::{BlockArguments, simulation};
use crate::engine::EngineArguments;
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
use tilewright_sim::{Probe, Simulation, Vcd};

/// Runs a block's scenario and shows it as a waveform
#[derive(Args)]
#[command(after_help = "\
Examples:
  tilewright wave merging-unit -o mu.vcd
  tilewright wave merging-unit --ascii
  tilewright wave merging-unit --ascii --engine both
  tilewright wave image-merger --set units=8 -o merger.vcd --scope 'u_merging_unit[*].**' --to 2us

Beside the waveform file stands a .gtkw file with which GTKWave opens it with the signals in place, unless -o names a pipe or a device.
The values in --ascii waves are hexadecimal. Exit code 1 means that an assertion of the block does not hold, or that with --engine both
the engines differ.")]
pub struct Wave {
    #[command(flatten)]
    block: BlockArguments,
    /// The waveform, a VCD file
    #[arg(short, long, value_name = "FILE", value_parser = waveform)]
    output: Option<PathBuf>,
    /// Print the ports' waves as text, values in hexadecimal
    #[arg(long, conflicts_with = "json")]
    ascii: bool,
    #[command(flatten)]
    engine: EngineArguments,
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
    files: &'a [PathBuf],
    /// The lines that open the waveform.
    commands: Vec<String>,
}

impl Wave {
    /// Runs the scenario, writes the files and reports.
    pub fn run(self) -> Result<Exit, Failure> {
        if self.output.is_none() && !self.ascii {
            let sentence =
                "there is nowhere to show the wave: name a waveform file with -o FILE, or pass --ascii for text";
            return Err(Failure::new(Exit::BadInput, sentence));
        }
        let save = self.output.as_ref().and_then(|path| output::beside(path, "gtkw"));
        output::check_distinct(&Vec::from_iter(self.output.iter().chain(&save).map(PathBuf::as_path)), &[])?;
        let (entry, values) = self.block.find()?;
        let scenario = entry.scenario(&values)?;
        let mut sim = simulation(&entry.design(&values)?, self.engine.kind())?;
        let text = if self.ascii { Some(record_ports(&mut sim, &scenario)?) } else { None };
        let vcd = self.filters.vcd(self.output.as_deref(), "-o")?;
        let header = vcd.map(|vcd| trace(&mut sim, vcd)).transpose()?;
        let played = play(&mut sim, &scenario);
        // An interrupted or failed run leaves its waves too.
        let ended = played.and(sim.finish().map_err(Failure::from));
        let mut files = Vec::new();
        if let (Some(path), Some(header), true) = (&self.output, &header, Failure::leaves_a_waveform(&ended)) {
            files = self.save(path, save, header, sim.time())?;
        }
        ended?;
        if let Some(text) = text {
            output::print(&text.to_string())?;
        }
        if self.json {
            output::print_json(&report(entry, &values, &scenario, &sim, &files))?;
        } else {
            viewers(&files).iter().try_for_each(|line| output::print(&format!("{line}\n")))?;
        }
        Ok(Exit::Done)
    }

    /// Writes the save file, if there is to be one, beside the waveform, which has that header and ends at `end` picoseconds; returns
    /// the files that were written.
    fn save(&self, path: &Path, save: Option<PathBuf>, header: &[u8], end: u64) -> Result<Vec<PathBuf>, Failure> {
        output::talk(&format!("wrote {}", path.display()));
        self.filters.warn_if_empty(end);
        let Some(save) = save else { return Ok(vec![path.to_owned()]) };
        let times = self.filters.times();
        let text = save_file::of(path, header, times.start..times.end.min(end), self.filters.is_scoped());
        output::write_file(&save, text.as_bytes())?;
        Ok(vec![path.to_owned(), save])
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

/// Starts the waveform; its header.
fn trace(sim: &mut Simulation, vcd: Vcd) -> Result<Vec<u8>, Failure> {
    let header = sim.trace_header(&vcd)?;
    sim.trace(vcd)?;
    Ok(header)
}

/// The lines that open the waveform; none for one that went to a pipe or a device.
fn viewers(files: &[PathBuf]) -> Vec<String> {
    let [path, save] = files else { return Vec::new() };
    let (path, save) = (quoted(path), quoted(save));
    vec![format!("gtkwave {path} {save}"), format!("surfer {path}")]
}

fn report<'a>(
    entry: &'a Entry,
    values: &Values,
    scenario: &'a Scenario,
    sim: &Simulation,
    files: &'a [PathBuf],
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
        commands: viewers(files),
    }
}
