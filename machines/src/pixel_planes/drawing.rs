//! A scene for the transaction-level model, made once for machines with any number of renderers and any ring.

use super::clocks::Tally;
use super::machine::Machine;
use super::model::Step;
use crate::error::Error;
use tilewright_scenes::Polygons;

/// The work for a scene by region. Regions are in the sequence in which renderers get them: those with most primitives come first.
#[derive(Clone, Debug)]
pub struct Drawing {
    /// The instructions of each region, for [`Model::run`](super::model::Model::run).
    pub steps: Vec<Vec<Step>>,
    /// The primitives of each region.
    pub primitives: Vec<u64>,
    /// The clocks of the primitives, if instructions always arrive in time.
    pub programs: Tally,
}

impl Machine {
    /// The work for a scene. It is the same for all machines that differ only in the number of renderers, in queues and in the ring.
    ///
    /// ```
    /// use tilewright_machines::pixel_planes::{Config, Machine, model::Model};
    /// use tilewright_scenes::{Scene, Size, project_polygons};
    ///
    /// let polygons = project_polygons(&Scene::builtin("star").expect("a built-in scene"), Size::new(48, 32)?)?;
    /// let config = Config { renderers: 1, side: 16, ..Config::new(polygons.size) };
    /// let drawing = Machine::new(config.clone())?.drawing(&polygons)?;
    /// let two = Config { renderers: 2, ..config };
    /// let timing = Model::new(&two)?.run(&drawing.steps);
    /// assert_eq!(timing, Machine::new(two)?.timing(&polygons)?);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Parameter`] if the polygons are of another screen.
    pub fn drawing(&self, polygons: &Polygons) -> Result<Drawing, Error> {
        let works = self.works(&self.config.regions()?, polygons, [0; 3])?;
        let mut programs = Tally::default();
        works.iter().for_each(|work| programs.add(work.programs));
        Ok(Drawing {
            steps: works.iter().map(|work| Step::of(&work.instructions)).collect(),
            primitives: works.iter().map(|work| work.primitives[0]).collect(),
            programs,
        })
    }
}
