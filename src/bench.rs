//! `tilewright bench`: the speed of the simulator, alone or against Verilator.

use crate::engine::tell_refused;
use crate::names;
use crate::number::number;
use crate::shell::{Exit, Failure, Progress, interrupt, terminal};
use clap::{Args, ValueEnum};
use std::time::Duration;
use tilewright_benches::{
    Effort, Error, FORMAT, Family, Measurement, Report, Rivals, Subject, USUAL, Versions, measure,
};
use tilewright_gen::tools::Compiler;
use tilewright_sim::EngineKind;

/// Measures the speed of the simulator on designs made for that
#[derive(Args)]
#[command(after_help = after_help())]
pub struct Bench {
    /// Designs, such as pim16
    #[arg(value_name = "DESIGN", value_parser = design, default_values_t = USUAL)]
    designs: Vec<Subject>,
    /// Also run this simulator's models of our Verilog and of hand-written Verilog, at its strongest settings. If the system's
    /// Verilator and the Python package's are both installed, run the models of both
    #[arg(long, value_name = "SIMULATOR", value_parser = names::of::<Against>("simulator"))]
    against: Option<Against>,
    /// Run only the models of this Verilog: `ours`, or a file of sim/benches/verilog, such as pxpl_planes; may be repeated
    #[arg(long = "verilog", value_name = "NAME", requires = "against")]
    verilog: Vec<String>,
    /// Runs of each simulator; the simulators alternate
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = number(1_u32..=1000))]
    rounds: u32,
    /// Approximate time of a run of the slowest simulator, in seconds
    #[arg(long, value_name = "S", default_value = "1", value_parser = seconds)]
    seconds: Duration,
    /// Print the report as JSON
    #[arg(long)]
    json: bool,
}

/// The examples, the designs, and what is measured.
fn after_help() -> String {
    let designs: Vec<String> =
        Family::ALL.map(|family| format!("  {:10} {}", format!("{}N", family.name()), family.about())).into();
    format!(
        "\
Examples:
  tilewright bench --seconds 0.1
  tilewright bench 'qt1*16' --seconds 0.1
  tilewright bench pim64 simd64 --rounds 3 --seconds 0.1 --json
  tilewright bench core1 --against verilator --seconds 0.1
  tilewright bench qt1 --against verilator --verilog qt --seconds 0.1 --json

The designs, with a size for N:
{}
vc1xN@WxH has a screen of WxH pixels instead of 640x480.

qt1*16 runs qt1 with 16 stimuli at once, as vector lanes, and with one stimulus alone. The time is that of a cycle of one stimulus.
The VC-1 and the renderers have no input in which stimuli could differ, so they run one at a time.

A cycle is a time at which one or more clocks rise. Building simd64 with Verilator takes minutes. Exit code 1 means that two
simulators end with different checksums. Exit code 4 means that Verilator, clang or make is not installed, or fails.",
        designs.join("\n")
    )
}

/// A simulator to compare with.
#[derive(Clone, Copy, ValueEnum)]
enum Against {
    Verilator,
}

impl Bench {
    /// Measures and reports.
    pub fn run(self) -> Result<Exit, Failure> {
        let verilog = self.verilog()?;
        let compilers = match self.against {
            Some(Against::Verilator) => Compiler::find_all().map_err(Error::from)?,
            None => Vec::new(),
        };
        if let Some(reason) = EngineKind::Compiled.refused() {
            tell_refused(&reason);
        }
        let effort = Effort { rounds: self.rounds, time: self.seconds };
        let versions = compilers.first().map(|newest| Versions {
            verilators: compilers.iter().map(Compiler::verilator_version).collect(),
            clang: newest.clang_version(),
        });
        let designs = measured(&self.designs, Rivals { compilers: &compilers, verilog: &verilog }, effort)?;
        let report = Report { format: FORMAT, verilator: versions, rounds: self.rounds, designs };
        match self.json {
            true => terminal::print_json(&report)?,
            false => terminal::print(&report.to_string())?,
        }
        Ok(Exit::Done)
    }

    /// The Verilog that the user names, which every design has to have.
    fn verilog(&self) -> Result<Vec<String>, Failure> {
        let mut names = Vec::new();
        for (design, name) in self.designs.iter().flat_map(|design| self.verilog.iter().map(move |name| (design, name)))
        {
            let known = design.verilog();
            let Some(found) = known.iter().find(|known| names::are_alike(name, known)) else {
                let sentence = names::unknown(&format!("there is no Verilog `{name}` for {design}"), name, &known);
                return Err(Failure::new(Exit::BadInput, sentence));
            };
            if !names.iter().any(|name| name == found) {
                names.push((*found).to_owned());
            }
        }
        Ok(names)
    }
}

/// A design by its name.
fn design(text: &str) -> Result<Subject, String> {
    text.parse().map_err(|sentence: String| {
        let sized = text.split(['@', '*']).next().unwrap_or(text);
        let name = sized.trim_end_matches(|c: char| c.is_ascii_digit());
        let known = Family::ALL.map(Family::name);
        match names::near(name, &known) {
            Some(near) if near != name => format!("did you mean `{near}{}`? Otherwise {sentence}", &text[name.len()..]),
            _ => sentence,
        }
    })
}

fn measured(designs: &[Subject], rivals: Rivals, effort: Effort) -> Result<Vec<Measurement>, Failure> {
    let progress = Progress::new();
    let mut done = Vec::new();
    for design in designs {
        let before = done.len() as f64;
        let measurement = measure(*design, rivals, effort, &mut |what, fraction| {
            progress.show(what, (before + fraction) / designs.len() as f64);
            interrupt::go_on()
        });
        // Ctrl-C reaches Verilator and clang too, which then fail.
        let design = design.to_string();
        done.push(match interrupt::asked() {
            true => measurement.map_err(|_| Error::Interrupted { design })?,
            false => measurement?,
        });
    }
    Ok(done)
}

fn seconds(text: &str) -> Result<Duration, &'static str> {
    let sentence = "the time has to be from 0.001 to 1000 seconds, such as 0.5";
    let seconds: f64 = text.parse().map_err(|_| sentence)?;
    if (0.001..=1000.0).contains(&seconds) { Ok(Duration::from_secs_f64(seconds)) } else { Err(sentence) }
}
