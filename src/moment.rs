//! The moment of a block's scenario that a command is about.

use crate::player::play;
use crate::shell::{Exit, Failure};
use clap::Args;
use tilewright_hdl::{DEFAULT_PERIOD, Scenario};
use tilewright_sim::{Error, Simulation};

/// The memory for the past of a run, in bytes.
const REMEMBERED: usize = 256 << 20;

/// A cycle of a clock.
#[derive(Args)]
pub struct Moment {
    /// The cycle of the scenario to look at [default: the last one]
    #[arg(long, value_name = "CYCLE")]
    at: Option<u64>,
    /// The clock whose cycles --at counts [default: the first one of the block]
    #[arg(long, value_name = "NAME")]
    clock: Option<String>,
}

impl Moment {
    /// Its time in picoseconds, in a scenario that was played to its end.
    ///
    /// # Errors
    /// There is no such clock, or the scenario ends before.
    pub fn time(&self, sim: &Simulation) -> Result<u64, Failure> {
        let clocks = &sim.program().clocks;
        let clock = match &self.clock {
            Some(name) => {
                sim.cycles(name).map_err(Error::from)?;
                clocks.iter().find(|clock| clock.name == *name || clock.port == *name)
            }
            None => clocks.first(),
        };
        let period = clock.map_or(DEFAULT_PERIOD.picoseconds(), |clock| clock.period);
        let (Some(at), last) = (self.at, sim.time() / period) else { return Ok(sim.time()) };
        if at > last {
            let of = clock.map(|clock| format!(" of `{}`", clock.name)).unwrap_or_default();
            let sentence = format!("the scenario ends in cycle {last}{of}: give --at a number up to {last}");
            return Err(Failure::new(Exit::BadInput, sentence));
        }
        Ok(at * period)
    }
}

/// Plays a scenario to its end, so that the simulation can go back to each of its cycles. Returns the failure of an assertion, which
/// ends it early.
///
/// # Errors
/// Anything else than a failed assertion.
pub fn play_remembered(sim: &mut Simulation, scenario: &Scenario) -> Result<Option<Failure>, Failure> {
    sim.remember(REMEMBERED);
    match play(sim, scenario, u64::MAX) {
        Ok(()) => Ok(None),
        Err(failure) if failure.exit == Exit::CheckFailed => Ok(Some(failure)),
        Err(failure) => Err(failure),
    }
}
