//! A block, clock by clock: its diagram, the wave of its scenario, and the value of each net with its source line.

use super::Exported;
use super::nets::{Net, sources, values};
use crate::block::{design, ports, simulation, values as parameters};
use crate::player::{check_length, play};
use crate::shell::{Failure, progress};
use serde::Serialize;
use serde_json::json;
use std::fs::File;
use std::io::{Read, Seek};
use std::sync::Arc;
use tilewright_gen::{DiagramOptions, diagram};
use tilewright_hdl::catalog::Entry;
use tilewright_scenes::SceneError;
use tilewright_sim::{EngineKind, Simulation, Vcd};
use tilewright_view::{Answer, Page, Site};

/// The most clocks of a scenario that is shown.
const MOST_CLOCKS: u64 = 2000;

/// A block, played.
pub struct BlockSite {
    about: String,
    data: Arc<Vec<u8>>,
}

/// What the page shows.
#[derive(Serialize)]
struct Data {
    diagram: String,
    wave: String,
    /// The times in picoseconds: the beginning, and each rising edge of a clock.
    times: Vec<u64>,
    nets: Vec<Net>,
}

impl BlockSite {
    /// The name of the data.
    pub const DATA: &str = "block";

    /// A block with these settings, whose scenario is played.
    ///
    /// # Errors
    /// A setting is wrong, or the scenario is too long to be shown; Ctrl-C.
    pub fn new(entry: &'static Entry, settings: &[(String, u64)]) -> Result<BlockSite, Failure> {
        let values = parameters(entry, settings)?;
        let design = design(entry, &values)?;
        let diagram = diagram(&design, &DiagramOptions::default())?.svg();
        let mut sim = simulation(&design, EngineKind::Compiled)?;
        let scenario = entry.scenario(&values)?;
        check_length(&sim, &scenario, "a page")?;
        let clocks: Vec<String> = design.top().clocks.iter().map(|clock| clock.port.clone()).collect();
        let shortest = sim.program().clocks.iter().map(|clock| clock.period).min().unwrap_or(1);
        let end = scenario.end_ps.min(shortest.saturating_mul(MOST_CLOCKS));
        let wave = sim.record(ports(&sim)).times(0..end);
        let vcd = traced(&mut sim, |sim| play(sim, &scenario, end))?;
        progress::phase("reading");
        let (times, nets) = self::values(&vcd, &clocks, &sources(&design));
        let data = Data { diagram, wave: wave.svg(), times, nets };
        let set = |(name, value): (&str, u64)| format!("{name} {value}");
        let parameters: Vec<String> = values.iter().map(set).collect();
        let about = json!({
            "title": std::iter::once(entry.name.to_owned()).chain(parameters).collect::<Vec<_>>().join(", "),
            "summary": design.top().about.summary,
            "scenario": scenario.about,
            "left_out": scenario.end_ps > end,
        });
        let data = serde_json::to_vec(&data).expect("it has names for keys");
        Ok(BlockSite { about: about.to_string(), data: Arc::new(data) })
    }
}

/// The waveform of a run.
fn traced(sim: &mut Simulation, run: impl FnOnce(&mut Simulation) -> Result<(), Failure>) -> Result<Vec<u8>, Failure> {
    let unwritable = |error: std::io::Error| Failure::from(SceneError::unwritable(&std::env::temp_dir(), &error));
    let mut file: File = tempfile::tempfile().map_err(unwritable)?;
    sim.trace(Vcd::into("a temporary file", file.try_clone().map_err(unwritable)?))?;
    let played = run(sim);
    Failure::both(played, sim.finish().map_err(Failure::from))?;
    let mut bytes = Vec::new();
    file.rewind().and_then(|()| file.read_to_end(&mut bytes)).map_err(unwritable)?;
    Ok(bytes)
}

impl Site for BlockSite {
    fn page(&self) -> Page {
        Page::Block
    }

    fn about(&self) -> String {
        self.about.clone()
    }

    fn data(&self, name: &str, _: &str) -> Answer {
        if name == BlockSite::DATA { Answer::Whole(self.data.to_vec()) } else { Answer::Unknown }
    }
}

impl Exported for BlockSite {
    fn whole(&self, _: &str) -> Result<Vec<u8>, Failure> {
        Ok(self.data.to_vec())
    }
}
