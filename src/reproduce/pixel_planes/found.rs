//! What was found: counted and drawn.

use super::bins::Counted;
use super::frames::Drawn;
use super::loads::Loads;
use super::plan::Plan;
use crate::shell::Failure;
use tilewright_machines::Watch;

/// All that the page is made of.
pub struct Found {
    pub counted: Counted,
    pub loads: Loads,
    pub frames: Vec<Drawn>,
}

impl Found {
    /// Counts and draws; `None` if it was interrupted.
    pub fn all(plan: &Plan, watch: &mut Watch) -> Result<Option<Found>, Failure> {
        let Some(counted) = Counted::all(plan, watch)? else { return Ok(None) };
        let Some(loads) = Loads::all(plan, watch)? else { return Ok(None) };
        let frames = Drawn::all(plan, watch)?;
        Ok(Some(Found { counted, loads, frames }))
    }
}
