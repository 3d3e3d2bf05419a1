//! The machines, and the options of each.

mod figures;
mod followed;
mod job;
pub mod pixel_planes;
pub mod pixelflow;
pub mod quadtree;
pub mod vc1;
mod viewed;

use crate::shell::{Exit, Failure};
use clap::{Args, ValueEnum};
use serde::Serialize;

pub use figures::{ENTRANTS, Entrant, Figures};
pub use followed::{Followed, check_pixel, follow, render_traced, signals_of, times_around, unit_and_name};
pub use job::{Job, Run};
pub use vc1::Turn;
pub use viewed::{Viewed, Visitor, visit};

/// A machine by its name on the command line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Machine {
    Vc1,
    Quadtree,
    #[value(name = "pixel-planes-5")]
    PixelPlanes,
    #[value(name = "pixelflow")]
    PixelFlow,
}

impl Machine {
    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Machine::Vc1 => "vc1",
            Machine::Quadtree => "quadtree",
            Machine::PixelPlanes => "pixel-planes-5",
            Machine::PixelFlow => "pixelflow",
        }
    }

    /// What it is, in a few words.
    pub fn summary(self) -> &'static str {
        match self {
            Machine::Vc1 => "processing elements draw into virtual local frame buffers, which are merged by depth",
            Machine::Quadtree => {
                "video processors find the pixels of polygons, each on a sparse raster, by dividing windows"
            }
            Machine::PixelPlanes => {
                "renderers draw the screen's regions, each an array of pixels that compute under one instruction"
            }
            Machine::PixelFlow => {
                "nodes draw their share of all polygons, and a network composes the regions, which other nodes shade"
            }
        }
    }

    /// The paper.
    pub fn source(self) -> &'static str {
        match self {
            Machine::Vc1 => {
                "Nishimura and Kunii, VC-1: A Scalable Graphics Computer with Virtual Local Frame Buffers, SIGGRAPH 96"
            }
            Machine::Quadtree => {
                "a Russian paper on matrix-pipeline image generators, whose title and authors are not known"
            }
            Machine::PixelPlanes => "section I.3.2, Renderer Performance, of a text on Pixel-planes 5",
            Machine::PixelFlow => {
                "Lastra, Reducing Latency on PixelFlow, Eurographics Workshop on Graphics Hardware, 1995"
            }
        }
    }

    /// The options of `render` for this machine alone.
    pub fn options(self) -> Vec<MachineOption> {
        match self {
            Machine::Vc1 => options::<vc1::Vc1Options>(),
            Machine::Quadtree => [options::<quadtree::QuadtreeOptions>(), options::<OrderOptions>()].concat(),
            Machine::PixelPlanes => [options::<pixel_planes::PixelPlanesOptions>(), options::<OrderOptions>()].concat(),
            Machine::PixelFlow => options::<pixelflow::PixelFlowOptions>(),
        }
    }
}

/// An option of `render`, as its help shows it.
#[derive(Clone, Serialize)]
pub struct MachineOption {
    /// The option with its value, such as `--patch EDGE`.
    pub option: String,
    pub meaning: String,
}

fn options<A: Args>() -> Vec<MachineOption> {
    let command = A::augment_args(clap::Command::new("render"));
    let option = |it: &clap::Arg| {
        let name = format!("--{}", it.get_long().unwrap_or_default());
        let takes_values = it.get_action().takes_values();
        let values = it.get_value_names().unwrap_or_default().iter().filter(|_| takes_values).map(|name| name.as_str());
        MachineOption {
            option: std::iter::once(name.as_str()).chain(values).collect::<Vec<_>>().join(" "),
            meaning: it.get_help().map(ToString::to_string).unwrap_or_default(),
        }
    };
    command.get_arguments().map(option).collect()
}

/// The options of all machines.
#[derive(Args)]
pub struct MachineArguments {
    #[command(flatten)]
    pub vc1: vc1::Vc1Options,
    #[command(flatten)]
    pub quadtree: quadtree::QuadtreeOptions,
    #[command(flatten)]
    pub pixel_planes: pixel_planes::PixelPlanesOptions,
    #[command(flatten)]
    pub order: OrderOptions,
    #[command(flatten)]
    pub pixelflow: pixelflow::PixelFlowOptions,
}

/// Which of two pixels of equal depth is visible, on machines that draw in the sequence of submission.
#[derive(Args)]
#[command(next_help_heading = "Options of --machine quadtree and --machine pixel-planes-5")]
pub struct OrderOptions {
    /// Compare depth alone and keep the first drawn of equal depths, on the machine and in the golden image
    #[arg(long)]
    pub strict: bool,
}

impl MachineArguments {
    /// Checks that each option given is one of that machine.
    ///
    /// # Errors
    /// An option is another machine's.
    pub fn check(&self, machine: Machine) -> Result<(), Failure> {
        let given = [
            (Machine::Vc1, self.vc1.given()),
            (Machine::Quadtree, self.quadtree.given()),
            (Machine::PixelPlanes, self.pixel_planes.given()),
            (Machine::PixelFlow, self.pixelflow.given()),
        ];
        let strange = given.into_iter().filter(|(of, _)| *of != machine).find_map(|(of, it)| Some((of.name(), it?)));
        let strict = ("quadtree and pixel-planes-5", "--strict");
        let strange =
            strange.or((matches!(machine, Machine::Vc1 | Machine::PixelFlow) && self.order.strict).then_some(strict));
        strange.map_or(Ok(()), |(of, option)| {
            let (machine, other) = (machine.name(), of.split(' ').next().unwrap_or(of));
            let sentence = format!(
                "{option} is an option of {of}, and the machine is {machine}: leave it out, or pass --machine {other}"
            );
            Err(Failure::new(Exit::BadInput, sentence))
        })
    }
}

impl MachineArguments {
    /// The first option of any machine that is given, if one is.
    pub fn given(&self) -> Option<&'static str> {
        let strict = self.order.strict.then_some("--strict");
        let of_machines =
            [self.vc1.given(), self.quadtree.given(), self.pixel_planes.given(), self.pixelflow.given(), strict];
        of_machines.into_iter().flatten().next()
    }

    /// The option that makes several frames on that machine, if one does.
    pub fn several(&self, machine: Machine) -> Option<&'static str> {
        match machine {
            Machine::Vc1 => self.vc1.several(),
            Machine::PixelFlow => self.pixelflow.several(),
            Machine::Quadtree | Machine::PixelPlanes => None,
        }
    }
}

/// The name of the first option that is given.
fn first_given<const N: usize>(options: [(&'static str, bool); N]) -> Option<&'static str> {
    options.into_iter().find(|(_, is_given)| *is_given).map(|(name, _)| name)
}
