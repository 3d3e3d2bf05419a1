//! The constraints beside the Verilog of a block: their dialect, and the user's file of pins.

use crate::names;
use crate::shell::place::shown;
use crate::shell::{Exit, Failure};
use clap::{Args, ValueEnum};
use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use tilewright_gen::{Dialect, PinProblem, PinProblems, Pins, VerilogFile, constraints};
use tilewright_hdl::Design;

/// The options about constraints.
#[derive(Args)]
pub struct ConstraintOptions {
    /// Write constraints as well: the periods of the clocks, the limits of paths between clocks, and pins
    #[arg(long, value_name = "DIALECT", value_parser = names::of::<Language>("dialect of constraints"))]
    constraints: Option<Language>,
    /// File with the pin of each port, a row for each bit, such as `clk G2 LVCMOS33` or `led[0] B2 pull-up DRIVE=4`
    #[arg(long, value_name = "FILE", requires = "constraints")]
    pins: Option<PathBuf>,
}

/// A dialect by its name on the command line.
#[derive(Clone, Copy, ValueEnum)]
enum Language {
    /// For most timing analysers, without pins
    Sdc,
    /// For Vivado
    Xdc,
    /// For an ECP5
    Lpf,
    /// For an iCE40
    Pcf,
}

impl From<Language> for Dialect {
    fn from(language: Language) -> Dialect {
        match language {
            Language::Sdc => Dialect::Sdc,
            Language::Xdc => Dialect::Xdc,
            Language::Lpf => Dialect::Lpf,
            Language::Pcf => Dialect::Pcf,
        }
    }
}

/// The most bytes that a file of pins may have: 1 MiB.
const MOST_BYTES: u64 = 1 << 20;

impl ConstraintOptions {
    /// The pins of the user's file; none without one.
    ///
    /// # Errors
    /// The file cannot be read, or a row is malformed.
    pub fn pins(&self) -> Result<Pins, Failure> {
        let Some(path) = &self.pins else { return Ok(Pins::none()) };
        let text = read(path).map_err(|error| {
            // Without the number that the system has for it.
            let why = error.to_string();
            let why = why.split(" (os error").next().unwrap_or_default();
            let sentence = format!("{}: {why}: name a text file with a row for each port", shown(path));
            Failure::new(Exit::BadInput, sentence)
        })?;
        Pins::read(&text).map_err(|wrong| wrong_pins(path, wrong))
    }

    /// The file of constraints, if it is wanted.
    ///
    /// # Errors
    /// The pins do not fit the design or the dialect.
    pub fn print(&self, design: &Design, pins: &Pins) -> Result<Option<VerilogFile>, Failure> {
        let Some(language) = self.constraints else { return Ok(None) };
        let path = self.pins.as_deref().unwrap_or(Path::new(""));
        constraints(design, language.into(), pins).map(Some).map_err(|wrong| wrong_pins(path, wrong))
    }
}

/// A text of at most [`MOST_BYTES`].
fn read(path: &Path) -> io::Result<String> {
    let mut text = String::new();
    File::open(path)?.take(MOST_BYTES + 1).read_to_string(&mut text)?;
    match text.len() as u64 > MOST_BYTES {
        true => Err(io::Error::other("it is larger than 1 MiB")),
        false => Ok(text),
    }
}

/// A sentence for each problem, with the file and the line.
fn wrong_pins(path: &Path, PinProblems(problems): PinProblems) -> Failure {
    let failure = |PinProblem { line, message }: PinProblem| {
        let line = line.map(|line| format!(":{line}")).unwrap_or_default();
        Failure::new(Exit::BadInput, format!("{}{line}: {message}", shown(path)))
    };
    Failure::all(problems.into_iter().map(failure)).expect("there is a problem")
}
