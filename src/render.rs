//! `tilewright render`: a frame drawn by a machine's hardware, a report of its clocks, and a comparison with the golden image.

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

--owners, --timeline and --animate show what was observed on the running machine. The owner of a pixel, and the time at which it appears, are
  vc1              the processing element with the least word that a local frame buffer took for it; when that was taken
  quadtree         the video processor that has it in its buffer; when the buffer took it
  pixel-planes-5   the renderer of its region, which has a darker left and upper border; when the last instruction of its primitive had ended
  pixelflow        the node whose word won the composition, in most of the samples; when the frame buffer took it
Images of an animation are equally spaced in the machine's time from the first pixel to the last one. The last image stays longer.

Exit code 1 means that the frame differs from the golden image, or that with --engine both the engines differ. The report names the first pixel that differs.
Beside the frame, a picture such as frame.difference.png shows the differences. An identical frame removes such a picture of an earlier run.
If the picture cannot be written, a warning says so, and the exit code is still 1.")]
pub struct Render {
    #[command(flatten)]
    scene: SceneArguments,
    /// The machine; options for each machine are listed below
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
    /// Write the waveform of the run to a VCD file (`-`: standard output), or to an FST file if the name ends in .fst. A whole frame takes about a gigabyte as VCD unless it is filtered
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
        let run = Run { waveform: waveform.as_ref(), recorder, ..Run::new(self.engine, &self.filters) };
        progress::phase("building");
        let (frame, report) = job.render(&run)?;
        progress::phase("comparing");
        let verdict = golden.judge(&frame);
        let title = format!("{} on {}: what each unit did over time", scene.name, self.machine.name());
        let mut files: Vec<(Output, Vec<u8>)> = output.map(|output| (output, frame.to_png())).into_iter().collect();
        files.extend(pictures.made(&title, &frame));
        write_all(files)?;
        if let Some(path) = &self.output {
            leave_difference(path, verdict.picture.as_ref());
        }
        self.tell(scene, &report, &verdict, verdict.identical)
    }

    /// Prints the report and the result of the comparison.
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
                // A failure is reported in any case.
                if identical { terminal::report(&text)? } else { terminal::print(&legible(&text))? }
            }
        }
        Ok(if identical { Exit::Done } else { Exit::CheckFailed })
    }

    /// Checks that no file, frames included, is written twice, or both read and written.
    fn check_distinct(&self, frames: &[PathBuf], scene: &Scene) -> Result<(), Failure> {
        let differences: Vec<PathBuf> = frames.iter().filter_map(|path| beside(path, DIFFERENCE)).collect();
        let written = frames.iter().chain(&differences).chain(&self.vcd).map(PathBuf::as_path);
        let written = written.chain(self.pictures.paths());
        let read = scene.files.iter().chain(&self.golden).map(PathBuf::as_path);
        check_distinct(&Vec::from_iter(written), &Vec::from_iter(read))
    }
}
