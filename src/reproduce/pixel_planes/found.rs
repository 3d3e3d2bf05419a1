//! All results: counted, drawn and timed.

use super::bins::Counted;
use super::frames::Drawn;
use super::loads::Loads;
use super::plan::Plan;
use super::times::Times;
use crate::scene::polygons;
use crate::shell::Failure;
use tilewright_machines::pixel_planes::Table;
use tilewright_machines::{Error, Watch};
use tilewright_scenes::{Scene, Size};

/// All results of the page.
pub struct Found {
    pub counted: Counted,
    pub loads: Loads,
    pub frames: Vec<Drawn>,
    pub times: Times,
    pub table: Table,
}

impl Found {
    /// Counts, draws and times; `None` if interrupted.
    pub fn all(plan: &Plan, watch: &mut Watch) -> Result<Option<Found>, Failure> {
        let Some(counted) = Counted::all(plan, watch)? else { return Ok(None) };
        let Some(loads) = Loads::all(plan, watch)? else { return Ok(None) };
        let frames = Drawn::all(plan, watch)?;
        let Some(times) = Times::all(plan, watch)? else { return Ok(None) };
        let teapot = Scene { size: Size::VGA, ..Scene::builtin("teapot").expect("a built-in scene") };
        let table =
            Table::new(&polygons(&teapot)?, plan.effort.at_most(1000), plan.effort.seed).map_err(Error::from)?;
        Ok(Some(Found { counted, loads, frames, times, table }))
    }
}
