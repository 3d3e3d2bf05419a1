//! `tilewright golden`: the software rasterizer's image of a scene, which every machine has to match.

use crate::scene::{SceneArguments, triangles};
use crate::shell::output::Output;
use crate::shell::place::check_distinct;
use crate::shell::{Exit, Failure, Progress, interrupt, terminal};
use clap::Args;
use serde::Serialize;
use std::ops::ControlFlow;
use std::path::PathBuf;
use tilewright_scenes::{Frame, golden};

/// Renders a scene with the plain software rasterizer: the golden image
#[derive(Args)]
#[command(after_help = "\
Examples:
  tilewright golden teapot -o golden.png
  tilewright golden teapot --quiet -o - > golden.png
  tilewright golden wireframe -o lines.png
  tilewright golden ter1k --size 320x240 -o small.png --json")]
pub struct Golden {
    #[command(flatten)]
    scene: SceneArguments,
    /// The picture, a PNG file; `-` is standard output
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Print the report as JSON
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct Report {
    format: u32,
    scene: String,
    size: [u32; 2],
    /// With the lines.
    polygons: u32,
    lines: u32,
    packets: usize,
    /// Of all words, depth and colour; 16 hexadecimal digits.
    checksum: String,
}

impl Golden {
    /// Writes the picture and reports.
    pub fn run(self) -> Result<Exit, Failure> {
        let scene = self.scene.load()?;
        let projection = triangles(&scene)?;
        check_distinct(&[&self.output], &Vec::from_iter(scene.files.iter().map(PathBuf::as_path)))?;
        let output = Output::at(&self.output)?;
        let frame =
            draw(|watch| golden::render_watched(projection.size, &projection.triangles, scene.background, watch))?;
        output.write(&frame.to_png())?;
        let report = Report {
            format: 1,
            scene: scene.name,
            size: [frame.size().width(), frame.size().height()],
            polygons: projection.counts.polygons,
            lines: projection.counts.lines,
            packets: projection.triangles.len(),
            checksum: format!("{:016x}", frame.checksum()),
        };
        if self.json {
            terminal::print_json(&report)?;
        } else {
            let Report { scene, packets, checksum, .. } = report;
            let (polygons, size) = (projection.counts.of_each_kind(), projection.size);
            terminal::report(&format!("{scene}: {polygons}, {packets} packets, {size} pixels, checksum {checksum}\n"))?;
        }
        Ok(Exit::Done)
    }
}

/// The software rasterizer's frame, as `render` makes it: it is given what to tell of its progress, which may break it off.
///
/// # Errors
/// Ctrl-C.
pub fn draw(render: impl FnOnce(&mut dyn FnMut(f64) -> ControlFlow<()>) -> Option<Frame>) -> Result<Frame, Failure> {
    let progress = Progress::new();
    let frame = render(&mut |drawn| {
        progress.show("golden image", drawn);
        interrupt::go_on()
    });
    frame.ok_or_else(|| Failure::new(interrupt::exit(), "interrupted while the golden image was drawn"))
}
