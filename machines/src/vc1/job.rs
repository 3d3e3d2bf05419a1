//! A frame to draw: its polygons dealt to the processing elements.

use tilewright_rtl::lfb::Patches;
use tilewright_rtl::parameter::ParameterError;
use tilewright_scenes::{Projection, Triangle};

use super::assignment::Assignment;
use super::config::Config;
use super::cost::CostTable;
use super::demand::demand;
use super::overflow::Overflow;
use super::processor::Processor;
use super::program::Program;

/// What the host loads into the processing elements.
pub(crate) struct Job<'a> {
    pub assignment: Assignment,
    packets: &'a [Triangle],
    costs: CostTable,
    patches: Patches,
    pages: u32,
}

impl<'a> Job<'a> {
    pub fn new(config: &Config, projection: &'a Projection) -> Result<Job<'a>, ParameterError> {
        let Config { processors, cluster, costs, .. } = *config;
        Ok(Job {
            assignment: Assignment::new(projection, processors, cluster, &costs),
            packets: &projection.triangles,
            costs,
            patches: config.patches()?,
            pages: config.pages()?,
        })
    }

    /// The processing elements, loaded.
    pub fn processors(&self) -> Vec<Processor<'_>> {
        let program = |polygons| Program::new(self.costs, self.packets, polygons, self.patches.count());
        self.assignment.polygons.iter().map(|polygons| Processor::new(program(polygons))).collect()
    }

    /// That a processing element found no page for a pixel of a polygon.
    pub fn overflow(&self, processor: usize, polygon: u32) -> Overflow {
        let demand = demand(&self.assignment, self.packets, &self.patches);
        let sufficient = demand.iter().map(|it| it.pages).max().unwrap_or_default();
        Overflow { processor, pages: self.pages, polygon, sufficient }
    }
}
