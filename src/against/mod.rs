//! `tilewright wave --against`: a block's run is compared with another run of it, signal by signal and clock by clock.

mod cone;
mod other;
mod report;
mod run;

use crate::block::{BlockArguments, design};
use crate::engine::EngineArguments;
use crate::first_difference::{Both, Waves, checked, matched, no_time};
use crate::shell::{Exit, Failure, interrupt, progress};
use clap::Args;
use clap::builder::{OsStringValueParser, TypedValueParser};
use cone::Cone;
use other::Other;
use report::Compared;
use run::Run;
use std::path::PathBuf;

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
        let (entry, values) = block.find()?;
        other.check()?;
        // The flag is raised instead of the program being ended, so that temporary files are deleted.
        interrupt::flag();
        let (design, scenario) = (design(entry, &values)?, entry.scenario(&values)?);
        let ours = Run::of(&design, &scenario, engine.kind(), "tilewright")?;
        let theirs = other.waves(&design, &scenario, &ours, &edited)?;
        progress::phase("comparing");
        let files: [&Waves; 2] = [&ours.waves, &theirs];
        let is_printed = other.is_simulator() && edited.is_empty();
        let matched = checked(ours.comparable(matched(files), is_printed), files)?;
        let both = Both::new(files, &matched.pairs);
        let instants = ours.instants_of(&both);
        if instants.is_empty() {
            return Err(no_time(files));
        }
        let times: Vec<u64> = instants.iter().map(|instant| instant.until).collect();
        let place = both.first_difference_before(&times);
        let cone = place.map(|place| Cone::at(&design, &scenario, &both, &instants[place]));
        let compared = Compared { entry, values: &values, both: &both, matched: &matched, instants: &instants, place };
        compared.print(cone.transpose()?.as_ref(), json)?;
        match (ours.failed, place) {
            (Some(failed), _) => Err(failed),
            (None, Some(_)) => Ok(Exit::CheckFailed),
            (None, None) => Ok(Exit::Done),
        }
    }
}
