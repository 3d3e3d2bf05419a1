//! `tilewright explain`: a block after each pass of the simulator.

use crate::block::{BlockArguments, check_memories, design};
use crate::names::Names;
use crate::shell::{Exit, Failure, progress, terminal};
use clap::Args;
use serde::Serialize;
use tilewright_sim::{Pass, Passes, explain};

/// Shows a block after each pass of the simulator
#[derive(Args)]
#[command(after_help = "\
Examples:
  tilewright explain scan-counter --pass fold
  tilewright explain image-merger --set units=8 --pass lift
  tilewright explain patch-table --pass lower --pass plan --json

A line shows a value: its name or number, its lanes, its width in bits, how it is computed, and the source line that describes it.
Each pass works on the result of the passes before it.")]
pub struct Explain {
    #[command(flatten)]
    block: BlockArguments,
    /// Show the block after this pass only; may be repeated [default: all passes]
    #[arg(long = "pass", value_name = "NAME", value_parser = passes())]
    passes: Vec<Pass>,
    /// Print the report as JSON
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct Report {
    format: u32,
    passes: Vec<Shown>,
}

#[derive(Serialize)]
struct Shown {
    pass: &'static str,
    about: &'static str,
    text: String,
}

/// The parser of a pass's name.
fn passes() -> Names<Pass> {
    Names::new("pass", Pass::ALL.map(|pass| (pass.name(), pass)))
}

impl Explain {
    /// Prints what the passes leave.
    pub fn run(self) -> Result<Exit, Failure> {
        let (entry, values) = self.block.find()?;
        let design = design(entry, &values)?;
        check_memories(&design)?;
        progress::phase("explaining");
        let wanted = |pass: Pass| self.passes.is_empty() || self.passes.contains(&pass);
        let explained = explain(&design, &Passes::default()).into_iter().filter(|it| wanted(it.pass));
        let shown =
            |it: tilewright_sim::Explained| Shown { pass: it.pass.name(), about: it.pass.about(), text: it.text };
        let passes: Vec<Shown> = explained.map(shown).collect();
        match self.json {
            true => terminal::print_json(&Report { format: 1, passes })?,
            false => {
                let sections = passes.iter().map(|it| format!("# {}: {}\n\n{}", it.pass, it.about, it.text));
                terminal::print(&sections.collect::<Vec<_>>().join("\n"))?;
            }
        }
        Ok(Exit::Done)
    }
}
