//! `tilewright debug`: a block's scenario, clock by clock, on a page in the terminal.

mod causes;
mod condition;
mod draw;
mod follow;
mod instants;
mod keys;
mod layout;
mod nets;
mod page;
mod search;
mod shown;
mod source;
mod state;
#[cfg(test)]
mod tests;

use crate::block::{BlockArguments, design, simulation};
use crate::moment::{Moment, play_remembered};
use crate::shell::{Exit, Failure, progress};
use crate::wcp::ViewerOptions;
use clap::Args;
use page::{check_terminal, show};
use state::{Ended, State};
use tilewright_hdl::Design;
use tilewright_hdl::catalog::{Entry, Values};
use tilewright_sim::{EngineKind, Error};

/// Shows a block's scenario clock by clock on a page in the terminal: waves, values, source lines, causes
#[derive(Args)]
#[command(after_help = "\
Examples:
  tilewright debug merging-unit
  tilewright debug fifo --at 12 --signal used
  tilewright debug patch-table --clock merge --at 5

The page shows the waves of the block's nets around a clock, the value of each at it, and the source lines of the selected net. The file of these
lines is looked for from the present folder on, such as in a clone of this repository. Numbers are as in `wave --ascii`.

Keys: → and ← step a clock, with Shift ten. Home and End go to the beginning and the end. ↓ and ↑ select a net, / lists those with a part of a name.
r runs to a condition, R runs back to one, such as `used == 3`, `state != Idle`, `x < -5`, or a net alone, which has to differ from 0.
w tells the causes of the selected net's value, as `why` does: ↓ and ↑ walk among them, Enter goes to the net and the cycle of one.
? shows all keys, q quits. Those of the page of `view` have the same meaning here.

With --wcp or --wcp-wait, as in `debug fifo --wcp`, the cursor of a viewer follows the clock, in a waveform that `tilewright wave` wrote of the same block. In Surfer's menu of a variable, `Go to
declaration` selects its net here, and `Add drivers` tells the causes of its value. Where the viewer tells of its own cursor, the clock follows that.

Exit code 1 means that an assertion of the block fails. The page shows the run up to there. Exit code 2 also means that there is no terminal, and 4 that there is no viewer.")]
pub struct Debug {
    #[command(flatten)]
    block: BlockArguments,
    /// The net that is selected at first
    #[arg(long, value_name = "NET")]
    signal: Option<String>,
    #[command(flatten)]
    moment: Moment,
    #[command(flatten)]
    viewer: ViewerOptions,
}

impl Debug {
    /// Plays the scenario and shows the page.
    pub fn run(self) -> Result<Exit, Failure> {
        check_terminal()?;
        let (entry, values) = self.block.find()?;
        let design = design(entry, &values)?;
        let (mut state, failed) = self.state(entry, &values, &design)?;
        let viewer = self.viewer.viewer()?;
        progress::end();
        match (show(&mut state, viewer)?, failed) {
            (Ended::Quit, None) => Ok(Exit::Done),
            (Ended::Quit, Some(failed)) => Err(failed),
            (Ended::Interrupted, _) => Ok(Exit::Interrupted),
        }
    }

    /// The page's state after the scenario, and the failure of an assertion.
    fn state(&self, entry: &Entry, values: &Values, design: &Design) -> Result<(State, Option<Failure>), Failure> {
        let mut sim = simulation(design, EngineKind::default())?;
        if let Some(name) = &self.signal {
            sim.peek(name).map_err(Error::from)?;
        }
        let failed = play_remembered(&mut sim, &entry.scenario(values)?)?;
        let now = self.moment.time(&sim)?;
        let mut state = State::new(entry.name, parameters(values), design, sim, now, self.signal.as_deref());
        state.message = failed.as_ref().map(|failed| failed.sentence.clone()).unwrap_or_default();
        Ok((state, failed))
    }
}

/// The parameters of a block in words.
fn parameters(values: &Values) -> String {
    values.iter().map(|(name, value)| format!("{name} {value}")).collect::<Vec<_>>().join(", ")
}
