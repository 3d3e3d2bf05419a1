//! `tilewright golden`: the software rasterizer's image of a scene, which every machine has to match.

use crate::scene::SceneArguments;
use crate::shell::{Exit, Failure, output};
use clap::Args;
use serde::Serialize;
use std::path::PathBuf;
use tilewright_scenes::golden;

/// Renders a scene with the plain software rasterizer: the golden image
#[derive(Args)]
#[command(after_help = "\
Examples:
  tilewright golden teapot -o golden.png
  tilewright golden ter1k --size 320x240 -o small.png --json")]
pub struct Golden {
    #[command(flatten)]
    scene: SceneArguments,
    /// The picture, a PNG file
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
    polygons: u32,
    packets: usize,
    /// Of all words, depth and colour; 16 hexadecimal digits.
    checksum: String,
}

impl Golden {
    /// Writes the picture and reports.
    pub fn run(self) -> Result<Exit, Failure> {
        output::check_place(&self.output)?;
        output::check_distinct(&[&self.output], &Vec::from_iter(self.scene.file()))?;
        let (scene, projection) = self.scene.load()?;
        let frame = golden::render(projection.size, &projection.triangles, scene.background);
        output::write_file(&self.output, &frame.to_png())?;
        let report = Report {
            format: 1,
            scene: scene.name,
            size: [frame.size().width(), frame.size().height()],
            polygons: projection.counts.polygons,
            packets: projection.triangles.len(),
            checksum: format!("{:016x}", frame.checksum()),
        };
        if self.json {
            output::print_json(&report)?;
        } else {
            let Report { scene, polygons, packets, checksum, .. } = report;
            let size = projection.size;
            output::print(&format!(
                "{scene}: {polygons} polygons, {packets} packets, {size} pixels, checksum {checksum}\n"
            ))?;
        }
        Ok(Exit::Done)
    }
}
