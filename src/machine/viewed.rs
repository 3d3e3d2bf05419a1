//! What the page of `view` knows of a machine beside its frame.

use super::Machine;
use super::job::Job;
use super::pixel_planes::PixelPlanesOptions;
use super::pixelflow::PixelFlowOptions;
use super::quadtree::QuadtreeOptions;
use super::vc1::Vc1Options;
use crate::shell::Failure;
use tilewright_hdl::Design;
use tilewright_scenes::Scene;
use tilewright_view::{Clock, Grid};

/// A job whose frame can be viewed as it comes into being.
pub trait Viewed: Job {
    /// The clock in which the history's times are counted; all of them are multiples of its period.
    fn clock(&self, report: &Self::Report) -> Clock;

    /// The parts of the screen that the machine treats as a whole.
    fn grid(&self) -> Option<Grid>;

    /// The circuit, if the machine is simulated as a whole.
    ///
    /// # Errors
    /// Its description has a mistake.
    fn design(&self) -> Result<Option<Design>, Failure>;
}

/// What is done with a job, whichever machine it is for.
pub trait Visitor {
    /// What comes of it.
    type Output;

    /// Does it.
    ///
    /// # Errors
    /// Those of the visitor.
    fn visit(self, job: &impl Viewed) -> Result<Self::Output, Failure>;
}

/// Visits the job of a scene for a machine as `render` makes it without options.
///
/// # Errors
/// The machine cannot draw the scene, or those of the visitor.
pub fn visit<V: Visitor>(scene: &Scene, machine: Machine, visitor: V) -> Result<V::Output, Failure> {
    match machine {
        Machine::Vc1 => visitor.visit(&Vc1Options::default().job(scene)?),
        Machine::Quadtree => visitor.visit(&QuadtreeOptions::default().job(scene, false)?),
        Machine::PixelPlanes => visitor.visit(&PixelPlanesOptions::default().job(scene, false)?),
        Machine::PixelFlow => visitor.visit(&PixelFlowOptions::default().job(scene)?),
    }
}
