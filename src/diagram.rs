//! `tilewright diagram`: the block diagram of a block, as a picture, a graph or text.

use crate::block::BlockArguments;
use crate::number::number;
use crate::shell::output::Output;
use crate::shell::place::shown;
use crate::shell::{Exit, Failure, terminal};
use clap::Args;
use clap::builder::{PathBufValueParser, TypedValueParser};
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use tilewright_gen::{Around, DiagramError, DiagramOptions, diagram};

/// Draws the block diagram of a block
#[derive(Args)]
#[command(after_help = "\
Examples:
  tilewright diagram merging-unit -o merging-unit.svg
  tilewright diagram vc1 --depth 2 -o vc1.dot
  tilewright diagram pixelflow --depth 3 --narrow -o pixelflow.svg
  tilewright diagram patch-table --around stage1 -o stage1.svg
  tilewright diagram image-merger --set units=8 --ascii

Boxes are ports, instances, memories and registers. An array is a stack with its count. An arrow is a path through logic: thick for a stream,
dashed for control, which selects or enables. A large diagram leaves out control and draws related registers as one box. Its key says how many
arrows are missing. A browser shows full names under the mouse.")]
pub struct Diagram {
    #[command(flatten)]
    block: BlockArguments,
    /// The picture (.svg) or the graph for Graphviz (.dot); `-` prints the picture on standard output
    #[arg(short, long, value_name = "FILE", value_parser = PathBufValueParser::new().try_map(drawing))]
    output: Option<PathBuf>,
    /// Draw all boxes below one another, for a narrow page or a deep diagram
    #[arg(long, requires = "output")]
    narrow: bool,
    /// Print the diagram in characters
    #[arg(long, conflicts_with = "json")]
    ascii: bool,
    /// Levels of instances to show: 1 is the block alone, 2 opens its instances, and so on
    #[arg(long, value_name = "N", default_value = "1", value_parser = number(1..=MOST_LEVELS))]
    depth: u32,
    /// Show only what feeds this port, register, memory, instance or named net, and what it feeds. In an opened instance a name is written `u_merger.count`
    #[arg(long, value_name = "NET")]
    around: Option<String>,
    /// Arrows to follow from the net of --around, forwards and backwards
    #[arg(long, value_name = "N", default_value = "1", requires = "around", value_parser = number(1..=MOST_LEVELS))]
    steps: u32,
    /// Print the report as JSON
    #[arg(long)]
    json: bool,
}

/// The most levels and steps; no block has that many.
const MOST_LEVELS: u32 = 100;

#[derive(Serialize)]
struct Report<'a> {
    format: u32,
    block: &'a str,
    parameters: BTreeMap<&'a str, u64>,
    boxes: usize,
    arrows: usize,
    /// Control arrows that are left out.
    hidden: usize,
    files: Vec<String>,
}

impl Diagram {
    /// Draws it, and reports.
    pub fn run(self) -> Result<Exit, Failure> {
        if self.output.is_none() && !self.ascii {
            let sentence = "there is no output: name a file with -o FILE.svg, or pass --ascii for text";
            return Err(Failure::new(Exit::BadInput, sentence));
        }
        if let Some(path) = self.output.as_deref().filter(|path| self.narrow && is_graph(path)) {
            let sentence = format!(
                "{}: Graphviz decides on the places in a graph: name a picture, as block.svg, or leave out --narrow",
                path.display()
            );
            return Err(Failure::new(Exit::BadInput, sentence));
        }
        let (entry, values) = self.block.find()?;
        let output = self.output.as_deref().map(Output::at).transpose()?;
        let design = entry.design(&values)?;
        let around = self.around.map(|net| Around { net, steps: self.steps });
        let drawn = diagram(&design, &DiagramOptions { depth: self.depth, around })?;
        if let (Some(output), Some(path)) = (output, &self.output) {
            let text = match is_graph(path) {
                true => drawn.dot(),
                false if self.narrow => drawn.narrow_svg(),
                false => drawn.svg(),
            };
            output.write(text.as_bytes())?;
        }
        if self.ascii {
            terminal::print(&drawn.ascii())?;
        }
        if self.json {
            terminal::print_json(&Report {
                format: 1,
                block: entry.name,
                parameters: values.iter().collect(),
                boxes: drawn.boxes.len(),
                arrows: drawn.arrows.len(),
                hidden: drawn.hidden,
                files: self.output.iter().map(|path| shown(path)).collect(),
            })?;
        }
        Ok(Exit::Done)
    }
}

impl From<DiagramError> for Failure {
    fn from(error: DiagramError) -> Failure {
        Failure::new(Exit::BadInput, error.to_string())
    }
}

fn is_graph(path: &Path) -> bool {
    path.extension().is_some_and(|it| it == "dot")
}

/// A file name with a known extension. Devices and pipes have none and take pictures.
fn drawing(path: PathBuf) -> Result<PathBuf, &'static str> {
    match path.extension().and_then(|it| it.to_str()) {
        Some("svg" | "dot") | None => Ok(path),
        Some(_) => Err("name a picture, as block.svg, or a graph, as block.dot"),
    }
}
