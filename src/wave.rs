//! `tilewright wave`: a block's scenario as a waveform file, as text, or as a picture.

use crate::against::{AgainstOptions, run_of_files};
use crate::block::{BlockArguments, design, ports, simulation};
use crate::engine::EngineArguments;
use crate::first_difference;
use crate::formats;
use crate::names;
use crate::player::{check_length, play};
use crate::shell::output::{Output, Waveform};
use crate::shell::place::{check_distinct, shown};
use crate::shell::{Exit, Failure, terminal};
use crate::trace::TraceOptions;
use crate::viewer::{self, Viewer, waveform};
use clap::builder::{PathBufValueParser, TypedValueParser};
use clap::{Args, ValueEnum};
use serde::Serialize;
use std::collections::BTreeMap;
use std::ops::Range;
use std::path::{Path, PathBuf};
use tilewright_hdl::Scenario;
use tilewright_hdl::catalog::{Entry, Values};
use tilewright_sim::{Simulation, WaveRadix};

/// Runs a block's scenario and shows it as a waveform, or compares two waveforms
#[derive(Args)]
#[command(mut_arg("block", |block| block.required(false).required_unless_present("diff")))]
#[command(after_help = "\
Examples:
  tilewright wave merging-unit
  tilewright wave merging-unit --radix decimal
  tilewright wave merging-unit --engine both
  tilewright wave merging-unit -o mu.vcd
  tilewright wave merging-unit -o mu.fst
  tilewright wave merging-unit -o mu.vcd --ascii
  tilewright wave image-merger --set units=8 -o merger.vcd --scope 'u_merging_unit[*].**' --to 2us
  tilewright wave lifo -o lifo.vcd --memory 'words[0..4]'
  tilewright wave merging-unit -o mu.svg
  tilewright wave merging-unit --against icarus
  tilewright wave merging-unit --against reference

Beside the waveform file a .gtkw file and a .sucl file are written, unless -o names a pipe or a device. With them GTKWave and Surfer open the waveform with the signals selected.
A file of these names that Tilewright did not write is kept. If -o ends in .fst, the file has the same waves in GTKWave's packed format.
If -o ends in .svg, it is a picture of the ports' waves, light or dark like the reader's screen.

--to ends the run at that time, except that text always shows the whole scenario. Without --radix, values in text and in pictures are hexadecimal,
and signed values are decimal. Codes are always shown by name.

--diff, as in `wave --diff before.vcd after.vcd`, matches signals by their names below a common top, so that a file of a testbench around a block can be compared with one of the block alone.
It compares the time that both files have, and takes an unknown bit (x) for any other. With a block, as in `wave fifo --diff before.vcd after.vcd`, it takes the causes of the first
difference from the block, as --against does. For that, one of the files has to be a waveform of the block's run.

--against compares the run with another one of the same scenario, just before each edge of a clock. It compares all signals and words of memories that both have. The other run is that of the printed Verilog in a simulator, of
another engine, or of a waveform file, such as one that was written before an edit. Below the first difference stand the waves around it and the causes of the value at which
it begins. With --verilog FILE, the simulator runs the modules of that file in place of the printed ones, such as a copy that was edited by hand.

Exit code 1 means that an assertion of the block fails, that with --engine both the engines differ, or that with --diff or --against the waveforms do. Exit code 4 means
that the simulator is not installed or fails.")]
pub struct Wave {
    #[command(flatten)]
    block: Option<BlockArguments>,
    /// The waveform: an FST file if the name ends in .fst, a picture if it ends in .svg, and else a VCD file; `-` is standard output [default: show the wave as text]
    #[arg(short, long, value_name = "FILE", value_parser = PathBufValueParser::new().try_map(waveform))]
    output: Option<PathBuf>,
    /// Print the ports' waves as text, also with -o
    #[arg(long, conflicts_with = "json")]
    ascii: bool,
    /// Radix of the numbers in text and in pictures [default: hex, and decimal for signed numbers]
    #[arg(long, value_name = "RADIX", value_parser = names::of::<Radix>("radix"))]
    radix: Option<Radix>,
    #[command(flatten)]
    engine: EngineArguments,
    /// Print a report on the waveform as JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    filters: TraceOptions,
    /// Compare two waveforms in place of a run: VCD or FST files of any program. Show where they differ first, and with a block also why
    #[arg(long, value_names = ["A", "B"], num_args = 2, conflicts_with_all = ["against", "output", "ascii", "radix", "engine", "scope", "memory", "from", "to", "verilog"])]
    diff: Vec<PathBuf>,
    #[command(flatten)]
    against: AgainstOptions,
}

/// The most clocks that a picture shows.
const MOST_DRAWN: u64 = 2000;

/// A radix by its name on the command line.
#[derive(Clone, Copy, ValueEnum)]
enum Radix {
    /// Decimal
    Decimal,
    /// Hexadecimal
    Hex,
    /// Binary
    Binary,
}

impl From<Radix> for WaveRadix {
    fn from(radix: Radix) -> WaveRadix {
        match radix {
            Radix::Decimal => WaveRadix::Decimal,
            Radix::Hex => WaveRadix::Hexadecimal,
            Radix::Binary => WaveRadix::Binary,
        }
    }
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
    files: Vec<String>,
    /// The commands that open the waveform.
    commands: Vec<String>,
}

impl Wave {
    /// Runs the scenario, writes the files and reports.
    pub fn run(self) -> Result<Exit, Failure> {
        // Without a block there is a `--diff`.
        let Some(block) = &self.block else { return first_difference::run(&self.diff, self.json) };
        if !self.diff.is_empty() {
            return run_of_files(&self.diff, block, self.json);
        }
        if self.against.is_asked() {
            return self.against.run(block, self.engine, self.json);
        }
        self.check()?;
        let (picture, vcd) =
            if self.is_picture() { (self.output.as_ref(), None) } else { (None, self.output.as_ref()) };
        let beside = vcd.map_or_else(Vec::new, |path| viewer::files(path));
        let outputs = self.output.iter().chain(beside.iter().map(|(_, path)| path));
        check_distinct(&Vec::from_iter(outputs.map(PathBuf::as_path)), &[])?;
        let (entry, values) = block.find()?;
        let design = design(entry, &values)?;
        let mut sim = simulation(&design, self.engine.kind())?;
        let scenario = entry.scenario(&values)?;
        let text = self.is_text().then(|| self.record_ports(&mut sim, &scenario, "a wave in text")).transpose()?;
        if picture.is_some() {
            self.check_drawn(&sim, &scenario)?;
        }
        let drawn = picture.map(|_| self.record_ports(&mut sim, &scenario, "a picture")).transpose()?;
        let drawn = drawn.map(|wave| wave.times(self.filters.times()));
        let picture = picture.map(|path| Output::at(path)).transpose()?;
        let waveform = vcd.map(|path| Waveform::at(path)).transpose()?;
        let ours = beside.iter().map(|(viewer, path)| viewer.prepare(path)).collect::<Result<Vec<_>, _>>()?;
        let header = waveform.as_ref().map(|waveform| self.filters.attach(waveform, &mut sim)).transpose()?;
        let end = if self.is_text() { u64::MAX } else { self.filters.times().end };
        let played = play(&mut sim, &scenario, end);
        // An interrupted or failed run keeps its waves, too.
        let mut ended = Failure::both(played, sim.finish().map_err(Failure::from));
        let mut files = Vec::new();
        if let (Some(waveform), Some(header), true) = (&waveform, &header, Failure::leaves_a_waveform(&ended)) {
            waveform.tell_written();
            self.filters.warn_if_empty(sim.time());
            files.extend(self.output.clone());
            for ((viewer, path), output) in beside.iter().zip(ours) {
                let Some(output) = output else { continue };
                ended = Failure::both(ended, output.write(self.shown_by(*viewer, header, sim.time()).as_bytes()));
                files.push(path.clone());
            }
            if let (Some(waveform), false) = (vcd, beside.is_empty()) {
                let written = formats::write(waveform, &design, &sim).map(|written| files.extend(written));
                ended = Failure::both(ended, written);
            }
        }
        if let (Some(picture), Some(drawn), true) = (picture, drawn, Failure::leaves_a_waveform(&ended)) {
            self.filters.warn_if_empty(sim.time());
            ended = Failure::both(ended, picture.write(drawn.svg().as_bytes()));
            files.extend(self.output.clone());
        }
        ended?;
        if let Some(text) = text {
            terminal::print(&text.to_string())?;
        }
        let opened = |waveform: &Path| beside.iter().map(|(viewer, file)| viewer.command(waveform, file)).collect();
        let viewers: Vec<String> = vcd.map_or_else(Vec::new, |path| opened(path));
        if self.json {
            terminal::print_json(&report(entry, &values, &scenario, &sim, &files, viewers))?;
        } else {
            viewers.iter().try_for_each(|line| terminal::report(&format!("{line}\n")))?;
        }
        Ok(Exit::Done)
    }

    /// Whether the wave is shown as text.
    fn is_text(&self) -> bool {
        self.ascii || self.output.is_none()
    }

    /// Whether a picture of the waves is asked for.
    fn is_picture(&self) -> bool {
        self.output.as_ref().and_then(|path| path.extension()).is_some_and(|it| it.eq_ignore_ascii_case("svg"))
    }

    /// Checks that the options fit the kind of output.
    fn check(&self) -> Result<(), Failure> {
        let sentence = if self.json && self.output.is_none() {
            "--json needs a waveform file: name it with -o FILE"
        } else if self.radix.is_some() && !self.is_text() && !self.is_picture() {
            "--radix is for text and pictures, and -o names a waveform file: leave out -o, or name a picture with -o, such as wave.svg"
        } else if (self.filters.is_scoped() || self.filters.has_words()) && self.is_picture() {
            "a picture always shows the ports of the block: leave out --scope and --memory, or name a waveform file with -o, such as wave.vcd"
        } else {
            return self.filters.check(self.output.as_deref(), "-o");
        };
        Err(Failure::new(Exit::BadInput, sentence))
    }

    /// Checks that a picture does not have too many clocks.
    fn check_drawn(&self, sim: &Simulation, scenario: &Scenario) -> Result<(), Failure> {
        let Range { start, end } = self.filters.times();
        let time = end.min(scenario.end_ps).saturating_sub(start);
        let clocks: u64 = sim.program().clocks.iter().map(|clock| time / clock.period).sum();
        if clocks <= MOST_DRAWN {
            return Ok(());
        }
        let sentence = format!(
            "the picture would have {clocks} clocks, and the limit is {MOST_DRAWN}: pass --from and --to, such as --to 2us"
        );
        Err(Failure::new(Exit::BadInput, sentence))
    }

    fn record_ports(
        &self,
        sim: &mut Simulation,
        scenario: &Scenario,
        what: &str,
    ) -> Result<tilewright_sim::Wave, Failure> {
        check_length(sim, scenario, what)?;
        let wave = sim.record(ports(sim));
        Ok(match self.radix {
            Some(radix) => wave.radix_of_all(radix.into()),
            None => wave,
        })
    }

    /// A viewer's file for the waveform, which has that header and ends at `end` picoseconds.
    fn shown_by(&self, viewer: Viewer, header: &[u8], end: u64) -> String {
        let (waveform, times) = (self.output.as_deref().unwrap_or(Path::new("")), self.filters.times());
        viewer.text(waveform, header, times.start..times.end.min(end), self.filters.is_scoped())
    }
}

fn report<'a>(
    entry: &'a Entry,
    values: &Values,
    scenario: &'a Scenario,
    sim: &Simulation,
    files: &[PathBuf],
    commands: Vec<String>,
) -> Report<'a> {
    let cycles = |name: &str| sim.cycles(name).expect("it is a clock of the block");
    Report {
        format: 1,
        block: entry.name,
        parameters: values.iter().collect(),
        scenario: scenario.about,
        picoseconds: sim.time(),
        clocks: sim.program().clocks.iter().map(|clock| (clock.name.clone(), cycles(&clock.name))).collect(),
        files: files.iter().map(|file| shown(file)).collect(),
        commands,
    }
}
