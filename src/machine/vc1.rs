//! `--machine vc1`.

mod cost;
mod turn;

pub use turn::Turn;

use super::figures::{Compared, Figures, state};
use super::first_given;
use super::job::{Job, Run};
use crate::golden;
use crate::number::number;
use crate::scene::triangles;
use crate::shell::{Exit, Failure};
use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum};
use cost::Cost;
use tilewright_machines::vc1::{Assign, Config, Machine, Report, Times};
use tilewright_rtl::clocks::PE;
use tilewright_rtl::gfb::Blanking;
use tilewright_scenes::golden::render_watched;
use tilewright_scenes::{Frame, MAX_SIDE, Projection, Scene, Size};

/// Its options.
#[derive(Args, Default)]
#[command(next_help_heading = "Options of --machine vc1")]
pub struct Vc1Options {
    /// Processing elements [default: 16]
    #[arg(long, value_name = "N", value_parser = number(1..=Config::MAX_PROCESSORS))]
    processors: Option<u32>,
    /// The edge of a patch in pixels [default: 4]
    #[arg(long, value_name = "EDGE",
          value_parser = PossibleValuesParser::new(["4", "8", "16"]).map(|edge| edge.parse::<u32>().unwrap_or_default()))]
    patch: Option<u32>,
    /// Pages of image memory in each local frame buffer [default: those of 65536 pixels, or the whole screen]
    #[arg(long, value_name = "N", value_parser = number(2..=MOST_PAGES))]
    pages: Option<u32>,
    /// Polygons of a cluster, which is dealt as a whole [default: 32]
    #[arg(long, value_name = "N", value_parser = number(1..=u32::MAX))]
    cluster: Option<u32>,
    /// The area in pixels above which a polygon is sent to all processing elements, each of which draws its rows; or `off` [default: 500]
    #[arg(long, value_name = "PIXELS", value_parser = threshold)]
    apr: Option<Threshold>,
    /// Frames, one of each view of a camera that turns; FILE.png becomes FILE-001.png and so on [default: 1]
    #[arg(long, value_name = "N", value_parser = number(1..=1000u32))]
    frames: Option<u32>,
    /// By how much the camera turns from frame to frame [default: a full turn in all frames]
    #[arg(long, value_name = "DEGREES", requires = "frames", allow_negative_numbers = true)]
    turn: Option<f64>,
    /// Refreshes of the display in a second, such as 59.94 [default: 60]
    #[arg(long, value_name = "HZ")]
    refresh: Option<f64>,
    /// The lines of the vertical blanking in which the displayed frame changes [default: at-start]
    #[arg(long, value_name = "WHEN", value_parser = PossibleValuesParser::new(["at-start", "in-blanking"]))]
    swap: Option<String>,
    /// Clocks of the processing elements that a word of 32 bits is on the broadcast bus [default: 6]
    #[arg(long, value_name = "CLOCKS", value_parser = number(1..=255u32))]
    bus: Option<u32>,
    /// Words that the receive queue of a processing element holds [default: 64]
    #[arg(long, value_name = "WORDS", value_parser = number(10..=4096u32))]
    queue: Option<u32>,
    /// How clusters of polygons are dealt to the processing elements: by the clocks that they are expected to take, once in the first view or anew in
    /// each, or by the count of polygons alone [default: once]
    #[arg(long, value_enum, value_name = "HOW")]
    assign: Option<AssignName>,
    #[arg(long, value_name = "NAME=CLOCKS", value_parser = cost::cost, help = cost::help())]
    cost: Vec<Cost>,
}

/// How polygons are dealt.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum AssignName {
    Once,
    Each,
    Count,
}

impl From<AssignName> for Assign {
    fn from(name: AssignName) -> Assign {
        match name {
            AssignName::Once => Assign::Once,
            AssignName::Each => Assign::Each,
            AssignName::Count => Assign::Count,
        }
    }
}

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

    /// A scene for the machine.
    ///
    /// # Errors
    /// The scene cannot be set up, or a cost is given twice.
    pub fn job(&self, scene: &Scene) -> Result<Vc1Job, Failure> {
        let projection = triangles(scene)?;
        let config = self.config(projection.size)?;
        Ok(Vc1Job { config, projection, background: scene.background })
    }

    /// A turn around a scene, if it is of several frames.
    ///
    /// # Errors
    /// A cost is given twice, or the turn is no number.
    pub fn turn<'a>(&self, scene: &'a Scene) -> Result<Option<Turn<'a>>, Failure> {
        let frames = self.frames.unwrap_or(1);
        let degrees = self.turn.unwrap_or(360.0 / f64::from(frames));
        if !degrees.is_finite() {
            return Err(Failure::new(
                Exit::BadInput,
                format!("a turn of {degrees} degrees: give a number, such as 7.5"),
            ));
        }
        let config = self.config(scene.size)?;
        Ok((frames > 1).then_some(Turn { config, scene, frames, degrees }))
    }

    fn config(&self, size: Size) -> Result<Config, Failure> {
        let usual = Config::new(size);
        Ok(Config {
            processors: self.processors.unwrap_or(usual.processors),
            patch: self.patch.unwrap_or(usual.patch),
            pages: self.pages,
            cluster: self.cluster.unwrap_or(usual.cluster),
            apr: self.apr.map_or(usual.apr, |Threshold(pixels)| pixels),
            queue: self.queue.unwrap_or(usual.queue),
            word_clocks: self.bus.unwrap_or(usual.word_clocks),
            refresh: self.refresh.unwrap_or(usual.refresh),
            blanking: if self.swap.as_deref() == Some("in-blanking") { Blanking::Within } else { usual.blanking },
            assign: self.assign.map_or(usual.assign, Assign::from),
            costs: cost::table(&self.cost)?,
            ..usual
        })
    }
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

/// The software rasterizer's frame of a view.
fn golden_of(view: &Projection, background: [u8; 3]) -> Result<Frame, Failure> {
    golden::draw(|watch| render_watched(view.size, &view.triangles, background, watch))
}

/// A scene in triangles, and the machine for it.
pub struct Vc1Job {
    config: Config,
    projection: Projection,
    background: [u8; 3],
}

impl Job for Vc1Job {
    type Report = Report;

    fn size(&self) -> Size {
        self.projection.size
    }

    fn golden(&self) -> Result<Frame, Failure> {
        golden_of(&self.projection, self.background)
    }

    fn render(&self, run: &Run) -> Result<(Frame, Report), Failure> {
        let mut machine = Machine::new(self.config)?.on(run.engine());
        run.attach(machine.simulation())?;
        run.watch(|watch| machine.render(&self.projection, self.background, watch), |(_, report)| report.picoseconds())
    }
}

impl Compared for Vc1Job {
    fn figures(&self, report: &Report) -> Result<Figures, Failure> {
        let hardware = state(&self.config.hardware().map_err(tilewright_machines::Error::from)?)?;
        let [frame] = &report.frames[..] else { unreachable!("a job is of one frame") };
        let picoseconds = frame.picoseconds();
        let clocks = picoseconds / PE.period.picoseconds();
        let Times { command, drawn, swapped, merged, shown } = frame.times;
        let parts = [
            ("drawing", Some(command), drawn),
            ("swapping", drawn, swapped),
            ("merging", swapped, merged),
            ("blanking", merged, shown),
        ];
        let parts = parts.map(|(name, from, to)| (name, to.unwrap_or_default() - from.unwrap_or_default()));
        let (limit, longest) = parts.into_iter().max_by_key(|(_, time)| *time).unwrap_or_default();
        let working: u64 = frame.processors.iter().map(|it| it.clocks.work()).sum();
        Ok(Figures {
            processors: report.machine.processors,
            processor: "processing elements".to_owned(),
            register_bits: hardware.registers,
            memory_bits: hardware.memories,
            clocks,
            picoseconds,
            time: "from the command until the display shows the frame; drawing has the geometry, blanking is the wait for the display"
                .to_owned(),
            // Spans are computed, so no pixel is tested in vain.
            tested: frame.pixels(),
            drawn: frame.pixels(),
            at_work: working as f64 / (clocks.max(1) * frame.processors.len() as u64) as f64,
            limit: limit.to_owned(),
            limit_share: longest as f64 / picoseconds.max(1) as f64,
        })
    }
}
