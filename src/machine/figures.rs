//! A frame in numbers that all machines share: clocks, state, pixels, load.

use super::Machine;
use super::job::{Job, Run};
use super::pixel_planes::PixelPlanesOptions;
use super::pixelflow::PixelFlowJob;
use super::quadtree::QuadtreeOptions;
use super::vc1::Vc1Options;
use crate::shell::{Failure, progress};
use serde::Serialize;
use tilewright_hdl::ir::State;
use tilewright_hdl::{Block, Design, elaborate};
use tilewright_scenes::{Frame, Scene};

/// The numbers of a frame, counted in the simulated machine or derived from its structure.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Figures {
    /// Units that draw in parallel.
    pub processors: u32,
    /// What these units are.
    pub processor: String,
    /// Bits of all registers of the circuit.
    pub register_bits: u64,
    /// Bits of all memories that the circuit writes.
    pub memory_bits: u64,
    /// Clocks of a frame, in the processors' clock.
    pub clocks: u64,
    /// Simulated time of a frame.
    pub picoseconds: u64,
    /// What that time includes.
    pub time: String,
    /// Pixels that processors test for a polygon, covered or not.
    pub tested: u64,
    /// Pixels that polygons cover; a pixel counts once for each polygon that draws it.
    pub drawn: u64,
    /// Working clocks of all processors over all their clocks in a frame, from 0 to 1.
    pub at_work: f64,
    /// What takes longest.
    pub limit: String,
    /// Its clocks over those of the frame, from 0 to 1.
    pub limit_share: f64,
}

impl Figures {
    /// Simulated milliseconds of a frame.
    pub fn milliseconds(&self) -> f64 {
        self.picoseconds as f64 / 1e9
    }

    /// The processors' clock in MHz.
    pub fn megahertz(&self) -> f64 {
        1e6 * self.clocks as f64 / self.picoseconds.max(1) as f64
    }
}

/// A job whose frame can be compared with those of other machines.
pub trait Compared: Job {
    /// The numbers of the frame of that report.
    ///
    /// # Errors
    /// There is no such machine.
    fn figures(&self, report: &Self::Report) -> Result<Figures, Failure>;
}

/// Draws a scene, and returns the numbers of the frame.
pub type Draw = fn(&Scene, &Run) -> Result<(Frame, Figures), Failure>;

/// A machine that takes part in comparisons.
#[derive(Clone, Copy)]
pub struct Entrant {
    /// Which.
    pub machine: Machine,
    /// Draws a scene on the machine as it is without options, but large enough for the scene.
    pub draw: Draw,
}

/// All of them.
pub const ENTRANTS: [Entrant; 4] = [
    Entrant { machine: Machine::Vc1, draw: |scene, run| drawn(&Vc1Options::default().job(scene)?, run) },
    Entrant {
        machine: Machine::Quadtree,
        draw: |scene, run| drawn(&QuadtreeOptions::default().job(scene, false)?, run),
    },
    Entrant {
        machine: Machine::PixelPlanes,
        draw: |scene, run| drawn(&PixelPlanesOptions::default().job(scene, false)?, run),
    },
    Entrant { machine: Machine::PixelFlow, draw: |scene, run| drawn(&PixelFlowJob::in_memory(scene)?, run) },
];

fn drawn(job: &impl Compared, run: &Run) -> Result<(Frame, Figures), Failure> {
    let (frame, report) = job.render(run)?;
    let figures = job.figures(&report)?;
    Ok((frame, figures))
}

/// The bits of a circuit's registers and memories.
///
/// # Errors
/// Its description has a mistake.
pub fn state<B: Block>(block: &B) -> Result<State, Failure> {
    progress::phase("counting");
    Ok(elaborated(block)?.state())
}

/// The circuit of a block.
///
/// # Errors
/// Its description has a mistake.
pub fn elaborated<B: Block>(block: &B) -> Result<Design, Failure> {
    Ok(elaborate(block).map_err(tilewright_sim::Error::from)?)
}
