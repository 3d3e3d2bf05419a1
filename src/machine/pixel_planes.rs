//! `--machine pixel-planes-5`.

use super::figures::{Compared, Figures, state};
use super::first_given;
use super::job::{Job, Run};
use super::viewed::Viewed;
use crate::golden;
use crate::names::Names;
use crate::number::number;
use crate::scene::polygons_and_spheres;
use crate::shell::{Exit, Failure};
use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, value_parser};
use tilewright_hdl::Design;
use tilewright_machines::pixel_planes::{Config, Edges, Machine, RendererReport, Report};
use tilewright_rtl::pixel_planes::PERIOD;
use tilewright_scenes::golden::{Rule, fragments_of, render_polygons_watched};
use tilewright_scenes::{Frame, Polygons, Scene, Size};
use tilewright_view::{Clock, Grid};

/// Its options.
#[derive(Args, Default)]
#[command(next_help_heading = "Options of --machine pixel-planes-5")]
pub struct PixelPlanesOptions {
    /// Renderers [default: 16]
    #[arg(long, value_name = "N", value_parser = number(1..=Config::MOST_RENDERERS))]
    renderers: Option<u32>,
    /// Side of a region in pixels [default: 128]
    #[arg(long, value_name = "PIXELS",
          value_parser = PossibleValuesParser::new(["8", "16", "32", "64", "128", "256"]).map(|side| side.parse::<u32>().unwrap_or_default()))]
    region: Option<u32>,
    /// Geometry processors, which generate the instructions [default: 32]
    #[arg(long, value_name = "N", value_parser = number(1..=Config::MOST_GEOMETRY))]
    geometry: Option<u32>,
    /// Bandwidth of the ring to the renderers and the frame buffer in Mbit/s, a multiple of 40 [default: 5000]
    #[arg(long, value_name = "MBITS", value_parser = value_parser!(u32))]
    ring: Option<u32>,
    /// How edges are sent. `fixed` uses one length that fits any edge, and `own` the length of each edge. `least` sends the shortest edge with the same
    /// pixels of the region inside [default: least]
    #[arg(long, value_name = "FORM", value_parser = forms())]
    edges: Option<Edges>,
    /// Let tree and memory work on one instruction at a time, without overlap
    #[arg(long)]
    one_at_a_time: bool,
}

/// The forms of edges by their names.
fn forms() -> Names<Edges> {
    Names::new("form of edges", Edges::ALL.map(|form| (form.name(), form)))
}

impl PixelPlanesOptions {
    /// The first of these options that is given, if any is.
    pub fn given(&self) -> Option<&'static str> {
        let PixelPlanesOptions { renderers, region, geometry, ring, one_at_a_time, edges } = self;
        first_given([
            ("--renderers", renderers.is_some()),
            ("--region", region.is_some()),
            ("--geometry", geometry.is_some()),
            ("--ring", ring.is_some()),
            ("--one-at-a-time", *one_at_a_time),
            ("--edges", edges.is_some()),
        ])
    }

    /// A scene for the machine.
    ///
    /// # Errors
    /// The scene cannot be set up, or there is no such machine.
    pub fn job(&self, scene: &Scene, strict: bool) -> Result<PixelPlanesJob, Failure> {
        let scene_polygons = polygons_and_spheres(scene)?;
        let usual = Config::new(scene_polygons.size);
        let config = Config {
            renderers: self.renderers.unwrap_or(usual.renderers),
            side: self.region.unwrap_or(usual.side),
            geometry: self.geometry.unwrap_or(usual.geometry),
            ring: self.ring.unwrap_or(usual.ring),
            side_by_side: !self.one_at_a_time,
            edges: self.edges.unwrap_or(usual.edges),
            strict,
            quadratic: !scene.spheres.is_empty(),
            ..usual
        };
        Ok(PixelPlanesJob {
            machine: Machine::new(config.clone())?,
            config,
            strict,
            polygons: scene_polygons,
            background: scene.background,
        })
    }
}

/// A scene in polygons, and the machine for it.
pub struct PixelPlanesJob {
    machine: Machine,
    config: Config,
    strict: bool,
    polygons: Polygons,
    background: [u8; 3],
}

impl Job for PixelPlanesJob {
    type Report = Report;

    fn size(&self) -> Size {
        self.polygons.size
    }

    fn golden(&self) -> Result<Frame, Failure> {
        let rule = if self.strict { Rule::Strict } else { Rule::Least };
        golden::draw(|watch| render_polygons_watched(&self.polygons, rule, self.background, watch))
    }

    fn render(&self, run: &Run) -> Result<(Frame, Report), Failure> {
        if run.waveform.is_some() {
            let sentence = "each renderer of pixel-planes-5 is simulated separately, so a frame has no waveform: \
                            leave out --vcd, or use `tilewright wave pixel-planes-5` for a small machine, or `tilewright wave renderer`";
            return Err(Failure::new(Exit::BadInput, sentence));
        }
        let mut machine = self.machine.clone().on(run.engine());
        if let Some(recorder) = run.recorder {
            machine = machine.recorded(recorder);
        }
        if let Some(follower) = run.follower {
            machine = machine.following(follower);
        }
        if let Some(tracer) = run.tracer {
            machine = machine.traced(tracer);
        }
        run.watch(|watch| machine.render(&self.polygons, self.background, watch), |(_, report)| report.picoseconds())
    }
}

impl Compared for PixelPlanesJob {
    fn figures(&self, report: &Report) -> Result<Figures, Failure> {
        let hardware = state(&self.config.hardware().map_err(tilewright_machines::Error::from)?)?;
        let (clocks, side, limit) = (report.interval(), report.machine.side, report.limit());
        let milliseconds = |clocks: u64| (clocks * PERIOD.picoseconds()) as f64 / 1e9;
        let working: u64 = report.renderers.iter().map(RendererReport::working).sum();
        Ok(Figures {
            processors: report.machine.renderers,
            processor: format!("renderers of {side}x{side}"),
            register_bits: hardware.registers,
            memory_bits: hardware.memories,
            clocks,
            picoseconds: clocks * PERIOD.picoseconds(),
            time: format!(
                "from one frame sent to the next; meanwhile {1} processors compute the geometry of the next frame in {0:.3} ms",
                milliseconds(report.geometry.clocks),
                report.machine.geometry
            ),
            tested: report.tested(),
            // Its pixels do not count.
            drawn: fragments_of(&self.polygons),
            at_work: working as f64 / (clocks.max(1) * report.renderers.len() as u64) as f64,
            limit: limit.unit.to_string(),
            limit_share: limit.clocks as f64 / clocks.max(1) as f64,
        })
    }
}

impl Viewed for PixelPlanesJob {
    fn clock(&self, _: &Report) -> Clock {
        Clock { name: "the renderers".to_owned(), picoseconds: PERIOD.picoseconds() }
    }

    fn grid(&self) -> Option<Grid> {
        let side = self.config.side;
        Some(Grid { name: format!("regions of {side}x{side}"), size: [side; 2] })
    }

    fn design(&self) -> Result<Option<Design>, Failure> {
        Ok(None)
    }
}
