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
    /// Pages of image memory in each local frame buffer, or `auto` for as many as avoid overflows [default: those of 65536 pixels, or the whole screen]
    #[arg(long, value_name = "N", value_parser = pages)]
    pages: Option<Pages>,
    /// Frames, one of each view of a camera that turns; FILE.png becomes FILE-001.png and so on [default: 1]
    #[arg(long, value_name = "N", value_parser = number(1..=1000u32))]
    frames: Option<u32>,
    /// By how much the camera turns from frame to frame [default: a full turn in all frames]
    #[arg(long, value_name = "DEGREES", requires = "frames", allow_negative_numbers = true)]
    turn: Option<f64>,
    /// The area in pixels above which a polygon is sent to all processing elements, each of which draws its rows; or `off` [default: 500]
    #[arg(long, value_name = "PIXELS", value_parser = threshold)]
    apr: Option<Threshold>,
    /// Polygons of a cluster, which is dealt as a whole [default: 32]
    #[arg(long, value_name = "N", value_parser = number(1..=u32::MAX))]
    cluster: Option<u32>,
    /// How clusters of polygons are dealt to the processing elements: by the clocks that they are expected to take, once in the first view or anew in
    /// each, or by the count of polygons alone [default: once]
    #[arg(long, value_name = "HOW", value_parser = assigns())]
    assign: Option<Assign>,
    /// The host sends the whole scene over the bus before each frame, instead of once
    #[arg(long)]
    immediate: bool,
    /// Frames of which each picture is the average, with the vertices moved by parts of a pixel
    #[arg(long, value_name = "N",
          value_parser = PossibleValuesParser::new(["2", "4", "8", "16"]).map(|passes| passes.parse::<u32>().unwrap_or_default()))]
    accumulate: Option<u32>,
    /// The upper left corner of a cursor of 8x8 pixels, which the host writes into each frame on display
    #[arg(long, value_name = "X,Y", value_parser = cursor, conflicts_with = "accumulate")]
    cursor: Option<Cursor>,
    /// The edge of a patch in pixels [default: 4]
    #[arg(long, value_name = "EDGE",
          value_parser = PossibleValuesParser::new(["4", "8", "16"]).map(|edge| edge.parse::<u32>().unwrap_or_default()))]
    patch: Option<u32>,
    /// Refreshes of the display in a second, such as 59.94 [default: 60]
    #[arg(long, value_name = "HZ")]
    refresh: Option<f64>,
    /// The lines of the vertical blanking in which the displayed frame changes [default: at-start]
    #[arg(long, value_name = "WHEN", value_parser = swaps())]
    swap: Option<Blanking>,
    /// Clocks of the merger after each scan line [default: 20]
    #[arg(long, value_name = "CLOCKS", value_parser = number(1..=Config::MAX_OVERHEAD))]
    overhead: Option<u32>,
    /// Clocks of the processing elements that a word of 32 bits is on the broadcast bus [default: 6]
    #[arg(long, value_name = "CLOCKS", value_parser = number(1..=255u32))]
    bus: Option<u32>,
    /// Words that the receive queue of a processing element holds [default: 64]
    #[arg(long, value_name = "WORDS", value_parser = number(10..=4096u32))]
    queue: Option<u32>,
    #[arg(long, value_name = "NAME=CLOCKS", value_parser = cost::cost, help = cost::help())]
    cost: Vec<Cost>,
}

/// The ways to deal polygons, by name.
fn assigns() -> Names<Assign> {
    Names::new("way to deal polygons", [("once", Assign::Once), ("each", Assign::Each), ("count", Assign::Count)])
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
    /// One that is given, if any is.
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

    /// What makes several frames, if anything does.
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

    /// A turn around a scene, if it is of several pictures.
    ///
    /// # Errors
    /// As [`Vc1Options::job`]; the turn is no number.
    pub fn turn<'a>(&self, scene: &'a Scene) -> Result<Option<Turn<'a>>, Failure> {
        let pictures = self.frames.unwrap_or(1);
        let degrees = self.turn.unwrap_or(360.0 / f64::from(pictures));
        if !degrees.is_finite() {
            return Err(Failure::new(
                Exit::BadInput,
                format!("a turn of {degrees} degrees: give a number, such as 7.5"),
            ));
        }
        (pictures > 1).then(|| self.turn_of(scene, pictures, degrees)).transpose()
    }

    /// A turn of that many pictures, on the machine that is asked for.
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

/// As many pages as the frames of a turn need, of which it holds one view at a time.
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
    place.ok_or_else(|| "give two whole numbers of pixels, from the left and from above, such as 100,50".to_owned())
}

/// The area above which a polygon is sent to all, in pixels; none if all are drawn where they are.
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
