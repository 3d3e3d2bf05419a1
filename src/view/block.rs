//! A block, clock by clock: for each of its units the diagram, and the value of each net with its source line in the block's scenario.

use super::Exported;
use super::frame::refused;
use super::recorded::{Recorded, written};
use crate::block::{design, simulation, values as parameters};
use crate::player::{check_length, play};
use crate::shell::{Failure, progress};
use serde_json::json;
use tilewright_hdl::catalog::Entry;
use tilewright_sim::{EngineKind, Vcd};
use tilewright_view::{Answer, Page, Site};

/// The most clocks of a scenario that is shown.
const MOST_CLOCKS: u64 = 2000;

/// The most units of a page that is written: others are opened on the page of the server.
const MOST_WRITTEN: usize = 64;

/// A block, played.
pub struct BlockSite {
    about: serde_json::Value,
    recorded: Recorded,
}

impl BlockSite {
    /// A block with these settings, whose scenario is played.
    ///
    /// # Errors
    /// A setting is wrong, or the scenario is too long to be shown; Ctrl-C.
    pub fn new(entry: &'static Entry, settings: &[(String, u64)]) -> Result<BlockSite, Failure> {
        let values = parameters(entry, settings)?;
        let design = design(entry, &values)?;
        let mut sim = simulation(&design, EngineKind::default())?;
        let scenario = entry.scenario(&values)?;
        check_length(&sim, &scenario, "a page")?;
        let shortest = sim.program().clocks.iter().map(|clock| clock.period).min().unwrap_or(1);
        let end = scenario.end_ps.min(shortest.saturating_mul(MOST_CLOCKS));
        let vcd = written(|file| {
            sim.trace(Vcd::into("a temporary file", file))?;
            let played = play(&mut sim, &scenario, end);
            Failure::both(played, sim.finish().map_err(Failure::from))
        })?;
        progress::phase("reading");
        let set = |(name, value): (&str, u64)| format!("{name} {value}");
        let parameters: Vec<String> = values.iter().map(set).collect();
        let about = json!({
            "title": std::iter::once(entry.name.to_owned()).chain(parameters).collect::<Vec<_>>().join(", "),
            "summary": design.top().about.summary,
            "scenario": scenario.about,
            "left_out": scenario.end_ps > end,
        });
        Ok(BlockSite { about, recorded: Recorded::new(design, vcd, &[]) })
    }

    /// The names of the data that a page without a server has.
    pub fn names(&self) -> Vec<String> {
        (0..self.recorded.count().min(MOST_WRITTEN)).map(|number| format!("unit/{number}")).collect()
    }

    /// The data of a unit.
    fn unit(&self, name: &str) -> Result<Option<Vec<u8>>, Failure> {
        let number = name.strip_prefix("unit/").and_then(|number| number.parse().ok());
        let shown = number.map_or(Ok(None), |number| self.recorded.unit(number))?;
        Ok(shown.map(|shown| serde_json::to_vec(&shown).expect("it has names for keys")))
    }
}

impl Site for BlockSite {
    fn page(&self) -> Page {
        Page::Block
    }

    fn about(&self) -> String {
        self.about.to_string()
    }

    fn data(&self, name: &str, _: &str) -> Answer {
        match self.unit(name) {
            Ok(Some(bytes)) => Answer::Whole(bytes),
            Ok(None) => Answer::Unknown,
            Err(failure) => refused(&failure),
        }
    }
}

impl Exported for BlockSite {
    fn whole(&self, name: &str) -> Result<Vec<u8>, Failure> {
        Ok(self.unit(name)?.expect("the names are those of its units"))
    }
}
