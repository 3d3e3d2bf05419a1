//! `--machine vc1`.

mod cost;

use super::figures::{Compared, Figures, state};
use super::first_given;
use super::job::{Job, Run};
use crate::golden;
use crate::number::number;
use crate::scene::triangles;
use crate::shell::Failure;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum};
use cost::Cost;
use tilewright_machines::vc1::{Assign, Config, Machine, Report};
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
    /// Refreshes of the display in a second, such as 59.94 [default: 60]
    #[arg(long, value_name = "HZ")]
    refresh: Option<f64>,
    /// The lines of the vertical blanking in which the displayed frame changes [default: at-start]
    #[arg(long, value_name = "WHEN", value_parser = PossibleValuesParser::new(["at-start", "in-blanking"]))]
    swap: Option<String>,
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
        let Vc1Options { processors, patch, pages, refresh, swap, assign, cost } = self;
        first_given([
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
        let usual = Config::new(projection.size);
        let config = Config {
            processors: self.processors.unwrap_or(usual.processors),
            patch: self.patch.unwrap_or(usual.patch),
            pages: self.pages,
            refresh: self.refresh.unwrap_or(usual.refresh),
            blanking: if self.swap.as_deref() == Some("in-blanking") { Blanking::Within } else { usual.blanking },
            assign: self.assign.map_or(usual.assign, Assign::from),
            costs: cost::table(&self.cost)?,
            ..usual
        };
        Ok(Vc1Job { config, projection, background: scene.background })
    }
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
        let Projection { size, triangles, .. } = &self.projection;
        golden::draw(|watch| render_watched(*size, triangles, self.background, watch))
    }

    fn render(&self, run: &Run) -> Result<(Frame, Report), Failure> {
        let mut machine = Machine::new(self.config)?.on(run.engine());
        run.attach(machine.simulation())?;
        run.watch(
            |watch| machine.render(&self.projection, self.background, watch),
            |(_, report)| report.phases.iter().map(|phase| phase.picoseconds).sum(),
        )
    }
}

impl Compared for Vc1Job {
    fn figures(&self, report: &Report) -> Result<Figures, Failure> {
        let hardware = state(&self.config.hardware().map_err(tilewright_machines::Error::from)?)?;
        let phases = || report.phases.iter().filter(|phase| phase.name != Report::READ_OUT);
        let clocks: u64 = phases().map(|phase| phase.pe_clocks).sum();
        let names: Vec<&str> = phases().map(|phase| phase.name).collect();
        let longest = phases().max_by_key(|phase| phase.picoseconds);
        let working: u64 = report.processors.iter().map(|it| it.work.total()).sum();
        Ok(Figures {
            processors: report.machine.processors,
            processor: "processing elements".to_owned(),
            register_bits: hardware.registers,
            memory_bits: hardware.memories,
            clocks,
            picoseconds: report.frame_picoseconds(),
            time: format!("{}, one after another, geometry being part of drawing", names.join(", ")),
            // Spans are computed, so no pixel is tested in vain.
            tested: report.pixels,
            drawn: report.pixels,
            at_work: working as f64 / (clocks.max(1) * report.processors.len() as u64) as f64,
            limit: longest.map_or("", |phase| phase.name).to_owned(),
            limit_share: longest.map_or(0.0, |phase| phase.picoseconds as f64 / report.frame_picoseconds() as f64),
        })
    }
}
