//! `tilewright list`: what can be rendered, run and printed.

mod block;
mod items;
mod overview;
mod shown;

use crate::names::Names;
use crate::shell::{Exit, Failure, terminal};
use clap::Args;
use items::Lists;
use shown::Shown;

/// Lists scenes, machines, blocks, designs of bench and passes of explain, or describes one of them in full
#[derive(Args)]
#[command(after_help = "\
Examples:
  tilewright list
  tilewright list blocks
  tilewright list merging-unit
  tilewright list quadtree
  tilewright list --json

Without a name the list has one line for each thing. The name of a block shows its ports, parameters, latency, source and scenario; the name of a
machine, its options. `scenes`, `files`, `machines`, `blocks`, `designs` and `passes` are the parts of the list, and `all` describes everything in full.")]
pub struct List {
    /// What to describe: a block, a machine, a scene, a part of the list, or `all`
    #[arg(value_name = "NAME", value_parser = names(), hide_possible_values = true)]
    name: Option<Shown>,
    /// Print the full descriptions as JSON
    #[arg(long)]
    json: bool,
}

/// The parser of the name.
fn names() -> Names<Shown> {
    Names::new("block, machine, scene or part of the list", Shown::all()).listed_by("tilewright list")
}

impl List {
    /// Prints the lists.
    pub fn run(self) -> Result<Exit, Failure> {
        let shown = self.name.unwrap_or(Shown::Overview);
        if self.json {
            terminal::print_json(&Lists::of(shown)?)?;
        } else if let Some(part) = shown.part() {
            terminal::print(&overview::text(part))?;
        } else {
            terminal::print(&Lists::of(shown)?.to_string())?;
        }
        Ok(Exit::Done)
    }
}
