//! `tilewright explain`: a block after each pass of the simulator.

use crate::block::{blocks, check_memories, design, setting, values};
use crate::names::Names;
use crate::shell::{Exit, Failure, progress, terminal};
use clap::builder::{PossibleValue, TypedValueParser};
use clap::{Arg, Args, Command, Error};
use serde::Serialize;
use std::ffi::OsStr;
use tilewright_benches::Subject;
use tilewright_hdl::Design;
use tilewright_hdl::catalog::Entry;
use tilewright_sim::{Pass, Passes, explain};

/// Shows a block after each pass of the simulator
#[derive(Args)]
#[command(after_help = "\
Examples:
  tilewright explain scan-counter --pass fold
  tilewright explain image-merger --set units=8 --pass lift
  tilewright explain patch-table --pass lower --pass plan --json
  tilewright explain core1 --pass strips

A line shows a value: its name or number, its lanes, its width in bits, how it is computed, and the source line that describes it.
Each pass works on the result of the passes before it, except that lower and what follows begin from edge, not from hold.")]
pub struct Explain {
    /// Name of a block, which `tilewright list blocks` shows, or of a design of `tilewright bench`, such as core1
    #[arg(value_name = "BLOCK", value_parser = Circuits(blocks()), hide_possible_values = true)]
    circuit: Circuit,
    /// Value of a parameter; may be repeated. `tilewright list BLOCK` shows names and ranges
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = setting)]
    settings: Vec<(String, u64)>,
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

/// What is explained.
#[derive(Clone)]
enum Circuit {
    Block(&'static Entry),
    Bench(Subject),
}

impl Circuit {
    /// The circuit with these parameters.
    fn design(&self, settings: &[(String, u64)]) -> Result<Design, Failure> {
        match self {
            Circuit::Block(entry) => design(entry, &values(entry, settings)?),
            Circuit::Bench(subject) if settings.is_empty() => {
                Ok(subject.design().map_err(tilewright_sim::Error::from)?)
            }
            Circuit::Bench(subject) => {
                let sentence = format!("{subject} has no parameters but the numbers of its name: leave out --set");
                Err(Failure::new(Exit::BadInput, sentence))
            }
        }
    }
}

/// The parser of its name.
#[derive(Clone)]
struct Circuits(Names<&'static Entry>);

impl TypedValueParser for Circuits {
    type Value = Circuit;

    fn parse_ref(&self, command: &Command, argument: Option<&Arg>, given: &OsStr) -> Result<Circuit, Error> {
        match given.to_str().and_then(|given| given.parse().ok()) {
            Some(subject) => Ok(Circuit::Bench(subject)),
            None => self.0.parse_ref(command, argument, given).map(Circuit::Block),
        }
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        self.0.possible_values()
    }
}

/// The parser of a pass's name.
fn passes() -> Names<Pass> {
    Names::new("pass", Pass::ALL.map(|pass| (pass.name(), pass)))
}

impl Explain {
    /// Prints what the passes leave.
    pub fn run(self) -> Result<Exit, Failure> {
        let design = self.circuit.design(&self.settings)?;
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
