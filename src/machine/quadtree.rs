//! `--machine quadtree`.

use super::figures::{Compared, Figures, elaborated, state};
use super::first_given;
use super::job::{Job, Run};
use super::viewed::Viewed;
use crate::golden;
use crate::names::{self, Names};
use crate::number::number;
use crate::scene::polygons;
use crate::shell::Failure;
use clap::Args;
use clap::builder::PossibleValue;
use tilewright_hdl::Design;
use tilewright_machines::quadtree::{Config, Machine, Queues, Report, Stage, Test};
use tilewright_rtl::quadtree::format::Matrix;
use tilewright_scenes::golden::{render_strict_watched, render_watched};
use tilewright_scenes::{Frame, Polygons, Scene, Size};
use tilewright_view::{Clock, Grid};

/// Its options.
#[derive(Args, Default)]
#[command(next_help_heading = "Options of --machine quadtree")]
pub struct QuadtreeOptions {
    /// Columns and rows of video processors, each 1, 2, 4, 8 or 16 [default: 4x4]
    #[arg(long, value_name = "PxQ", value_parser = matrix)]
    matrix: Option<(u32, u32)>,
    /// What divides the windows: `stack`, `pipe` and `tree`, joined by +, each with its number of levels, as in stack:2+pipe:3+tree:1.
    /// One part may omit the number and then has the remaining levels [default: pipe]
    #[arg(long, value_name = "FORM", value_parser = form)]
    form: Option<String>,
    /// How the edges of a window are tested [default: parallel]
    #[arg(long, value_name = "TEST", value_parser = tests())]
    test: Option<Test>,
    /// Pixels by which a tested window is wider than its samples; even, 0 to 8 [default: 0]
    #[arg(long, value_name = "PIXELS")]
    aperture: Option<u32>,
    /// Size of the queue before the broadcast, in packets [default: 2]
    #[arg(long, value_name = "N", value_parser = number(1..=Queues::MOST))]
    broadcast_queue: Option<u32>,
    /// Size of the queue before each video processor, in packets [default: 4]
    #[arg(long, value_name = "N", value_parser = number(1..=Queues::MOST))]
    packet_queue: Option<u32>,
    /// Size of the queue before each unit of a pipe or tree, in windows [default: 2]
    #[arg(long, value_name = "N", value_parser = number(1..=Queues::MOST))]
    window_queue: Option<u32>,
}

/// The ways to test the edges of a window, by name.
fn tests() -> Names<Test> {
    let serial = PossibleValue::new("serial").help("One adder tests the edges one after another");
    let parallel = PossibleValue::new("parallel").help("An adder for each edge tests all of them at once");
    Names::described("test", [(serial, Test::Serial), (parallel, Test::Parallel)])
}

/// What divides the windows. Only the names of parts are checked; the machine checks which of them go together.
fn form(text: &str) -> Result<String, String> {
    const PARTS: [&str; 3] = ["stack", "pipe", "tree"];
    let parts = text.split('+').map(|part| part.split(':').next().unwrap_or(part));
    for part in parts {
        if !PARTS.contains(&part) {
            return Err(names::unknown(&format!("there is no part `{part}`"), part, &PARTS));
        }
    }
    Ok(text.to_owned())
}

/// A matrix such as `4x4`.
fn matrix(text: &str) -> Result<(u32, u32), String> {
    let sides = text.split_once('x').and_then(|(p, q)| Some((p.parse().ok()?, q.parse().ok()?)));
    let (p, q) = sides.ok_or("give the columns and rows of video processors, such as 4x4")?;
    Matrix::new(p, q).map(|_| (p, q)).map_err(|error| error.to_string())
}

impl QuadtreeOptions {
    /// The first of these options that is given, if any is.
    pub fn given(&self) -> Option<&'static str> {
        let QuadtreeOptions { matrix, form, test, broadcast_queue, packet_queue, window_queue, aperture } = self;
        first_given([
            ("--matrix", matrix.is_some()),
            ("--form", form.is_some()),
            ("--test", test.is_some()),
            ("--broadcast-queue", broadcast_queue.is_some()),
            ("--packet-queue", packet_queue.is_some()),
            ("--window-queue", window_queue.is_some()),
            ("--aperture", aperture.is_some()),
        ])
    }

    /// A scene for the machine.
    ///
    /// # Errors
    /// The scene cannot be set up, or there is no such machine.
    pub fn job(&self, scene: &Scene, strict: bool) -> Result<QuadtreeJob, Failure> {
        let scene_polygons = polygons(scene)?;
        let usual = Config::for_packets(scene_polygons.size, &scene_polygons.polygons);
        let config = Config {
            matrix: self.matrix.unwrap_or(usual.matrix),
            form: self.form.clone().unwrap_or(usual.form),
            test: self.test.unwrap_or(usual.test),
            queues: Queues {
                broadcast: self.broadcast_queue.unwrap_or(usual.queues.broadcast),
                packets: self.packet_queue.unwrap_or(usual.queues.packets),
                windows: self.window_queue.unwrap_or(usual.queues.windows),
            },
            aperture: self.aperture.unwrap_or(usual.aperture),
            strict,
            ..usual
        };
        config.generator().map_err(tilewright_machines::Error::from)?;
        Ok(QuadtreeJob { config, polygons: scene_polygons, background: scene.background })
    }
}

/// A scene in polygons, and the machine for it.
pub struct QuadtreeJob {
    config: Config,
    polygons: Polygons,
    background: [u8; 3],
}

impl Job for QuadtreeJob {
    type Report = Report;

    fn size(&self) -> Size {
        self.polygons.size
    }

    fn golden(&self) -> Result<Frame, Failure> {
        let Polygons { size, polygons, .. } = &self.polygons;
        golden::draw(|watch| match self.config.strict {
            true => render_strict_watched(*size, polygons, self.background, watch),
            false => render_watched(*size, polygons, self.background, watch),
        })
    }

    fn render(&self, run: &Run) -> Result<(Frame, Report), Failure> {
        let mut machine = Machine::new(self.config.clone())?.on(run.engine());
        if let Some(recorder) = run.recorder {
            machine = machine.recorded(recorder);
        }
        if let Some(follower) = run.follower {
            machine = machine.following(follower);
        }
        run.attach(machine.simulation())?;
        run.watch(
            |watch| machine.render(&self.polygons.polygons, self.background, watch),
            |(_, report)| report.phases.iter().map(|phase| phase.picoseconds).sum(),
        )
    }
}

impl Compared for QuadtreeJob {
    fn figures(&self, report: &Report) -> Result<Figures, Failure> {
        let hardware = state(&self.config.generator().map_err(tilewright_machines::Error::from)?)?;
        let drawing = report.phases.iter().find(|phase| phase.name == Report::DRAWING);
        let busiest = report.stages.iter().max_by(|left, right| left.load[1].total_cmp(&right.load[1]));
        let name = |stage: &Stage| match stage.level {
            0 => stage.unit.to_owned(),
            level => format!("level {level} of the {}", stage.unit),
        };
        let (p, q) = (report.machine.p, report.machine.q);
        Ok(Figures {
            processors: p * q,
            processor: "video processors".to_owned(),
            register_bits: hardware.registers,
            memory_bits: hardware.memories,
            clocks: report.drawing_clocks(),
            picoseconds: drawing.map_or(0, |phase| phase.picoseconds),
            time: "drawing alone; the packets are made outside of the machine".to_owned(),
            tested: report.stages.last().map_or(0, |stage| stage.tests.all),
            drawn: report.fragments,
            at_work: busiest.map_or(0.0, |stage| stage.load[0]),
            limit: busiest.map_or_else(String::new, name),
            limit_share: busiest.map_or(0.0, |stage| stage.load[1]),
        })
    }
}

impl Viewed for QuadtreeJob {
    fn clock(&self, report: &Report) -> Clock {
        let drawing = report.phases.iter().find(|phase| phase.name == Report::DRAWING);
        let picoseconds = drawing.map_or(0, |phase| phase.picoseconds) / report.drawing_clocks().max(1);
        Clock { name: "the generator".to_owned(), picoseconds: picoseconds.max(1) }
    }

    fn grid(&self) -> Option<Grid> {
        let (p, q) = self.config.matrix;
        Some(Grid { name: format!("a pixel of each processor, {p}x{q}"), size: [p, q] })
    }

    fn design(&self) -> Result<Option<Design>, Failure> {
        elaborated(&self.config.generator().map_err(tilewright_machines::Error::from)?).map(Some)
    }
}
