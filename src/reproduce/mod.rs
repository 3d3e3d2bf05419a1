//! `tilewright reproduce`: the tables and figures of a paper, beside what was measured here.

mod quadtree;

use crate::shell::output::Folder;
use crate::shell::{Exit, Failure, interrupt, terminal};
use crate::watch::watched;
use clap::{Args, ValueEnum, value_parser};
use serde::Serialize;
use std::path::PathBuf;
use tilewright_report::Page;

/// Measures what a paper says of its machine, and writes a page with its figures, statements and verdicts
#[derive(Args)]
#[command(after_help = "\
Examples:
  tilewright reproduce quadtree -o report/ --polygons 20
  tilewright reproduce quadtree -o report/ --polygons 20 --seed 7 --json

Without --polygons there are as many as the figures need, for four minutes of processor time, which all cores share; with it the frames are
small, and the hardware runs for fewer points. The page, index.html, needs no other file and no network. Beside it is every figure as CSV, and all of it as report.json. The same
command writes the same bytes each time.")]
pub struct Reproduce {
    /// Whose paper
    machine: Paper,
    /// The folder for the report, which is made if it is not there; all files are written, or none
    #[arg(short, long, value_name = "FOLDER")]
    output: PathBuf,
    /// What the random polygons follow from
    #[arg(long, value_name = "NUMBER", default_value_t = 1)]
    seed: u64,
    /// At most so many random polygons of each area: a quick look, with wider scatter and small frames
    #[arg(long, value_name = "NUMBER", value_parser = value_parser!(u64).range(1..))]
    polygons: Option<u64>,
    /// Print the report as JSON
    #[arg(long)]
    json: bool,
}

/// The papers that can be reproduced.
#[derive(Clone, Copy, ValueEnum)]
enum Paper {
    /// The sparse-raster quadtree generator
    Quadtree,
}

/// How much is measured, and of what.
#[derive(Clone, Copy)]
struct Effort {
    seed: u64,
    /// The most polygons of an area.
    polygons: Option<u64>,
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
        Folder::check(&self.output)?;
        let folder = Folder::make(&self.output)?;
        let page = self.page()?;
        let files = page.files().expect("the parts of the page have names of their own");
        let written = folder.fill(files.iter().map(|file| (file.name.as_str(), file.bytes.as_slice())))?;

        let [holds, differs, cannot_be_compared] = page.count();
        match self.json {
            true => terminal::print_json(&Report { format: 1, holds, differs, cannot_be_compared, files: written })?,
            false => terminal::report(&format!(
                "{holds} statements hold, {differs} differ, {cannot_be_compared} cannot be compared\n"
            ))?,
        }
        Ok(Exit::Done)
    }

    fn page(&self) -> Result<Page, Failure> {
        let effort = Effort { seed: self.seed, polygons: self.polygons };
        let page = watched(|watch| match self.machine {
            Paper::Quadtree => quadtree::page(effort, watch),
        })?;
        page.ok_or_else(|| Failure::new(interrupt::exit(), "interrupted while the machine was measured"))
    }
}
