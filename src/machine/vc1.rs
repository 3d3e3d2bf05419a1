//! `--machine vc1`.

mod cost;
mod job;
mod turn;

pub use job::Vc1Job;
pub use turn::Turn;

use super::first_given;
use crate::names::Names;
use crate::number::number;
use crate::shell::{Exit, Failure};
use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use cost::Cost;
use tilewright_machines::vc1::{Assign, Config, Cursor};
use tilewright_rtl::gfb::{Blanking, Passes};
use tilewright_scenes::{MAX_SIDE, Scene};

/// Its options.
#[derive(Args, Default)]
#[command(next_help_heading = "Options of --machine vc1")]
pub struct Vc1Options {
    /// Processing elements [default: 16]
    #[arg(long, value_name = "N", value_parser = number(1..=Config::MAX_PROCESSORS))]
    processors: Option<u32>,
    /// Pages of image memory in each local frame buffer; `auto` gives enough to avoid overflows [default: pages for 65536 pixels, or for a smaller screen]
    #[arg(long, value_name = "N", value_parser = pages)]
    pages: Option<Pages>,
    /// Number of frames, each from the next view of an orbiting camera; FILE.png becomes FILE-001.png and so on [default: 1]
    #[arg(long, value_name = "N", value_parser = number(1..=1000u32))]
    frames: Option<u32>,
    /// Degrees by which the camera orbits from frame to frame [default: a full circle over all frames]
    #[arg(long, value_name = "DEGREES", requires = "frames", allow_negative_numbers = true)]
    turn: Option<f64>,
    /// Area in pixels above which a polygon is sent to all processing elements. Each then draws its own rows of it; `off` sends none [default: 500]
    #[arg(long, value_name = "PIXELS", value_parser = threshold)]
    apr: Option<Threshold>,
    /// Polygons per cluster; a cluster is assigned as a whole [default: 32]
    #[arg(long, value_name = "N", value_parser = number(1..=u32::MAX))]
    cluster: Option<u32>,
    /// How clusters of polygons are assigned to the processing elements. `once` balances the clocks expected for the first view, `each` those of every
    /// view, and `count` the number of polygons [default: once]
    #[arg(long, value_name = "HOW", value_parser = assigns())]
    assign: Option<Assign>,
    /// Send the whole scene over the bus before each frame, instead of once
    #[arg(long)]
    immediate: bool,
    /// Frames averaged into each picture; their vertices are shifted by fractions of a pixel
    #[arg(long, value_name = "N",
          value_parser = PossibleValuesParser::new(["2", "4", "8", "16"]).map(|passes| passes.parse::<u32>().unwrap_or_default()))]
    accumulate: Option<u32>,
    /// Upper left corner of a cursor of 8x8 pixels, which the host writes into each displayed frame
    #[arg(long, value_name = "X,Y", value_parser = cursor, conflicts_with = "accumulate")]
    cursor: Option<Cursor>,
    /// Side of a patch in pixels [default: 4]
    #[arg(long, value_name = "EDGE",
          value_parser = PossibleValuesParser::new(["4", "8", "16"]).map(|edge| edge.parse::<u32>().unwrap_or_default()))]
    patch: Option<u32>,
    /// Refresh rate of the display in Hz, such as 59.94 [default: 60]
    #[arg(long, value_name = "HZ")]
    refresh: Option<f64>,
    /// When the displayed frame may change: at the start of the vertical blanking, or anywhere in it [default: at-start]
    #[arg(long, value_name = "WHEN", value_parser = swaps())]
    swap: Option<Blanking>,
    /// Overhead of the merger after each scan line, in clocks [default: 20]
    #[arg(long, value_name = "CLOCKS", value_parser = number(1..=Config::MAX_OVERHEAD))]
    overhead: Option<u32>,
    /// Time of a 32-bit word on the broadcast bus, in clocks of the processing elements [default: 6]
    #[arg(long, value_name = "CLOCKS", value_parser = number(1..=255u32))]
    bus: Option<u32>,
    /// Size of each processing element's receive queue, in words [default: 64]
    #[arg(long, value_name = "WORDS", value_parser = number(10..=4096u32))]
    queue: Option<u32>,
    #[arg(long, value_name = "NAME=CLOCKS", value_parser = cost::cost, help = cost::help())]
    cost: Vec<Cost>,
}

/// The ways to assign polygons, by name.
fn assigns() -> Names<Assign> {
    Names::new("way to assign polygons", [("once", Assign::Once), ("each", Assign::Each), ("count", Assign::Count)])
}

/// The lines in which the frame changes, by name.
fn swaps() -> Names<Blanking> {
    Names::new("time to swap", [("at-start", Blanking::AtStart), ("in-blanking", Blanking::Within)])
}

/// The fewest pages of a local frame buffer.
const LEAST_PAGES: u32 = 2;
/// The most pages that could be of use: the patches of the largest screen.
const MOST_PAGES: u32 = (MAX_SIDE / 4) * (MAX_SIDE / 4);

impl Vc1Options {
    /// The first of these options that is given, if any is.
    pub fn given(&self) -> Option<&'static str> {
        let Vc1Options {
            processors,
            patch,
            pages,
            cluster,
            apr,
            frames,
            turn,
            accumulate,
            cursor,
            immediate,
            overhead,
            refresh,
            swap,
            bus,
            queue,
            assign,
            cost,
        } = self;
        first_given([
            ("--cluster", cluster.is_some()),
            ("--apr", apr.is_some()),
            ("--frames", frames.is_some()),
            ("--turn", turn.is_some()),
            ("--accumulate", accumulate.is_some()),
            ("--cursor", cursor.is_some()),
            ("--immediate", *immediate),
            ("--overhead", overhead.is_some()),
            ("--bus", bus.is_some()),
            ("--queue", queue.is_some()),
            ("--processors", processors.is_some()),
            ("--patch", patch.is_some()),
            ("--pages", pages.is_some()),
            ("--refresh", refresh.is_some()),
            ("--swap", swap.is_some()),
            ("--assign", assign.is_some()),
            ("--cost", !cost.is_empty()),
        ])
    }

    /// The option that makes several frames, if one does.
    pub fn several(&self) -> Option<&'static str> {
        let frames = self.frames.is_some_and(|frames| frames > 1);
        first_given([("--frames", frames), ("--accumulate", self.accumulate.is_some())])
    }

    /// A picture of a scene.
    ///
    /// # Errors
    /// The scene cannot be set up, or a cost is given twice.
    pub fn job(&self, scene: &Scene) -> Result<Vc1Job, Failure> {
        let turn = self.turn_of(scene, 1, 0.0)?;
        Ok(Vc1Job { config: turn.config, views: turn.views()?, background: scene.background })
    }

    /// An orbit around a scene, if there are several pictures.
    ///
    /// # Errors
    /// As [`Vc1Options::job`]; the angle is not a finite number.
    pub fn turn<'a>(&self, scene: &'a Scene) -> Result<Option<Turn<'a>>, Failure> {
        let pictures = self.frames.unwrap_or(1);
        let degrees = self.turn.unwrap_or(360.0 / f64::from(pictures));
        if !degrees.is_finite() {
            return Err(Failure::new(
                Exit::BadInput,
                format!("--turn {degrees}: give a finite number of degrees, such as 7.5"),
            ));
        }
        (pictures > 1).then(|| self.turn_of(scene, pictures, degrees)).transpose()
    }

    /// An orbit of that many pictures, on the machine that the options describe.
    fn turn_of<'a>(&self, scene: &'a Scene, pictures: u32, degrees: f64) -> Result<Turn<'a>, Failure> {
        let mut turn = Turn { config: self.config(scene)?, scene, pictures, degrees };
        turn.config.pages = match self.pages {
            None => None,
            Some(Pages::Number(pages)) => Some(pages),
            Some(Pages::Auto) => Some(sufficient_pages(&turn)?.max(LEAST_PAGES)),
        };
        Ok(turn)
    }

    fn config(&self, scene: &Scene) -> Result<Config, Failure> {
        let usual = Config::new(scene.size);
        Ok(Config {
            processors: self.processors.unwrap_or(usual.processors),
            patch: self.patch.unwrap_or(usual.patch),
            cluster: self.cluster.unwrap_or(usual.cluster),
            apr: self.apr.map_or(usual.apr, |Threshold(pixels)| pixels),
            queue: self.queue.unwrap_or(usual.queue),
            word_clocks: self.bus.unwrap_or(usual.word_clocks),
            overhead: self.overhead.unwrap_or(usual.overhead),
            refresh: self.refresh.unwrap_or(usual.refresh),
            blanking: self.swap.unwrap_or(usual.blanking),
            assign: self.assign.unwrap_or(usual.assign),
            costs: cost::table(&self.cost)?,
            immediate: self.immediate,
            accumulate: self.accumulate.and_then(Passes::of_count),
            cursor: self.cursor,
            ..usual
        })
    }
}

/// As many pages as the frames of an orbit need. Only one view is in memory at a time.
fn sufficient_pages(turn: &Turn) -> Result<u32, Failure> {
    let mut failure = None;
    let views = (0..turn.frames()).map_while(|number| turn.view(number).map_err(|it| failure = Some(it)).ok());
    let pages = turn.config.sufficient_pages(views).map_err(tilewright_machines::Error::from)?;
    failure.map_or(Ok(pages), Err)
}

/// How many pages each local frame buffer has.
#[derive(Clone, Copy)]
enum Pages {
    Number(u32),
    /// As many as avoid overflows.
    Auto,
}

fn pages(text: &str) -> Result<Pages, String> {
    match text {
        "auto" => Ok(Pages::Auto),
        _ => match number(LEAST_PAGES..=MOST_PAGES)(text) {
            Ok(pages) => Ok(Pages::Number(pages)),
            Err(sentence) => Err(format!("{sentence}, or auto")),
        },
    }
}

fn cursor(text: &str) -> Result<Cursor, String> {
    let place = text.split_once(',').and_then(|(x, y)| Some(Cursor { x: x.parse().ok()?, y: y.parse().ok()? }));
    place.ok_or_else(|| "give two whole numbers of pixels, from the left and from the top, such as 100,50".to_owned())
}

/// The area in pixels above which a polygon is sent to all processing elements; `None` if no polygon is.
#[derive(Clone, Copy)]
struct Threshold(Option<u32>);

fn threshold(text: &str) -> Result<Threshold, String> {
    match text {
        "off" => Ok(Threshold(None)),
        _ => match text.parse() {
            Ok(pixels) => Ok(Threshold(Some(pixels))),
            Err(_) => Err("give a whole number of pixels, such as 500, or off".to_owned()),
        },
    }
}
