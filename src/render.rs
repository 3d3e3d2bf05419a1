//! `tilewright render`: a frame from a machine's hardware, its cycle report, and the comparison with the golden image.

mod frames;

use crate::engine::EngineArguments;
use crate::machine::{Job, Machine, MachineArguments, Run};
use crate::names;
use crate::pictures::PictureOptions;
use crate::scene::SceneArguments;
use crate::shell::output::{Output, Waveform, write_all};
use crate::shell::place::{beside, check_distinct};
use crate::shell::text::legible;
use crate::shell::{Exit, Failure, progress, terminal};
use crate::trace::{TraceOptions, WAVEFORM};
use crate::verdict::{DIFFERENCE, Golden, leave_difference};
use clap::Args;
use serde::Serialize;
use std::fmt::Display;
use std::path::PathBuf;
use tilewright_scenes::Scene;

/// Renders a scene on a machine, clock by clock, and compares the frame with the golden image
#[derive(Args)]
#[command(after_help = "\
Examples:
  tilewright render teapot --machine vc1 -o frame.png
  tilewright render teapot --processors 4 --size 160x120 --json
  tilewright render teapot --size 96x72 --frames 4 -o turn.png
  tilewright render star --machine quadtree --size 64x48
  tilewright render teapot --machine quadtree --size 32x24 --matrix 8x8 --form pipe:1+stack --test serial
  tilewright render star --machine pixel-planes-5 --size 64x48 --renderers 2 --region 16
  tilewright render molecule --machine pixel-planes-5 --size 160x120 --region 32
  tilewright render star --machine pixelflow --size 64x48 --nodes 4 --shaders 1 --array 32x16
  tilewright render star --machine pixelflow --size 64x48 --nodes 8 --shaders 2 --array 32x16 --stereo halved
  tilewright render teapot --size 64x48 --processors 2 --vcd run.vcd --scope 'u_gfb.*' --from 10us --to 20us
  tilewright render teapot --size 64x48 --owners owners.png --timeline time.svg
  tilewright render star --machine pixel-planes-5 --size 64x48 --region 16 --animate frame.png

--owners, --timeline and --animate are drawn from what is seen of the machine. A pixel is of the processing element whose word was the least that a local frame buffer took; of the video processor
whose buffer has it; of the renderer that has its region, which is darker along its left and upper border; or of the node whose word won the composition, in most samples. It
comes when a local frame buffer or a video buffer took it, when the last instruction of its primitive had ended, or when the frame buffer took it. Images of an animation are equally
spaced in the machine's time from the first pixel to the last one, and the last one stays longer.

Exit code 1 means that the frame differs from the golden image, or that with --engine both the engines differ. The report names the first pixel that does, and beside the frame
stands a picture of the differences, such as frame.difference.png; an identical frame removes one that an earlier run left there.
If that picture cannot be written, a warning says so and the exit code stays 1.")]
pub struct Render {
    #[command(flatten)]
    scene: SceneArguments,
    /// The machine; the options of each are below
    #[arg(long, value_enum, value_parser = names::of::<Machine>("machine"), default_value_t = Machine::Vc1)]
    machine: Machine,
    /// The frame, a PNG file; `-` is standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Print the report as JSON
    #[arg(long)]
    json: bool,
    /// Compare the colours with this picture instead of the software rasterizer's frame
    #[arg(long, value_name = "FILE")]
    golden: Option<PathBuf>,
    #[command(flatten)]
    engine: EngineArguments,
    /// Write the waveform of the run, a VCD file (`-`: standard output); that of a whole frame takes about a gigabyte unless it is filtered
    #[arg(long, value_name = "FILE", help_heading = WAVEFORM)]
    vcd: Option<PathBuf>,
    #[command(flatten)]
    filters: TraceOptions,
    #[command(flatten)]
    pictures: PictureOptions,
    #[command(flatten)]
    options: MachineArguments,
}

#[derive(Serialize)]
struct Report<'a, R, V> {
    format: u32,
    scene: &'a str,
    machine: &'static str,
    report: &'a R,
    golden: &'a V,
}

impl Render {
    /// Renders, compares, writes the files and reports.
    pub fn run(self) -> Result<Exit, Failure> {
        self.filters.check(self.vcd.as_deref(), "--vcd")?;
        self.options.check(self.machine)?;
        self.pictures.check(self.options.several(self.machine))?;
        let scene = self.scene.load()?;
        match self.machine {
            Machine::Vc1 => match self.options.vc1.turn(&scene)? {
                Some(turn) => self.render_turn(&scene, &turn),
                None => self.render(&scene, &self.options.vc1.job(&scene)?),
            },
            Machine::Quadtree => self.render(&scene, &self.options.quadtree.job(&scene, self.options.order.strict)?),
            Machine::PixelPlanes => {
                self.render(&scene, &self.options.pixel_planes.job(&scene, self.options.order.strict)?)
            }
            Machine::PixelFlow => match self.options.pixelflow.stereo_job(&scene)? {
                Some(job) => self.render(&scene, &job),
                None => self.render(&scene, &self.options.pixelflow.job(&scene)?),
            },
        }
    }

    fn render(&self, scene: &Scene, job: &impl Job) -> Result<Exit, Failure> {
        self.check_distinct(self.output.as_slice(), scene)?;
        let output = self.output.as_deref().map(Output::at).transpose()?;
        let waveform = self.vcd.as_deref().map(Waveform::at).transpose()?;
        let pictures = self.pictures.open()?;
        let golden = Golden::new(self.golden.as_deref(), job.size(), || job.golden())?;
        let recorder = pictures.recorder();
        let run = Run { engine: self.engine, filters: &self.filters, waveform: waveform.as_ref(), recorder };
        progress::phase("building");
        let (frame, report) = job.render(&run)?;
        progress::phase("comparing");
        let verdict = golden.judge(&frame);
        let title = format!("{} on {}: what each unit did when", scene.name, self.machine.name());
        let mut files: Vec<(Output, Vec<u8>)> = output.map(|output| (output, frame.to_png())).into_iter().collect();
        files.extend(pictures.made(&title, &frame));
        write_all(files)?;
        if let Some(path) = &self.output {
            leave_difference(path, verdict.picture.as_ref());
        }
        self.tell(scene, &report, &verdict, verdict.identical)
    }

    /// Prints what the run took and what the comparison gave.
    fn tell<R, V>(&self, scene: &Scene, report: &R, golden: &V, identical: bool) -> Result<Exit, Failure>
    where
        R: Serialize + Display,
        V: Serialize + Display,
    {
        match self.json {
            true => terminal::print_json(&Report {
                format: 1,
                scene: &scene.name,
                machine: self.machine.name(),
                report,
                golden,
            })?,
            false => {
                let text = format!("{}: {report}\n\n{golden}\n", scene.name);
                // Of a failure there is a report in any case.
                if identical { terminal::report(&text)? } else { terminal::print(&legible(&text))? }
            }
        }
        Ok(if identical { Exit::Done } else { Exit::CheckFailed })
    }

    /// That no file which is written, frames among them, is another one, or one that is read.
    fn check_distinct(&self, frames: &[PathBuf], scene: &Scene) -> Result<(), Failure> {
        let differences: Vec<PathBuf> = frames.iter().filter_map(|path| beside(path, DIFFERENCE)).collect();
        let written = frames.iter().chain(&differences).chain(&self.vcd).map(PathBuf::as_path);
        let written = written.chain(self.pictures.paths());
        let read = scene.files.iter().chain(&self.golden).map(PathBuf::as_path);
        check_distinct(&Vec::from_iter(written), &Vec::from_iter(read))
    }
}
