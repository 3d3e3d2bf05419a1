//! `--machine pixelflow`.

mod stereo;

use super::figures::{Compared, Figures, state};
use super::first_given;
use super::job::{Job, Run};
use super::viewed::Viewed;
use crate::golden;
use crate::names;
use crate::number::number;
use crate::scene::{deferred, polygons, samples as passes};
use crate::shell::{Exit, Failure};
use clap::{Args, ValueEnum};
pub use stereo::StereoJob;
use stereo::StereoName;
use tilewright_hdl::Design;
use tilewright_machines::pixelflow::{Config, Machine, Report};
use tilewright_scenes::deferred::{Deferred, Samples, Shading};
use tilewright_scenes::golden::{fragments, render_deferred_watched, render_samples_watched, render_watched};
use tilewright_scenes::{Field, Frame, Polygons, Projection, Scene, Size};
use tilewright_view::{Clock, Grid};

/// The period of the network's clock.
const PICOSECONDS: u64 = 5000;

/// Its options.
#[derive(Args, Default)]
#[command(next_help_heading = "Options of --machine pixelflow")]
pub struct PixelFlowOptions {
    /// Nodes, one of which has the frame buffer [default: 20]
    #[arg(long, value_name = "N", value_parser = number(2..=Config::MOST_NODES))]
    nodes: Option<u32>,
    /// Nodes that shade; the non-texturing system has none [default: 4]
    #[arg(long, value_name = "N", value_parser = number(1..=Config::MOST_NODES))]
    shaders: Option<u32>,
    /// Width and height of each node's pixel array, and so of a region; powers of two from 8 to 256 [default: 128x64]
    #[arg(long, value_name = "WxH", value_parser = array)]
    array: Option<[u32; 2]>,
    /// The software. `base` draws region after region with deferred shading. `pre-sorting` does, too, but its front end sorts in a pass of its own and makes
    /// instructions while others are drawn. `non-texturing` keeps all regions in the pixels' memory and interpolates the colours of vertices [default: base]
    #[arg(long, value_name = "SYSTEM", value_parser = names::of::<System>("system"))]
    system: Option<System>,
    /// Samples per pixel. Eight samples are two renderings at twice the width and height. The base system draws them region by region, the
    /// non-texturing system sample by sample [default: 1]
    #[arg(long, value_name = "N", value_parser = ["1", "8"])]
    samples: Option<String>,
    /// Shade once what the eight samples of a pixel have in common, instead of each sample. They are drawn one after another and go to the same shader
    #[arg(long)]
    shade_once: bool,
    /// Draw one field of an interlaced display: the even lines of the frame, starting with line 0, or the odd lines
    #[arg(long, value_name = "FIELD", value_parser = names::of::<FieldName>("field"))]
    field: Option<FieldName>,
    /// Draw a frame for each eye, side by side. `halved` draws both at once, each on half of the nodes; `sequential` draws one after the other on all nodes
    #[arg(long, value_name = "HOW", value_parser = names::of::<StereoName>("way to share the nodes"))]
    stereo: Option<StereoName>,
    /// Distance between the eyes in units of the scene; the lines of sight are parallel
    /// [default: a thirtieth of the distance to what the camera looks at]
    #[arg(long, value_name = "DISTANCE", allow_negative_numbers = true)]
    eyes: Option<f64>,
}

/// Each second line of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum FieldName {
    Even,
    Odd,
}

impl From<FieldName> for Field {
    fn from(name: FieldName) -> Field {
        match name {
            FieldName::Even => Field::Even,
            FieldName::Odd => Field::Odd,
        }
    }
}

/// The software.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum System {
    Base,
    PreSorting,
    NonTexturing,
}

impl System {
    /// It shades pixels.
    fn shades(self) -> bool {
        self != System::NonTexturing
    }
}

fn array(text: &str) -> Result<[u32; 2], String> {
    let sides = text.split_once('x').and_then(|(width, height)| Some([width.parse().ok()?, height.parse().ok()?]));
    sides.ok_or_else(|| "give width and height in pixels, such as 128x64".to_owned())
}

impl PixelFlowOptions {
    /// The first of these options that is given, if any is.
    pub fn given(&self) -> Option<&'static str> {
        let PixelFlowOptions { nodes, shaders, array, system, samples, shade_once, field, stereo, eyes } = self;
        first_given([
            ("--nodes", nodes.is_some()),
            ("--shaders", shaders.is_some()),
            ("--array", array.is_some()),
            ("--system", system.is_some()),
            ("--samples", samples.is_some()),
            ("--shade-once", *shade_once),
            ("--field", field.is_some()),
            ("--stereo", stereo.is_some()),
            ("--eyes", eyes.is_some()),
        ])
    }

    /// The option that makes several frames, if one does.
    pub fn several(&self) -> Option<&'static str> {
        first_given([("--stereo", self.stereo.is_some())])
    }

    /// A scene for the machine.
    ///
    /// # Errors
    /// The scene cannot be set up, or there is no such machine.
    pub fn job(&self, scene: &Scene) -> Result<PixelFlowJob, Failure> {
        let config = self.config(scene)?;
        self.frame(scene, Machine::new(config.clone())?, config)
    }

    /// A scene for both eyes, if that is asked for.
    ///
    /// # Errors
    /// As [`PixelFlowOptions::job`]; or the distance between the eyes is out of range.
    pub fn stereo_job(&self, scene: &Scene) -> Result<Option<StereoJob>, Failure> {
        match self.stereo {
            Some(stereo) => StereoJob::new(self, scene, &self.config(scene)?, stereo.into()).map(Some),
            None if self.eyes.is_some() => {
                let sentence = "--eyes needs a frame for each eye: add --stereo halved or --stereo sequential";
                Err(Failure::new(Exit::BadInput, sentence))
            }
            None => Ok(None),
        }
    }

    /// The whole machine.
    fn config(&self, scene: &Scene) -> Result<Config, Failure> {
        let usual = Config::new(scene.size);
        let system = self.system();
        if let (System::NonTexturing, Some(_)) = (system, self.shaders) {
            let sentence = "the non-texturing system has no shaders: leave out --shaders, or pass --system base";
            return Err(Failure::new(Exit::BadInput, sentence));
        }
        if self.shade_once && self.samples.as_deref() != Some("8") {
            let sentence = "--shade-once needs several samples per pixel: add --samples 8";
            return Err(Failure::new(Exit::BadInput, sentence));
        }
        if self.shade_once && system == System::NonTexturing {
            let sentence = "the non-texturing system shades nothing: leave out --shade-once, or pass --system base";
            return Err(Failure::new(Exit::BadInput, sentence));
        }
        let field = self.field.map(Field::from);
        field.map_or(Ok(scene.size), |field| field.size(scene.size))?;
        let shaders = self.shaders.unwrap_or(if system.shades() { usual.shaders } else { 0 });
        Ok(Config {
            nodes: self.nodes.unwrap_or(usual.nodes),
            shaders,
            field,
            pre_sort: system == System::PreSorting,
            array: self.array.unwrap_or(usual.array),
            ..usual
        })
    }

    /// A frame of a scene, on that machine.
    fn frame(&self, scene: &Scene, machine: Machine, config: Config) -> Result<PixelFlowJob, Failure> {
        let (system, samples) = (self.system(), self.samples());
        if config.field.is_some() && samples == Samples::Eight(Shading::EachSample) && system.shades() {
            let sentence = "the base system cannot draw a --field with --samples 8: leave out one of them, \
                            add --shade-once, or pass --system non-texturing";
            return Err(Failure::new(Exit::BadInput, sentence));
        }
        let work = match system {
            System::Base | System::PreSorting => Work::Deferred(deferred(scene, samples)?),
            System::NonTexturing if samples == Samples::One => Work::Resident(polygons(scene)?, scene.background),
            System::NonTexturing => Work::Samples(passes(scene, samples)?, scene.background),
        };
        Ok(PixelFlowJob { machine, config, work })
    }

    fn system(&self) -> System {
        self.system.unwrap_or(System::Base)
    }

    fn samples(&self) -> Samples {
        match (self.samples.as_deref(), self.shade_once) {
            (Some("8"), false) => Samples::Eight(Shading::EachSample),
            (Some("8"), true) => Samples::Eight(Shading::OncePerPixel),
            _ => Samples::One,
        }
    }
}

/// A scene, and the machine for it.
pub struct PixelFlowJob {
    machine: Machine,
    config: Config,
    work: Work,
}

/// What is drawn, and by which system.
enum Work {
    Deferred(Deferred),
    /// With the background.
    Resident(Polygons, [u8; 3]),
    /// The two passes of eight samples, with the background.
    Samples(Vec<Projection>, [u8; 3]),
}

impl PixelFlowJob {
    /// A scene in the colours of vertices, on a machine whose arrays are large enough to have the whole screen in memory.
    ///
    /// # Errors
    /// The scene cannot be set up.
    pub fn in_memory(scene: &Scene) -> Result<PixelFlowJob, Failure> {
        let mut config = Config { shaders: 0, ..Config::new(scene.size) };
        while config.screen().map_err(tilewright_machines::Error::from)?.count() > Config::MOST_REGIONS {
            let [width, height] = config.array;
            config.array = if width > height { [width, 2 * height] } else { [2 * width, height] };
        }
        let work = Work::Resident(polygons(scene)?, scene.background);
        Ok(PixelFlowJob { machine: Machine::new(config.clone())?, config, work })
    }
}

impl Job for PixelFlowJob {
    type Report = Report;

    fn size(&self) -> Size {
        let size = self.config.size;
        self.config.field.and_then(|field| field.size(size).ok()).unwrap_or(size)
    }

    fn golden(&self) -> Result<Frame, Failure> {
        let frame = golden::draw(|watch| match &self.work {
            Work::Deferred(deferred) => render_deferred_watched(deferred, watch),
            Work::Resident(Polygons { size, polygons, .. }, background) => {
                render_watched(*size, polygons, *background, watch)
            }
            Work::Samples(passes, background) => render_samples_watched(passes, *background, watch),
        })?;
        match self.config.field {
            Some(field) => Ok(field.lines(&frame)?),
            None => Ok(frame),
        }
    }

    fn render(&self, run: &Run) -> Result<(Frame, Report), Failure> {
        if run.waveform.is_some() {
            let sentence = "each node of pixelflow is simulated separately, so a frame has no waveform: \
                            leave out --vcd, or use `tilewright wave pixelflow-node` for one node";
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
        let render = |watch: &mut tilewright_machines::Watch| match &self.work {
            Work::Deferred(deferred) => machine.render(deferred, watch),
            Work::Resident(polygons, background) => machine.render_resident(polygons, *background, watch),
            Work::Samples(passes, background) => machine.render_resident_samples(passes, *background, watch),
        };
        run.watch(render, |(_, report)| report.picoseconds())
    }
}

impl Compared for PixelFlowJob {
    fn figures(&self, report: &Report) -> Result<Figures, Failure> {
        let nodes = u64::from(report.nodes);
        let pixels = self.config.pixels().map_err(tilewright_machines::Error::from)?;
        let (array, port) = (state(&pixels)?, state(&pixels.network_port())?);
        let buffer = state(&report.frame_buffer)?;
        let bits = |of: fn(&tilewright_hdl::ir::State) -> u64| nodes * (of(&array) + 2 * of(&port)) + of(&buffer);
        // The array has one clock for two of the network.
        let clocks = report.latency() / 2;
        let busy: u64 = report.rasterizers.iter().chain(&report.shaders).map(|node| node.busy).sum();
        let [width, height] = report.array;
        let limit = report.limit();
        let drawn = match &self.work {
            Work::Resident(polygons, _) => fragments(polygons.size, &polygons.polygons),
            Work::Samples(passes, _) => passes.iter().map(|pass| fragments(pass.size, &pass.triangles)).sum(),
            Work::Deferred(deferred) => {
                let triangles = |pass: &tilewright_scenes::deferred::Pass| {
                    let triangles: Vec<_> = pass.packets.iter().map(|packet| packet.triangle.clone()).collect();
                    fragments(pass.size, &triangles)
                };
                deferred.passes.iter().map(triangles).sum()
            }
        };
        Ok(Figures {
            processors: report.nodes,
            processor: format!("nodes of {width}x{height}"),
            register_bits: bits(|it| it.registers),
            memory_bits: bits(|it| it.memories),
            clocks,
            picoseconds: report.latency() * PICOSECONDS,
            time:
                "from the start of the front end, which takes the paper's time, to the last region in the frame buffer"
                    .to_owned(),
            tested: report.drawn as u64 * u64::from(width) * u64::from(height),
            drawn,
            at_work: busy as f64 / (clocks.max(1) * nodes) as f64,
            limit: limit.name.to_owned(),
            limit_share: limit.busy as f64 / report.latency().max(1) as f64,
        })
    }
}

impl Viewed for PixelFlowJob {
    fn clock(&self, _: &Report) -> Clock {
        Clock { name: "the network".to_owned(), picoseconds: PICOSECONDS }
    }

    fn grid(&self) -> Option<Grid> {
        let [width, height] = self.config.array;
        Some(Grid { name: format!("regions of {width}x{height}"), size: [width, height] })
    }

    fn design(&self) -> Result<Option<Design>, Failure> {
        Ok(None)
    }
}
