//! The way of a pixel through a machine.

use super::text::{Told, json, text};
use crate::engine::EngineArguments;
use crate::machine::{Followed, Job, Machine, MachineArguments, Run, follow};
use crate::names;
use crate::scene::{load, size};
use crate::shell::output::Waveform;
use crate::shell::place::check_distinct;
use crate::shell::text::legible;
use crate::shell::{Exit, Failure, progress, terminal};
use crate::trace::TraceOptions;
use crate::viewer::{self, Viewer, waveform};
use clap::Args;
use clap::builder::{PathBufValueParser, TypedValueParser};
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use tilewright_machines::{Step, Way};
use tilewright_scenes::{Scene, Size};

/// Clocks of the waveform on each side of the step.
const CLOCKS: u64 = 20;

/// The options for a scene alone.
#[derive(Args)]
#[command(next_help_heading = "Options for a scene")]
pub struct SceneOptions {
    /// Column and row of the pixel, from the upper left corner, such as 396,189
    #[arg(long, value_name = "X,Y", value_parser = place, conflicts_with_all = ["at", "clock"])]
    pub pixel: Option<[u32; 2]>,
    /// The machine; options for each machine are listed below
    #[arg(long, value_enum, value_parser = names::of::<Machine>("machine"), conflicts_with = "signal")]
    machine: Option<Machine>,
    /// Size of the frame in pixels [default: what the scene asks for]
    #[arg(long, value_name = "WxH", value_parser = size, conflicts_with = "signal")]
    size: Option<Size>,
    /// The waveform around the first difference: an FST file if the name ends in .fst, and else a VCD file; `-` is standard output
    #[arg(short, long, value_name = "FILE", value_parser = PathBufValueParser::new().try_map(waveform), conflicts_with = "signal")]
    output: Option<PathBuf>,
    #[command(flatten)]
    options: MachineArguments,
}

/// A pixel such as `396,189`.
fn place(text: &str) -> Result<[u32; 2], String> {
    let place = text.split_once(',').and_then(|(x, y)| Some([x.parse().ok()?, y.parse().ok()?]));
    place.ok_or_else(|| "give two whole numbers of pixels, from the left and from the top, such as 396,189".to_owned())
}

impl SceneOptions {
    fn machine(&self) -> Machine {
        self.machine.unwrap_or(Machine::Vc1)
    }

    /// Refuses the options of machines, for a block.
    ///
    /// # Errors
    /// One is given.
    pub fn refuse(&self) -> Result<(), Failure> {
        let Some(option) = self.options.given() else { return Ok(()) };
        let sentence = format!("{option} is an option for a scene, and --signal asks about a block: leave it out");
        Err(Failure::new(Exit::BadInput, sentence))
    }

    /// Renders the scene of that name, and tells the way of the pixel, as text or as JSON.
    pub fn run(&self, name: &OsStr, pixel: [u32; 2], json: bool) -> Result<Exit, Failure> {
        let machine = self.machine();
        self.options.check(machine)?;
        if let Some(option) = self.options.several(machine) {
            let sentence = format!("{option} makes several frames, and a pixel is followed in one: leave it out");
            return Err(Failure::new(Exit::BadInput, sentence));
        }
        let beside = self.output.as_deref().map_or_else(Vec::new, viewer::files);
        let scene = load(name, self.size)?;
        let written: Vec<&Path> =
            self.output.iter().chain(beside.iter().map(|(_, file)| file)).map(PathBuf::as_path).collect();
        check_distinct(&written, &scene.files.iter().map(PathBuf::as_path).collect::<Vec<_>>())?;
        let asked = Asked { scene: &scene, machine, pixel, json, output: self.output.as_deref(), beside };
        let strict = self.options.order.strict;
        match machine {
            Machine::Vc1 => asked.answer(&self.options.vc1.job(&scene)?),
            Machine::Quadtree => asked.answer(&self.options.quadtree.job(&scene, strict)?),
            Machine::PixelPlanes => asked.answer(&self.options.pixel_planes.job(&scene, strict)?),
            Machine::PixelFlow => asked.answer(&self.options.pixelflow.job(&scene)?),
        }
    }
}

/// A pixel of a scene on a machine.
struct Asked<'a> {
    scene: &'a Scene,
    machine: Machine,
    pixel: [u32; 2],
    json: bool,
    output: Option<&'a Path>,
    /// The viewers' files beside the waveform.
    beside: Vec<(Viewer, PathBuf)>,
}

impl Asked<'_> {
    fn answer(&self, job: &impl Job) -> Result<Exit, Failure> {
        let (size, [x, y], machine) = (job.size(), self.pixel, self.machine.name());
        let bad = |sentence: String| Err(Failure::new(Exit::BadInput, sentence));
        if self.output.is_some() && matches!(self.machine, Machine::PixelPlanes | Machine::PixelFlow) {
            return bad(format!(
                "each unit of {machine} is simulated separately, so a frame has no waveform: leave out -o"
            ));
        }
        if x >= size.width() || y >= size.height() {
            let (right, bottom) = (size.width() - 1, size.height() - 1);
            return bad(format!(
                "pixel {x},{y} is outside of a picture of {size}: give one from 0,0 to {right},{bottom}"
            ));
        }
        let waveform = self.output.map(Waveform::at).transpose()?;
        let Followed { golden, frame, way, failed } = follow(job, self.pixel, None)?;
        let told = Told {
            scene: &self.scene.name,
            machine,
            size,
            pixel: self.pixel,
            shown: frame.map(|frame| frame.word(x, y)),
            golden: golden.word(x, y),
            way: &way,
        };
        let commands = waveform.map_or(Ok(Vec::new()), |waveform| self.write_wave(job, &waveform, &way))?;
        if self.json {
            terminal::print_json(&json(&told, &commands))?;
        } else {
            terminal::print(&legible(&text(&told)))?;
            commands.iter().try_for_each(|line| terminal::report(&format!("{line}\n")))?;
        }
        told.end(failed)
    }

    /// Renders again and writes the waveform around a step, and the files of viewers beside it. Returns the commands that open them.
    fn write_wave(&self, job: &impl Job, waveform: &Waveform, way: &Way) -> Result<Vec<String>, Failure> {
        let Some(step) = way.first_difference().or_else(|| last(way)) else { return Ok(Vec::new()) };
        let around = CLOCKS * (step.time / step.cycle.max(1));
        let times = step.time.saturating_sub(around)..step.time + around;
        let filters = TraceOptions::of(scopes(step), times.clone());
        let prepare = |(viewer, file): &(Viewer, PathBuf)| {
            Ok(viewer.prepare(file)?.map(|output| (*viewer, file.clone(), output)))
        };
        let prepared: Vec<_> = self.beside.iter().map(prepare).collect::<Result<_, Failure>>()?;
        let run = Run { waveform: Some(waveform), ..Run::new(EngineArguments::default(), &filters) };
        progress::phase("building");
        // The run fails as the first one did, and the waveform is there.
        let rendered = job.render(&run).map(|_| ());
        let is_written = Failure::leaves_a_waveform(&rendered);
        if let Err(failure) = rendered
            && !is_written
        {
            return Err(failure);
        }
        let Some(path) = self.output else { return Ok(Vec::new()) };
        let header = run.header.take();
        let written = prepared.into_iter().flatten().map(|(viewer, file, output)| {
            output.write(viewer.text(path, &header, times.clone(), true).as_bytes())?;
            Ok(viewer.command(path, &file))
        });
        written.collect()
    }
}

/// The last step of the visible primitive, or of any.
fn last(way: &Way) -> Option<&Step> {
    let winner = way.primitives.iter().find(|it| it.wins).map(|it| it.number);
    let of_winner = way.steps.iter().rfind(|step| winner.is_some() && step.primitive == winner);
    of_winner.or(way.steps.last())
}

/// The signals of the step's unit, and those of the top.
fn scopes(step: &Step) -> Vec<String> {
    let unit = step.net.as_deref().and_then(|net| net.rsplit_once('.')).map(|(unit, _)| format!("{unit}.**"));
    unit.map_or_else(Vec::new, |unit| vec![unit, "*".to_owned()])
}
