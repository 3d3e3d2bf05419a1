//! The other run: a simulator of Verilog, an engine, or a file.

use super::run::Run;
use crate::first_difference::Waves;
use crate::names::near;
use crate::shell::place::shown;
use crate::shell::text::one_line;
use crate::shell::{Exit, Failure, interrupt, progress};
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use tilewright_gen::tools::{DumpError, Simulator};
use tilewright_gen::{VerilogFile, verilog};
use tilewright_hdl::{Design, Scenario};
use tilewright_sim::EngineKind;

/// What a run is compared with.
#[derive(Debug, Clone)]
pub enum Other {
    Simulator(Simulator),
    Engine(EngineKind, &'static str),
    File(PathBuf),
}

const NAMES: [&str; 5] = ["icarus", "verilator", "verilog", "interpreter", "reference"];

impl Other {
    /// By its name, or by that of a file.
    ///
    /// # Errors
    /// It is none of the names, and no file.
    pub fn parse(given: OsString) -> Result<Other, String> {
        Ok(match given.to_str() {
            Some("icarus") => Other::Simulator(Simulator::Icarus),
            Some("verilator") => Other::Simulator(Simulator::Verilator),
            Some("verilog") => Other::Simulator(first_installed()),
            Some("interpreter") => Other::Engine(EngineKind::Interpreter, "interpreter"),
            Some("reference") => Other::Engine(EngineKind::Reference, "reference"),
            _ if Path::new(&given).exists() => Other::File(given.into()),
            _ => {
                let shown = shown(Path::new(&given));
                let remedy = match near(&shown, &NAMES) {
                    Some(name) => format!("did you mean `{name}`?"),
                    None => format!("name one of {}, or a VCD or an FST file that is there", NAMES.join(", ")),
                };
                return Err(format!("there is no file `{shown}`: {remedy}"));
            }
        })
    }

    /// The simulator to run, if it is one.
    fn simulator(&self) -> Option<Simulator> {
        if let Other::Simulator(simulator) = self { Some(*simulator) } else { None }
    }

    /// Whether it is a simulator of Verilog.
    pub fn is_simulator(&self) -> bool {
        self.simulator().is_some()
    }

    /// Whether it is one of our engines.
    pub fn is_engine(&self) -> bool {
        matches!(self, Other::Engine(..))
    }

    /// Whether it can be had, before anything takes time.
    ///
    /// # Errors
    /// A program is missing.
    pub fn check(&self) -> Result<(), Failure> {
        match self.simulator().and_then(Simulator::missing) {
            Some(missing) => Err(Failure::new(Exit::NoTool, missing.to_string())),
            None => Ok(()),
        }
    }

    /// Reads the Verilog that is run in place of what is printed.
    ///
    /// # Errors
    /// No simulator runs it, or it cannot be read.
    pub fn edited(&self, paths: &[PathBuf]) -> Result<Vec<VerilogFile>, Failure> {
        if !self.is_simulator() && !paths.is_empty() {
            let sentence = "--verilog is for a simulator of Verilog: give --against icarus or --against verilator";
            return Err(Failure::new(Exit::BadInput, sentence));
        }
        let read = |path: &PathBuf| {
            let text = std::fs::read_to_string(path).map_err(|error| {
                let sentence = format!("{}: it cannot be read ({error}): name a Verilog file", shown(path));
                Failure::new(Exit::BadInput, sentence)
            })?;
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            Ok(VerilogFile { name, text })
        };
        paths.iter().map(read).collect()
    }

    /// The waveform of the other run.
    ///
    /// # Errors
    /// It cannot be had.
    pub fn waves(
        &self,
        design: &Design,
        scenario: &Scenario,
        ours: &Run,
        edited: &[VerilogFile],
    ) -> Result<Waves, Failure> {
        match self {
            Other::File(path) => Waves::read(path),
            // An assertion ends both runs, and the failure of ours is told.
            Other::Engine(kind, name) => Ok(Run::of(design, scenario, *kind, name)?.waves),
            Other::Simulator(simulator) => simulated(*simulator, design, ours, edited),
        }
    }
}

/// The first simulator that is installed, or else the first one.
fn first_installed() -> Simulator {
    let all = [Simulator::Icarus, Simulator::Verilator];
    all.into_iter().find(|it| it.missing().is_none()).unwrap_or(Simulator::Icarus)
}

/// The waveform of a simulator of Verilog.
fn simulated(simulator: Simulator, design: &Design, ours: &Run, edited: &[VerilogFile]) -> Result<Waves, Failure> {
    let mut files = verilog(design);
    for file in edited {
        replace(&mut files, file)?;
    }
    progress::phase("running the Verilog");
    let memories: Vec<(&str, u32)> = ours.words.lanes().collect();
    let dumped = simulator.dump((design, &ours.recording), &files, &memories, &interrupt::asked);
    let dump = dumped.map_err(|error| failure(error, !edited.is_empty()))?;
    Ok(Waves::read(&dump.path())?.named(simulator.name()))
}

/// Puts a file in the place of those whose modules it has.
///
/// # Errors
/// It has none of the modules.
fn replace(files: &mut Vec<VerilogFile>, file: &VerilogFile) -> Result<(), Failure> {
    let has: Vec<&str> = modules(&file.text).collect();
    let count = files.len();
    let printed: Vec<String> = files.iter().flat_map(|it| modules(&it.text)).map(str::to_owned).collect();
    files.retain(|it| !modules(&it.text).any(|module| has.contains(&module)));
    if files.len() == count {
        let sentence =
            format!("{}: it has no module of the block: name a file with one of {}", file.name, printed.join(", "));
        return Err(Failure::new(Exit::BadInput, sentence));
    }
    files.push(file.clone());
    Ok(())
}

/// The modules that a Verilog text declares at the beginning of a line.
fn modules(text: &str) -> impl Iterator<Item = &str> {
    let name = |line: &'_ str| -> Option<usize> {
        let rest = line.trim_start().strip_prefix("module")?;
        rest.starts_with(char::is_whitespace).then(|| line.len() - rest.trim_start().len())
    };
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '$';
    text.lines().filter_map(move |line| {
        let rest = &line[name(line)?..];
        Some(&rest[..rest.find(|c| !is_part(c)).unwrap_or(rest.len())])
    })
}

fn failure(error: DumpError, is_edited: bool) -> Failure {
    let sentence = one_line(&error.to_string());
    match error {
        DumpError::Missing(_) | DumpError::Failed { .. } => Failure::new(Exit::NoTool, sentence),
        // The user's own file is wrong, and the line says where.
        DumpError::Refused { .. } if is_edited => Failure::new(Exit::BadInput, sentence),
        DumpError::Refused { .. } => Failure::new(Exit::NoTool, sentence),
        DumpError::Io(error) => Failure::no_temporary(&error),
        DumpError::Interrupted => Failure::new(interrupt::exit(), sentence),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_takes_the_place_of_the_modules_that_it_has() {
        let file = |name: &str, text: &str| VerilogFile { name: name.to_owned(), text: text.to_owned() };
        let mut files = vec![
            file("a.v", "// module b\nmodule a (\n);\nendmodule\n"),
            file("b.v", "  module b;\nendmodule\n"),
            file("a.hex", "00\n"),
        ];
        replace(&mut files, &file("hand.v", "module b(input x);\nendmodule\nmodule c;\nendmodule\n")).unwrap();
        assert_eq!(files.iter().map(|file| file.name.as_str()).collect::<Vec<_>>(), ["a.v", "a.hex", "hand.v"]);
        let none = replace(&mut files, &file("d.v", "modules are made here\n")).unwrap_err();
        assert_eq!(none.sentence, "d.v: it has no module of the block: name a file with one of a, b, c");
    }
}
