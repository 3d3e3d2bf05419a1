//! `tilewright diagram`: the block diagram of a block, as a picture, as a graph or in characters.

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
  tilewright diagram patch-table --around stage1 -o stage1.svg
  tilewright diagram image-merger --set units=8 --ascii

Boxes are instances (stacked, with their count, where they are an array), memories, registers and ports. An arrow leads through any logic from what
a value comes from to what takes it: thick for streams, dashed where it only decides something. Where there would be too many, arrows of control are
left out, and registers that belong together are one box; the key below says so. In a browser the full names show where the mouse rests.")]
pub struct Diagram {
    #[command(flatten)]
    block: BlockArguments,
    /// The picture, an .svg file, or the graph for Graphviz, a .dot file; `-` is standard output, for the picture
    #[arg(short, long, value_name = "FILE", value_parser = PathBufValueParser::new().try_map(drawing))]
    output: Option<PathBuf>,
    /// Print the diagram in characters
    #[arg(long, conflicts_with = "json")]
    ascii: bool,
    /// How many levels are shown: 1 is the block alone, 2 opens its instances, and so on
    #[arg(long, value_name = "N", default_value = "1", value_parser = number(1..=MOST_LEVELS))]
    depth: u32,
    /// Only what leads to this port, register, memory, instance or named net, and what it leads to; one of an opened instance is `u_merger.count`
    #[arg(long, value_name = "NET")]
    around: Option<String>,
    /// How many arrows are followed from the net of --around, in both directions
    #[arg(long, value_name = "N", default_value = "1", requires = "around", value_parser = number(1..=MOST_LEVELS))]
    steps: u32,
    /// Print the report as JSON
    #[arg(long)]
    json: bool,
}

/// The most levels, and the most steps; no block has as many.
const MOST_LEVELS: u32 = 100;

#[derive(Serialize)]
struct Report<'a> {
    format: u32,
    block: &'a str,
    parameters: BTreeMap<&'a str, u64>,
    boxes: usize,
    arrows: usize,
    /// Arrows of control that are left out.
    hidden: usize,
    files: Vec<String>,
}

impl Diagram {
    /// Draws it, and reports.
    pub fn run(self) -> Result<Exit, Failure> {
        if self.output.is_none() && !self.ascii {
            let sentence = "there is nowhere to draw: name a file with -o FILE.svg, or pass --ascii for text";
            return Err(Failure::new(Exit::BadInput, sentence));
        }
        let (entry, values) = self.block.find()?;
        let output = self.output.as_deref().map(Output::at).transpose()?;
        let design = entry.design(&values)?;
        let around = self.around.map(|net| Around { net, steps: self.steps });
        let drawn = diagram(&design, &DiagramOptions { depth: self.depth, around })?;
        if let (Some(output), Some(path)) = (output, &self.output) {
            let text = if is_graph(path) { drawn.dot() } else { drawn.svg() };
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

/// The name of a file that can be drawn; devices and pipes take pictures.
fn drawing(path: PathBuf) -> Result<PathBuf, &'static str> {
    match path.extension().and_then(|it| it.to_str()) {
        Some("svg" | "dot") | None => Ok(path),
        Some(_) => Err("name a picture, as block.svg, or a graph, as block.dot"),
    }
}
