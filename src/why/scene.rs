//! The way of a pixel through a machine.

use super::text::{Told, json, text};
use crate::engine::EngineArguments;
use crate::machine::{
    Followed, Job, Machine, MachineArguments, Run, check_pixel, follow, render_traced, signals_of, times_around,
    unit_and_name,
};
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
use serde_json::Value;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use tilewright_machines::{Apart, Step, Tracer, Way};
use tilewright_scenes::{Frame, Scene, Size};

/// The options for a scene alone.
#[derive(Args)]
#[command(next_help_heading = "Options for a scene")]
pub struct SceneOptions {
    /// Column and row of the pixel, from the upper left corner, such as 396,189; may be repeated
    #[arg(id = "pixel", long, value_name = "X,Y", value_parser = place, conflicts_with_all = ["at", "clock"])]
    pub pixels: Vec<[u32; 2]>,
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

    /// Renders the scene of that name, and tells the way of each pixel, as text or as JSON.
    pub fn run(&self, name: &OsStr, json: bool) -> Result<Exit, Failure> {
        let machine = self.machine();
        self.options.check(machine)?;
        if let Some(option) = self.options.several(machine) {
            let sentence = format!("{option} makes several frames, and a pixel is followed in one: leave it out");
            return Err(Failure::new(Exit::BadInput, sentence));
        }
        if self.output.is_some() && self.pixels.len() > 1 {
            let sentence = "-o writes the waveform around a step of one pixel, and there are several: leave out -o, or give one --pixel";
            return Err(Failure::new(Exit::BadInput, sentence));
        }
        let beside = self.output.as_deref().map_or_else(Vec::new, viewer::files);
        let scene = load(name, self.size)?;
        let written: Vec<&Path> =
            self.output.iter().chain(beside.iter().map(|(_, file)| file)).map(PathBuf::as_path).collect();
        check_distinct(&written, &scene.files.iter().map(PathBuf::as_path).collect::<Vec<_>>())?;
        let (pixels, output) = (&self.pixels[..], self.output.as_deref());
        let asked = Asked { scene: &scene, machine, pixels, json, output, beside };
        let strict = self.options.order.strict;
        match machine {
            Machine::Vc1 => asked.answer(&self.options.vc1.job(&scene)?),
            Machine::Quadtree => asked.answer(&self.options.quadtree.job(&scene, strict)?),
            Machine::PixelPlanes => asked.answer(&self.options.pixel_planes.job(&scene, strict)?),
            Machine::PixelFlow => asked.answer(&self.options.pixelflow.job(&scene)?),
        }
    }
}

/// Pixels of a scene on a machine.
struct Asked<'a> {
    scene: &'a Scene,
    machine: Machine,
    pixels: &'a [[u32; 2]],
    json: bool,
    output: Option<&'a Path>,
    /// The viewers' files beside the waveform.
    beside: Vec<(Viewer, PathBuf)>,
}

impl Asked<'_> {
    /// Tells the way of each pixel, one after another.
    fn answer(&self, job: &impl Job) -> Result<Exit, Failure> {
        self.pixels.iter().try_for_each(|pixel| check_pixel(job.size(), *pixel))?;
        let waveform = self.output.map(Waveform::at).transpose()?;
        let golden = job.golden()?;
        let (mut answers, mut ends) = (Vec::new(), Vec::new());
        for (number, pixel) in self.pixels.iter().enumerate() {
            if number > 0 && !self.json {
                terminal::print("\n")?;
            }
            let (answer, end) = self.tell(job, *pixel, &golden, waveform.as_ref())?;
            answers.extend(answer);
            ends.push(end);
        }
        match &answers[..] {
            [] => {}
            [answer] => terminal::print_json(answer)?,
            _ => terminal::print_json(&serde_json::json!({ "format": 1, "pixels": answers }))?,
        }
        let ends: Vec<Exit> = ends.into_iter().collect::<Result<_, Failure>>()?;
        Ok(ends.into_iter().find(|end| *end != Exit::Done).unwrap_or(Exit::Done))
    }

    /// Tells the way of a pixel as text, or returns it as JSON; and how that ends.
    fn tell(
        &self,
        job: &impl Job,
        pixel: [u32; 2],
        golden: &Frame,
        waveform: Option<&Waveform>,
    ) -> Result<(Option<Value>, Result<Exit, Failure>), Failure> {
        let [x, y] = pixel;
        let Followed { frame, way, failed } = follow(job, pixel, None)?;
        let told = Told {
            scene: &self.scene.name,
            machine: self.machine.name(),
            size: job.size(),
            pixel,
            shown: frame.map(|frame| frame.word(x, y)),
            golden: golden.word(x, y),
            way: &way,
        };
        let waved = waveform.map(|waveform| self.write_wave(job, waveform, pixel, &way)).transpose()?;
        let Waved { commands, apart } = waved.unwrap_or_default();
        let answer = self.json.then(|| json(&told, &commands));
        if answer.is_none() {
            terminal::print(&legible(&text(&told)))?;
            commands.iter().try_for_each(|line| terminal::report(&format!("{line}\n")))?;
        }
        if let Some(Apart { unit, time }) = apart {
            terminal::talk(&format!("the waveform is of {unit} by itself, and has the step at {time} ps"));
        }
        Ok((answer, told.end(failed)))
    }

    /// Renders again and writes the waveform around a step, and the files of viewers beside it.
    fn write_wave(&self, job: &impl Job, waveform: &Waveform, pixel: [u32; 2], way: &Way) -> Result<Waved, Failure> {
        let Some(step) = deciding(way) else { return Ok(Waved::default()) };
        let times = times_around(step);
        let filters = TraceOptions::of(scopes(step), times.clone());
        let prepare = |(viewer, file): &(Viewer, PathBuf)| {
            Ok(viewer.prepare(file)?.map(|output| (*viewer, file.clone(), output)))
        };
        let prepared: Vec<_> = self.beside.iter().map(prepare).collect::<Result<_, Failure>>()?;
        progress::phase("building");
        let header = match &step.apart {
            Some(apart) => trace_apart(job, waveform, pixel, (apart, &filters))?,
            None => trace(job, waveform, &filters)?,
        };
        let Some(path) = self.output else { return Ok(Waved::default()) };
        let written = prepared.into_iter().flatten().map(|(viewer, file, output)| {
            output.write(viewer.text(path, &header, times.clone(), true).as_bytes())?;
            Ok(viewer.command(path, &file))
        });
        Ok(Waved { commands: written.collect::<Result<_, Failure>>()?, apart: step.apart.clone() })
    }
}

/// What there is to say of a waveform.
#[derive(Default)]
struct Waved {
    /// The commands that open it.
    commands: Vec<String>,
    /// The step in a unit that is simulated by itself.
    apart: Option<Apart>,
}

/// The waveform of a unit that is simulated by itself. Returns its header.
fn trace_apart(
    job: &impl Job,
    waveform: &Waveform,
    pixel: [u32; 2],
    (apart, filters): (&Apart, &TraceOptions),
) -> Result<Vec<u8>, Failure> {
    waveform.clear()?;
    let tracer = Tracer::new(apart, filters.trace(waveform)?);
    ended(render_traced(job, &tracer, pixel, None))?;
    waveform.tell_written();
    Ok(tracer.header())
}

/// The waveform of a machine that is simulated as a whole. Returns its header.
fn trace(job: &impl Job, waveform: &Waveform, filters: &TraceOptions) -> Result<Vec<u8>, Failure> {
    let run = Run { waveform: Some(waveform), ..Run::new(EngineArguments::default(), filters) };
    ended(job.render(&run))?;
    Ok(run.header.take())
}

/// Whether a run has a waveform: it fails as the first one did, and the waveform is there.
fn ended<T>(rendered: Result<T, Failure>) -> Result<(), Failure> {
    let rendered = rendered.map(|_| ());
    if Failure::leaves_a_waveform(&rendered) { Ok(()) } else { rendered }
}

/// The step that the waveform is about: the first difference, or else the last step of the visible primitive.
fn deciding(way: &Way) -> Option<&Step> {
    // What no unit did has no waveform, if units are simulated one by one.
    let are_apart = way.steps.iter().any(|step| step.apart.is_some());
    let has_wave = |step: &&Step| step.apart.is_some() || !are_apart;
    way.first_difference().filter(has_wave).or_else(|| last(way, has_wave))
}

/// The last such step of the visible primitive, or of any.
fn last(way: &Way, which: impl Fn(&&Step) -> bool) -> Option<&Step> {
    let winner = way.primitives.iter().find(|it| it.wins).map(|it| it.number);
    let of_winner = |step: &&Step| winner.is_some() && step.primitive == winner && which(step);
    way.steps.iter().rfind(of_winner).or_else(|| way.steps.iter().rfind(|step| which(step)))
}

/// The signals of the step's unit, and those of the top, unless that is a unit with as many lanes as pixels.
fn scopes(step: &Step) -> Vec<String> {
    let unit = unit_and_name(step).map(|(unit, _)| unit).unwrap_or_default();
    match (unit.is_empty(), step.apart.is_some()) {
        (true, false) => Vec::new(),
        (true, true) => vec![signals_of(&[])],
        (false, true) => vec![signals_of(&unit)],
        (false, false) => vec![signals_of(&unit), signals_of(&[])],
    }
}
