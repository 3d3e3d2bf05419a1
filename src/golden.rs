//! `tilewright golden`: the software rasterizer's image of a scene, which every machine has to match.

use crate::scene::{self, SceneArguments};
use crate::shell::output::Output;
use crate::shell::place::check_distinct;
use crate::shell::{Exit, Failure, Progress, interrupt, progress, terminal};
use clap::Args;
use serde::Serialize;
use std::ops::ControlFlow;
use std::path::PathBuf;
use tilewright_scenes::deferred::{Deferred, Samples, Shading};
use tilewright_scenes::golden::Rule;
use tilewright_scenes::{Counts, Frame, Polygons, Projection, Scene, golden};

/// Renders a scene with the plain software rasterizer: the golden image
#[derive(Args)]
#[command(after_help = "\
Examples:
  tilewright golden teapot -o golden.png
  tilewright golden teapot --quiet -o - > golden.png
  tilewright golden wireframe -o lines.png
  tilewright golden ter1k --size 320x240 -o small.png --json
  tilewright golden molecule -o spheres.png
  tilewright golden textured --deferred --samples 8 -o textures.png")]
pub struct Golden {
    #[command(flatten)]
    scene: SceneArguments,
    /// The picture, a PNG file; `-` is standard output
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Light each pixel by itself, with textures and highlights, instead of the corners of triangles
    #[arg(long)]
    deferred: bool,
    /// Samples per pixel
    #[arg(long, value_name = "N", default_value = "1", value_parser = ["1", "8"])]
    samples: String,
    /// Shade once what the samples of a pixel have in common, instead of each sample
    #[arg(long, requires = "deferred")]
    shade_once: bool,
    /// Print the report as JSON
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct Report {
    format: u32,
    scene: String,
    size: [u32; 2],
    /// Lines and spheres included.
    polygons: u32,
    lines: u32,
    spheres: u32,
    /// In one pass; eight samples take two.
    packets: usize,
    /// The checksum of all words, depth and colour: 16 hexadecimal digits. Frames of deferred shading or of several samples have the greatest depth everywhere.
    checksum: String,
    #[serde(flatten)]
    style: Option<Style>,
}

/// How the frame differs from other machines' frames.
#[derive(Serialize)]
struct Style {
    deferred: bool,
    samples: u32,
    shaded_once: bool,
}

impl Style {
    /// The text behind the number of pixels.
    fn text(&self) -> String {
        let samples = if self.samples == 8 { " of 8 samples" } else { "" };
        let shading = match (self.deferred, self.shaded_once) {
            (false, _) => "",
            (true, false) => ", deferred shading",
            (true, true) => ", deferred shading once per pixel",
        };
        format!("{samples}{shading}")
    }
}

/// The scene as it is drawn.
enum Picture {
    /// In one pass, or in two for eight samples.
    Gouraud(Vec<Projection>),
    /// In one pass, with spheres.
    Spheres(Polygons),
    Deferred(Deferred),
}

impl Golden {
    /// Writes the picture and reports.
    pub fn run(self) -> Result<Exit, Failure> {
        let scene = self.scene.load()?;
        let picture = self.picture(&scene)?;
        check_distinct(&[&self.output], &Vec::from_iter(scene.files.iter().map(PathBuf::as_path)))?;
        let output = Output::at(&self.output)?;
        let frame = picture.draw(scene.background)?;
        progress::phase("writing");
        output.write(&frame.to_png())?;
        let counts = picture.counts();
        let report = Report {
            format: 1,
            scene: scene.name,
            size: [frame.size().width(), frame.size().height()],
            polygons: counts.polygons,
            lines: counts.lines,
            spheres: counts.spheres,
            packets: picture.packets(),
            checksum: format!("{:016x}", frame.checksum()),
            style: self.style(),
        };
        if self.json {
            terminal::print_json(&report)?;
        } else {
            let Report { scene, packets, checksum, style, .. } = report;
            let (polygons, size) = (counts.of_each_kind(), frame.size());
            let style = style.map_or_else(String::new, |style| style.text());
            terminal::report(&format!(
                "{scene}: {polygons}, {packets} packets, {size} pixels{style}, checksum {checksum}\n"
            ))?;
        }
        Ok(Exit::Done)
    }

    fn picture(&self, scene: &Scene) -> Result<Picture, Failure> {
        if self.shade_once && self.samples != "8" {
            let sentence = "--shade-once needs several samples per pixel: add --samples 8";
            return Err(Failure::new(Exit::BadInput, sentence));
        }
        if !scene.spheres.is_empty() {
            if self.deferred || self.samples == "8" {
                let sentence = "the scene has spheres, which are drawn without deferred shading and with one sample per pixel: \
                                leave out --deferred and --samples";
                return Err(Failure::new(Exit::BadInput, sentence));
            }
            return Ok(Picture::Spheres(scene::polygons_and_spheres(scene)?));
        }
        let shading = if self.shade_once { Shading::OncePerPixel } else { Shading::EachSample };
        let samples = if self.samples == "8" { Samples::Eight(shading) } else { Samples::One };
        Ok(match self.deferred {
            true => Picture::Deferred(scene::deferred(scene, samples)?),
            false => Picture::Gouraud(scene::samples(scene, samples)?),
        })
    }

    fn style(&self) -> Option<Style> {
        let samples = if self.samples == "8" { 8 } else { 1 };
        let style = Style { deferred: self.deferred, samples, shaded_once: self.shade_once };
        (self.deferred || samples > 1).then_some(style)
    }
}

impl Picture {
    fn draw(&self, background: [u8; 3]) -> Result<Frame, Failure> {
        match self {
            Picture::Gouraud(passes) => draw(|watch| golden::render_samples_watched(passes, background, watch)),
            Picture::Spheres(polygons) => {
                draw(|watch| golden::render_polygons_watched(polygons, Rule::Least, background, watch))
            }
            Picture::Deferred(deferred) => draw(|watch| golden::render_deferred_watched(deferred, watch)),
        }
    }

    /// Of the first pass.
    fn packets(&self) -> usize {
        match self {
            Picture::Gouraud(passes) => passes[0].triangles.len(),
            Picture::Spheres(polygons) => polygons.polygons.len() + polygons.spheres.len(),
            Picture::Deferred(deferred) => deferred.passes[0].packets.len(),
        }
    }

    /// Of the first pass.
    fn counts(&self) -> Counts {
        match self {
            Picture::Gouraud(passes) => passes[0].counts,
            Picture::Spheres(polygons) => polygons.counts,
            Picture::Deferred(deferred) => deferred.counts,
        }
    }
}

/// The software rasterizer's frame, which `render` draws. `render` reports its progress to the function that it is given, and stops if that says so.
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
