//! `tilewright wave --against`, and `wave BLOCK --diff`: a block's run is compared with another run of it, signal by signal and clock by
//! clock.

mod cone;
mod files;
mod other;
mod reads;
mod report;
mod run;
mod words;

use crate::block::{BlockArguments, design};
use crate::engine::EngineArguments;
use crate::first_difference::{Both, Waves, checked, matched, no_time};
use crate::shell::{Exit, Failure, interrupt, progress};
use clap::Args;
use clap::builder::{OsStringValueParser, TypedValueParser};
use cone::Cone;
pub use files::run as run_of_files;
use other::Other;
use report::{Compared, Memories};
use run::{Instant, Run};
use std::path::PathBuf;
use tilewright_hdl::catalog::{Entry, Values};
use tilewright_hdl::{Design, Scenario};
use tilewright_sim::EngineKind;

/// What a run is compared with.
#[derive(Args)]
pub struct AgainstOptions {
    /// Compare the run, clock by clock, with one of icarus, verilator, verilog (the first of both that is installed), interpreter and reference, or with a waveform file
    #[arg(long, value_name = "WHAT", value_parser = OsStringValueParser::new().try_map(Other::parse), requires = "block", conflicts_with_all = ["output", "ascii", "radix", "scope", "memory", "from", "to"])]
    against: Option<Other>,
    /// Have the simulator of --against run this Verilog file in place of the printed modules that it has; may be repeated
    #[arg(long, value_name = "FILE", requires = "against")]
    verilog: Vec<PathBuf>,
}

impl AgainstOptions {
    /// Whether a comparison is asked for.
    pub fn is_asked(&self) -> bool {
        self.against.is_some()
    }

    /// Compares the runs, and prints the first difference and its causes.
    ///
    /// # Errors
    /// The other run cannot be had, or has nothing in common with this one; an assertion fails.
    pub fn run(&self, block: &BlockArguments, engine: EngineArguments, json: bool) -> Result<Exit, Failure> {
        let Some(other) = &self.against else { return Ok(Exit::Done) };
        let edited = other.edited(&self.verilog)?;
        other.check()?;
        let ours = Ours::of(block, engine.kind())?;
        // Engines agree on all reads.
        let ours = if other.is_engine() { ours } else { ours.without_free_reads()? };
        let theirs = other.waves(&ours.design, &ours.scenario, &ours.run, &edited)?;
        ours.compare(&theirs, other.is_simulator() && edited.is_empty(), None, json)
    }
}

/// A block, and the run of its scenario.
struct Ours {
    entry: &'static Entry,
    values: Values,
    design: Design,
    scenario: Scenario,
    run: Run,
}

impl Ours {
    fn of(block: &BlockArguments, engine: EngineKind) -> Result<Ours, Failure> {
        let (entry, values) = block.find()?;
        // The flag is raised instead of the program being ended, so that temporary files are deleted.
        interrupt::flag();
        let (design, scenario) = (design(entry, &values)?, entry.scenario(&values)?);
        let run = Run::of(&design, &scenario, engine, "tilewright")?;
        Ok(Ours { entry, values, design, scenario, run })
    }

    /// The same, whose reads that may give any value are not compared.
    fn without_free_reads(mut self) -> Result<Ours, Failure> {
        self.run.reads = reads::of_any(&self.design)?;
        Ok(self)
    }

    /// Compares it with another run, and prints the first difference and its causes. `same` is a file that has the same run as ours.
    fn compare(self, theirs: &Waves, is_printed: bool, same: Option<&str>, json: bool) -> Result<Exit, Failure> {
        progress::phase("comparing");
        let files: [&Waves; 2] = [&self.run.waves, theirs];
        let matched = matched(files);
        let reads = self.run.reads_of(&matched);
        let mut matched = checked(self.run.comparable(matched, is_printed), files)?;
        let lacking = self.run.words.lacking(&mut matched.only);
        // Of two files, neither has to have words.
        let lacking = if same.is_some() { Vec::new() } else { lacking };
        let both = Both::new(files, &matched.pairs);
        let instants = self.run.instants_of(&both);
        if instants.is_empty() {
            return Err(no_time(files));
        }
        let place = first_difference(&both, &instants);
        let cone = place.map(|place| Cone::at(&self.design, &self.scenario, &both, &instants[place]));
        let (entry, values) = (self.entry, &self.values);
        let memories = Memories { words: &self.run.word_variables, left_out: &self.run.words.left_out, lacking, reads };
        let (both, matched, instants) = (&both, &matched, &instants[..]);
        let compared = Compared { entry, values, same, both, matched, memories, instants, place };
        compared.print(cone.transpose()?.as_ref(), json)?;
        match (self.run.failed, place) {
            (Some(failed), _) => Err(failed),
            (None, Some(_)) => Ok(Exit::CheckFailed),
            (None, None) => Ok(Exit::Done),
        }
    }
}

/// The place of the first instant that differs.
fn first_difference(both: &Both, instants: &[Instant]) -> Option<usize> {
    let times: Vec<u64> = instants.iter().map(|instant| instant.until).collect();
    both.first_difference_before(&times)
}
