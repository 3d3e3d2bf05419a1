//! A run in our simulator, with all of its signals.

use super::words::Words;
use crate::block::simulation;
use crate::first_difference::{Both, Matched, Waves};
use crate::player::{check_length, play};
use crate::shell::{Exit, Failure};
use std::collections::HashSet;
use tempfile::TempDir;
use tilewright_hdl::{Design, Recording, Scenario};
use tilewright_sim::{EngineKind, Vcd};

/// The net of printed Verilog that takes what is not used.
const UNUSED: &str = "_unused_ok";

/// A run that was played to its end.
pub struct Run {
    pub waves: Waves,
    /// The words of memories in it.
    pub words: Words,
    /// Their variables in the waveform.
    pub word_variables: HashSet<u32>,
    /// The signals, by path, that are not compared, because they are reads that may give any value.
    pub reads: HashSet<String>,
    /// What a testbench needs to play it again.
    pub recording: Recording,
    /// The ports of the clocks, and the period of the first one in picoseconds.
    clocks: Vec<String>,
    period: Option<u64>,
    /// The failure of an assertion, which ended it.
    pub failed: Option<Failure>,
}

/// The time from an edge of a clock to the next one.
pub struct Instant {
    /// The time of the next one, in the unit of a comparison.
    pub until: u64,
    /// Its beginning, in picoseconds.
    pub picoseconds: u64,
    /// The cycle of the first clock, if there is one.
    pub cycle: Option<u64>,
}

impl Run {
    /// Plays a scenario. The waveform gets this name.
    ///
    /// # Errors
    /// It is too long, or cannot be played; not that an assertion fails.
    pub fn of(design: &Design, scenario: &Scenario, engine: EngineKind, name: &str) -> Result<Run, Failure> {
        let folder = TempDir::with_prefix("tilewright-").map_err(|error| Failure::no_temporary(&error))?;
        let path = folder.path().join("run.vcd");
        let mut sim = simulation(design, engine)?;
        check_length(&sim, scenario, "a comparison")?;
        let recorder = sim.recording();
        let words = Words::of(sim.program());
        sim.trace(words.trace(Vcd::to(&path)))?;
        let played = play(&mut sim, scenario, u64::MAX);
        sim.finish()?;
        let failed = match played {
            Err(failure) if failure.exit == Exit::CheckFailed => Some(failure),
            played => played.map(|()| None)?,
        };
        let waves = Waves::read(&path)?.named(name);
        let clocks = &sim.program().clocks;
        let (ports, period) = (clocks.iter().map(|clock| clock.port.clone()), clocks.first().map(|clock| clock.period));
        let (word_variables, recording) = (words.variables(&waves), recorder.take());
        let reads = HashSet::new();
        Ok(Run { waves, words, word_variables, reads, recording, clocks: ports.collect(), period, failed })
    }

    /// The names that both runs have of reads that may give any value.
    pub fn reads_of(&self, matched: &Matched) -> Vec<String> {
        let names = matched.pairs.iter().map(|pair| &pair.name);
        names.filter(|name| self.reads.contains(*name)).cloned().collect()
    }

    /// The same without reads that may give any value, and without what no run has to have.
    ///
    /// A testbench chooses the levels of clocks between their edges. Of codes the numbers are
    /// compared, and not the texts. A net of printed Verilog takes what is not used. If the other run is of Verilog as it is printed, all
    /// nets that only it has are of the printer's making.
    pub fn comparable(&self, mut matched: Matched, is_printed: bool) -> Matched {
        let is_clock = |path: &[String]| matches!(path, [_, port] if self.clocks.contains(port));
        let signals = self.waves.signals.iter().filter(|signal| is_clock(&signal.path));
        let clocks: Vec<u32> = signals.map(|signal| signal.variable).collect();
        matched.pairs.retain(|pair| !clocks.contains(&pair.variables[0]) && !self.reads.contains(&pair.name));
        let Matched { pairs, only } = &mut matched;
        let is_number = |name: &str| pairs.binary_search_by(|pair| pair.name.as_str().cmp(name)).is_ok();
        only[0].retain(|name| !name.strip_suffix("_state").is_some_and(is_number));
        only[1].retain(|name| !is_printed && name.rsplit('.').next() != Some(UNUSED));
        matched
    }

    /// The instants that are in both files.
    pub fn instants_of(&self, both: &Both) -> Vec<Instant> {
        let (begin, end) = both.times();
        let mut since = 0;
        let instants = self.recording.steps.iter().map(|step| {
            let picoseconds = std::mem::replace(&mut since, step.time_ps);
            let cycle = self.period.map(|period| picoseconds / period);
            Instant { until: both.time(0, step.time_ps), picoseconds, cycle }
        });
        instants.filter(|instant| instant.until > begin && instant.until <= end).collect()
    }
}
