//! `tilewright reproduce`: the tables and figures of a paper, beside what was measured here.

mod all;
mod effort;
mod pixel_planes;
mod pixelflow;
mod quadtree;
mod right;
mod vc1;
mod words;

use crate::names;
use crate::shell::output::Folder;
use crate::shell::{Exit, Failure, interrupt, progress, terminal};
use crate::watch::watched;
use clap::{Args, ValueEnum, value_parser};
use effort::Effort;
use serde::Serialize;
use std::path::PathBuf;
use tilewright_report::{File, Link, Page};

/// Measures what a paper states about its machine, and writes a page with figures, statements and verdicts
#[derive(Args)]
#[command(after_help = "\
Examples:
  tilewright reproduce quadtree -o report/ --polygons 20
  tilewright reproduce quadtree -o report/ --polygons 20 --seed 7 --json
  tilewright reproduce pixel-planes-5 -o report/ --vectors 20
  tilewright reproduce pixelflow -o report/ --primitives 20000
  tilewright reproduce vc1 -o report/ --views 2
  tilewright reproduce all -o report/ --polygons 20

`all` writes the pages of all papers, each in a folder of that name. A page above them compares all machines on the same scenes, as `compare` does.
Without --polygons, --vectors, --primitives or --views, the page has all points that its figures need. That takes some minutes of processor time, which all cores share.
With one of these options the page is a quick look: frames are small, and the hardware runs for fewer points.
The page, index.html, needs no other file and no network. Each figure is also written as CSV and SVG, and the whole report as report.json.
The same command writes the same bytes each time.")]
pub struct Reproduce {
    /// The machine of the paper, or `all`
    #[arg(value_parser = names::of::<Paper>("paper"))]
    machine: Paper,
    /// Folder for the report, created if missing; either all files are written, or none
    #[arg(short, long, value_name = "FOLDER")]
    output: PathBuf,
    /// Seed of the random polygons, vectors or primitives
    #[arg(long, value_name = "NUMBER", default_value_t = 1)]
    seed: u64,
    /// For quadtree: a quick look with at most this number of random polygons for each area, wider scatter and small frames.
    /// For all: also at most this number of vectors, a thousand times as many primitives, and a tenth as many views
    #[arg(long, value_name = "NUMBER", value_parser = value_parser!(u64).range(1..))]
    polygons: Option<u64>,
    /// For pixel-planes-5: a quick look with at most this number of random vectors of each kind
    #[arg(long, value_name = "NUMBER", value_parser = value_parser!(u64).range(1..), conflicts_with = "polygons")]
    vectors: Option<u64>,
    /// For pixelflow: a quick look with at most this number of primitives in a frame, which may not reach the compared latencies
    #[arg(long, value_name = "NUMBER", value_parser = value_parser!(u64).range(1..), conflicts_with_all = ["polygons", "vectors"])]
    primitives: Option<u64>,
    /// For vc1: a quick look on a small screen, with few processing elements and at most this number of views of Table 1's scene, up to 48
    #[arg(long, value_name = "NUMBER", value_parser = value_parser!(u64).range(1..), conflicts_with_all = ["polygons", "vectors", "primitives"])]
    views: Option<u64>,
    /// Print the report as JSON
    #[arg(long)]
    json: bool,
}

/// The papers.
#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Paper {
    /// The sparse-raster quadtree generator
    Quadtree,
    /// The renderers of Pixel-planes 5
    #[value(name = "pixel-planes-5")]
    PixelPlanes,
    /// The three software systems of PixelFlow
    #[value(name = "pixelflow")]
    PixelFlow,
    /// The virtual local frame buffers of the VC-1
    Vc1,
    /// All of them, and a page that compares all machines
    All,
}

impl Paper {
    /// The limit of this paper's quick look among those of all papers, which is given in polygons.
    fn most_beside(self, polygons: u64) -> u64 {
        match self {
            Paper::PixelFlow => polygons.saturating_mul(1000),
            Paper::Vc1 => polygons.div_ceil(10),
            _ => polygons,
        }
    }
}

#[derive(Serialize)]
struct Report {
    format: u32,
    /// Statements of the paper that hold, differ, and cannot be compared.
    holds: usize,
    differs: usize,
    cannot_be_compared: usize,
    files: Vec<String>,
}

impl Reproduce {
    /// Measures, and writes the page and its data.
    pub fn run(self) -> Result<Exit, Failure> {
        let effort = self.effort()?;
        Folder::check(&self.output)?;
        let inner = if self.machine == Paper::All { PAPERS.map(|(_, name)| name).to_vec() } else { Vec::new() };
        let folder = Folder::make_with(&self.output, &inner)?;
        let pages = self.pages(effort)?;
        progress::phase("writing");
        let files: Vec<File> = pages.iter().flat_map(|(prefix, page)| files(prefix, page)).collect();
        let written = folder.fill(files.iter().map(|file| (file.name.as_str(), file.bytes.as_slice())))?;

        let [holds, differs, cannot_be_compared] = pages.iter().fold([0; 3], |sum, (_, page)| {
            let count = page.count();
            std::array::from_fn(|of| sum[of] + count[of])
        });
        match self.json {
            true => terminal::print_json(&Report { format: 1, holds, differs, cannot_be_compared, files: written })?,
            false => terminal::report(&format!(
                "{holds} statements hold, {differs} differ, {cannot_be_compared} cannot be compared\n"
            ))?,
        }
        Ok(Exit::Done)
    }

    /// The pages, each with the prefix of its files' names.
    fn pages(&self, effort: Effort) -> Result<Vec<(String, Page)>, Failure> {
        if self.machine != Paper::All {
            return Ok(vec![(String::new(), page(self.machine, effort)?)]);
        }
        let papers = PAPERS.into_iter().map(|(paper, name)| {
            let most = effort.most.map(|most| paper.most_beside(most));
            Ok((format!("{name}/"), page(paper, Effort { most, ..effort })?))
        });
        let mut pages = papers.collect::<Result<Vec<_>, Failure>>()?;
        let links = pages.iter().map(|(prefix, page)| {
            let [holds, differs, unknown] = page.count();
            let note = format!("{holds} statements hold, {differs} differ, {unknown} cannot be compared.");
            Link::new(format!("{prefix}index.html"), page.title(), note)
        });
        let first = all::page(effort, links.collect())?;
        pages.insert(0, (String::new(), first));
        Ok(pages)
    }

    /// How much to measure.
    fn effort(&self) -> Result<Effort, Failure> {
        let options = [
            (Paper::Quadtree, "--polygons", self.polygons),
            (Paper::PixelPlanes, "--vectors", self.vectors),
            (Paper::PixelFlow, "--primitives", self.primitives),
            (Paper::Vc1, "--views", self.views),
        ];
        let asked = if self.machine == Paper::All { Paper::Quadtree } else { self.machine };
        let (own, others): (Vec<_>, Vec<_>) = options.into_iter().partition(|(paper, ..)| *paper == asked);
        let (_, option, most) = own[0];
        match others.iter().find(|(.., most)| most.is_some()) {
            None => Ok(Effort { seed: self.seed, most }),
            Some((_, other, _)) => {
                let sentence =
                    format!("{other} is an option of another paper: for a quick look at this one give {option}");
                Err(Failure::new(Exit::BadInput, sentence))
            }
        }
    }
}

/// The papers with a page of their own, and the folders of these pages in that of all.
const PAPERS: [(Paper, &str); 4] = [
    (Paper::Quadtree, "quadtree"),
    (Paper::PixelPlanes, "pixel-planes-5"),
    (Paper::PixelFlow, "pixelflow"),
    (Paper::Vc1, "vc1"),
];

/// The files of a page, with a prefix before their names.
fn files(prefix: &str, page: &Page) -> Vec<File> {
    let files = page.files().expect("the parts of the page have names of their own");
    files.into_iter().map(|file| File { name: format!("{prefix}{}", file.name), ..file }).collect()
}

/// The page of one paper.
fn page(paper: Paper, effort: Effort) -> Result<Page, Failure> {
    let page = watched(interrupt::flag(), |watch| match paper {
        Paper::Quadtree => quadtree::page(effort, watch),
        Paper::PixelPlanes => pixel_planes::page(effort, watch),
        Paper::PixelFlow => pixelflow::page(effort, watch),
        Paper::Vc1 => vc1::page(effort, watch),
        Paper::All => unreachable!("that of all papers is made of several"),
    })?;
    page.ok_or_else(|| Failure::new(interrupt::exit(), "interrupted while the machine was measured"))
}
