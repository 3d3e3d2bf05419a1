//! `--machine pixelflow`.

use super::first_given;
use super::job::{Job, Run};
use crate::golden;
use crate::number::number;
use crate::scene::{deferred, polygons};
use crate::shell::{Exit, Failure};
use clap::{Args, ValueEnum};
use tilewright_machines::pixelflow::{Config, Machine, Report};
use tilewright_scenes::deferred::{Deferred, Samples};
use tilewright_scenes::golden::{render_deferred_watched, render_watched};
use tilewright_scenes::{Frame, Polygons, Scene, Size};

/// Its options.
#[derive(Args, Default)]
#[command(next_help_heading = "Options of --machine pixelflow")]
pub struct PixelFlowOptions {
    /// Nodes, one of which holds the frame [default: 20]
    #[arg(long, value_name = "N", value_parser = number(2..=Config::MOST_NODES))]
    nodes: Option<u32>,
    /// Nodes that shade, of the base system [default: 4]
    #[arg(long, value_name = "N", value_parser = number(1..=Config::MOST_NODES))]
    shaders: Option<u32>,
    /// Pixels of each node's array, which are those of a region; powers of two from 8 to 256 [default: 128x64]
    #[arg(long, value_name = "WxH", value_parser = array)]
    array: Option<[u32; 2]>,
    /// The software: regions one after another, with deferred shading, or all regions in the pixels' memory, in the colours of vertices
    /// [default: base]
    #[arg(long, value_enum, value_name = "SYSTEM")]
    system: Option<System>,
}

/// The software.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum System {
    Base,
    NonTexturing,
}

fn array(text: &str) -> Result<[u32; 2], String> {
    let sides = text.split_once('x').and_then(|(width, height)| Some([width.parse().ok()?, height.parse().ok()?]));
    sides.ok_or_else(|| "give width and height in pixels, such as 128x64".to_owned())
}

impl PixelFlowOptions {
    /// One that is given, if any is.
    pub fn given(&self) -> Option<&'static str> {
        let PixelFlowOptions { nodes, shaders, array, system } = self;
        first_given([
            ("--nodes", nodes.is_some()),
            ("--shaders", shaders.is_some()),
            ("--array", array.is_some()),
            ("--system", system.is_some()),
        ])
    }

    /// A scene for the machine.
    ///
    /// # Errors
    /// The scene cannot be set up, or there is no such machine.
    pub fn job(&self, scene: &Scene) -> Result<PixelFlowJob, Failure> {
        let usual = Config::new(scene.size);
        let system = self.system.unwrap_or(System::Base);
        if let (System::NonTexturing, Some(_)) = (system, self.shaders) {
            let sentence = "the non-texturing system has no shaders: leave out --shaders, or pass --system base";
            return Err(Failure::new(Exit::BadInput, sentence));
        }
        let shaders = self.shaders.unwrap_or(if system == System::Base { usual.shaders } else { 0 });
        let config = Config {
            nodes: self.nodes.unwrap_or(usual.nodes),
            shaders,
            array: self.array.unwrap_or(usual.array),
            ..usual
        };
        let machine = Machine::new(config)?;
        let work = match system {
            System::Base => Work::Deferred(deferred(scene, Samples::One)?),
            System::NonTexturing => Work::Resident(polygons(scene)?, scene.background),
        };
        Ok(PixelFlowJob { machine, work })
    }
}

/// A scene, and the machine for it.
pub struct PixelFlowJob {
    machine: Machine,
    work: Work,
}

/// What is drawn, by which system.
enum Work {
    Deferred(Deferred),
    /// With the background.
    Resident(Polygons, [u8; 3]),
}

impl Job for PixelFlowJob {
    type Report = Report;

    fn size(&self) -> Size {
        match &self.work {
            Work::Deferred(deferred) => deferred.size,
            Work::Resident(polygons, _) => polygons.size,
        }
    }

    fn golden(&self) -> Result<Frame, Failure> {
        golden::draw(|watch| match &self.work {
            Work::Deferred(deferred) => render_deferred_watched(deferred, watch),
            Work::Resident(Polygons { size, polygons, .. }, background) => {
                render_watched(*size, polygons, *background, watch)
            }
        })
    }

    fn render(&self, run: &Run) -> Result<(Frame, Report), Failure> {
        if run.waveform.is_some() {
            let sentence = "each node of pixelflow is a simulation of its own, so there is no waveform of a frame: \
                            leave out --vcd, and see `tilewright wave pixelflow-node`";
            return Err(Failure::new(Exit::BadInput, sentence));
        }
        let machine = self.machine.clone().on(run.engine());
        let render = |watch: &mut tilewright_machines::Watch| match &self.work {
            Work::Deferred(deferred) => machine.render(deferred, watch),
            Work::Resident(polygons, background) => machine.render_resident(polygons, *background, watch),
        };
        run.watch(render, |(_, report)| report.picoseconds())
    }
}
