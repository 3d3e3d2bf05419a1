//! A frame to draw: its polygons dealt to the processing elements.

use tilewright_rtl::lfb::Patches;
use tilewright_rtl::parameter::ParameterError;
use tilewright_scenes::{Projection, Triangle};

use super::assignment::Assignment;
use super::config::Config;
use super::cost::CostTable;
use super::demand::demand;
use super::processor::Processor;
use super::program::Program;

/// What the host loads into the processing elements.
pub(crate) struct Job<'a> {
    pub assignment: Assignment,
    packets: &'a [Triangle],
    costs: CostTable,
    patches: Patches,
}

impl<'a> Job<'a> {
    pub fn new(config: &Config, projection: &'a Projection) -> Result<Job<'a>, ParameterError> {
        Ok(Job {
            assignment: config.assignment(projection, None)?,
            packets: &projection.triangles,
            costs: config.costs,
            patches: config.patches()?,
        })
    }

    /// The processing elements, loaded.
    pub fn processors(&self) -> Vec<Processor<'_>> {
        let program = |polygons| Program::new(self.costs, self.packets, polygons, self.patches.count());
        self.assignment.polygons.iter().map(|polygons| Processor::new(program(polygons))).collect()
    }

    /// Pages with which no processing element finds none.
    fn sufficient_pages(&self) -> u32 {
        let demand = demand(&self.assignment, self.packets, &self.patches);
        demand.iter().map(|it| it.pages).max().unwrap_or_default()
    }
}

impl Config {
    /// Pages in each buffer with which no processing element overflows in that frame; it may have fewer all the same.
    ///
    /// ```
    /// use tilewright_machines::vc1::Config;
    /// use tilewright_scenes::Scene;
    ///
    /// let projection = Scene::builtin("teapot").expect("a built-in scene").project()?;
    /// let config = Config::new(projection.size);
    /// assert!(config.sufficient_pages(&projection)? <= config.pages()?);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// As [`Config::patches`].
    pub fn sufficient_pages(&self, projection: &Projection) -> Result<u32, ParameterError> {
        Ok(Job::new(self, projection)?.sufficient_pages())
    }
}
