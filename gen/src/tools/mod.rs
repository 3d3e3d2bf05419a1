//! Runs the programs that check printed Verilog: four linters, two simulators, and Yosys's replay of a dump. [`cells`]
//! and [`place`] tell what a design takes of an FPGA, and how fast it is there. [`Simulator`] gives the waveform of a
//! testbench. [`Compiler`] builds a fast simulator from it, for comparisons of speed.
//!
//! The checks are meant for tests, of this crate and of others. If a program is missing, a check prints
//! `skipped: NAME is not installed` and counts as skipped. With the environment variable `CI` set it fails instead,
//! so that no pipeline passes without its checks.

mod binary;
mod device;
mod dump;
mod linters;
mod model;
mod placement;
mod replay;
mod run;
mod synthesis;
mod watched;

pub use binary::verilated;
pub use device::Device;
pub use dump::{Dump, DumpError, Simulator};
pub use linters::{lint, lint_all, lint_quickly};
pub use model::{Compiler, Model, Source};
pub use placement::{Frequency, Placed, place};
pub use replay::{replay_in_icarus, replay_in_verilator, yosys_replay_vcd};
pub use run::{is_installed, skipped, skipped_without, sources};
pub use synthesis::{Target, cells};
pub use watched::run_watched;

pub use crate::verilog::{WITH_COVERS, WITH_MODELS};

use std::fmt;

/// The outcome of a check that found no fault.
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = elaborate(&tilewright_sim::for_examples::Delay).unwrap();
/// use tilewright_gen::tools::{Checked, skipped_without};
///
/// // A user's own check, which needs two programs.
/// fn drawn() -> Checked {
///     if let Some(skipped) = skipped_without(&["yosys", "dot"]) {
///         return skipped;
///     }
///     Checked::Passed
/// }
/// let is_installed = ["yosys", "dot"].iter().all(|program| skipped_without(&[program]).is_none());
/// assert_eq!(drawn() == Checked::Passed, is_installed);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[must_use]
pub enum Checked {
    /// It ran.
    Passed,
    /// The program is not installed.
    Skipped,
}

/// The linters that checked the files.
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = elaborate(&tilewright_sim::for_examples::Delay).unwrap();
/// use tilewright_gen::tools::lint_quickly;
///
/// let files = tilewright_gen::verilog(&design);
/// let linted = lint_quickly(&[&files]).unwrap();
/// assert!(linted.ran.contains(&"pyslang") != linted.skipped.contains(&"pyslang"));
/// ```
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Linted {
    /// Those that ran without complaints.
    pub ran: Vec<&'static str>,
    /// Those that are not installed.
    pub skipped: Vec<&'static str>,
}

/// A program that is not installed.
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = elaborate(&tilewright_sim::for_examples::Delay).unwrap();
/// let missing = tilewright_gen::tools::Missing { program: "yosys", remedy: "apt-get install yosys" };
/// assert_eq!(missing.to_string(), "yosys is not installed: apt-get install yosys");
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Missing {
    /// Its name.
    pub program: &'static str,
    /// How to get it.
    pub remedy: &'static str,
}

impl fmt::Display for Missing {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{} is not installed: {}", self.program, self.remedy)
    }
}

impl std::error::Error for Missing {}

/// The complaints of the programs.
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = elaborate(&tilewright_sim::for_examples::Delay).unwrap();
/// use tilewright_gen::tools::{Problem, Problems};
///
/// let problems = Problems(vec![Problem { tool: "iverilog".to_owned(), output: "delay.v:3: syntax error\n".to_owned() }]);
/// assert_eq!(problems.to_string(), "iverilog says:\ndelay.v:3: syntax error\n");
/// ```
#[derive(Clone, PartialEq, Eq)]
pub struct Problems(pub Vec<Problem>);

/// The complaint of one program.
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = elaborate(&tilewright_sim::for_examples::Delay).unwrap();
/// use tilewright_gen::{VerilogFile, tools::lint_quickly};
///
/// let broken = VerilogFile { name: "broken.v".to_owned(), text: "module broken (input wire a;\nendmodule\n".to_owned() };
/// if let Err(wrong) = lint_quickly(&[&[broken]]) {
///     assert!(wrong[&0].0.iter().any(|problem| problem.output.contains("broken.v"))); // of design 0
/// }
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Problem {
    /// The program, such as `verilator 5.006`.
    pub tool: String,
    /// Its output.
    pub output: String,
}

impl fmt::Display for Problems {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        self.0.iter().try_for_each(|problem| writeln!(f, "{} says:\n{}", problem.tool, problem.output.trim_end()))
    }
}

/// Like [`Display`](fmt::Display), so that a failed `unwrap` in a test is readable.
impl fmt::Debug for Problems {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "\n{self}")
    }
}

impl std::error::Error for Problems {}
