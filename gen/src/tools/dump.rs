//! The waveform of a testbench in a simulator of Verilog.

use super::run::{Verilator, is_installed, lacks, sources};
use super::{Missing, WITH_MODELS, run_watched};
use crate::bench::words;
use crate::{VerilogFile, testbench};
use std::fmt;
use std::fs::File;
use std::io;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::process::Command;
use tempfile::TempDir;
use tilewright_circuit::Recording;
use tilewright_circuit::ir::Design;

/// The files of a run beside the Verilog.
const WAVEFORM: &str = "run.vcd";
const LOG: &str = "simulator.log";
const PROGRAM: &str = "bench.vvp";

/// The C++ runs once and takes long to compile.
const MAKE_FLAGS: &str = "VM_PARALLEL_BUILDS=0 OPT_FAST=-O0 OPT_SLOW=-O0 OPT_GLOBAL=-O0";

/// The widest signal in Verilator's waveforms, in bits. Without it they have none of more than 256.
const WIDEST: &str = "1048576";

/// A simulator of Verilog.
///
/// ```
/// use tilewright_gen::tools::Simulator;
///
/// assert_eq!([Simulator::Icarus, Simulator::Verilator].map(Simulator::name), ["icarus", "verilator"]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Simulator {
    /// Icarus Verilog, which interprets.
    Icarus,
    /// Verilator, which compiles to C++.
    Verilator,
}

/// Why there is no waveform.
///
/// ```
/// use tilewright_gen::tools::DumpError;
///
/// let error = DumpError::Refused { tool: "icarus", output: "delay.v:3: syntax error".to_owned() };
/// assert_eq!(error.to_string(), "icarus refuses the Verilog: delay.v:3: syntax error");
/// ```
#[derive(Debug)]
pub enum DumpError {
    /// A program is not installed.
    Missing(Missing),
    /// The simulator does not take the Verilog, or cannot build a program of it.
    Refused {
        /// Its name.
        tool: &'static str,
        /// The line of its output that tells why.
        output: String,
    },
    /// It took the Verilog and left no waveform.
    Failed {
        /// Its name.
        tool: &'static str,
        /// The line of its output that tells why.
        output: String,
    },
    /// There is no room for the files, or a program cannot be run.
    Io(io::Error),
    /// The watcher asked to stop.
    Interrupted,
}

impl fmt::Display for DumpError {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            DumpError::Missing(missing) => missing.fmt(f),
            DumpError::Refused { tool, output } => write!(f, "{tool} refuses the Verilog: {output}"),
            DumpError::Failed { tool, output } => write!(f, "{tool} fails: {output}"),
            DumpError::Io(error) => error.fmt(f),
            DumpError::Interrupted => write!(f, "the simulator was interrupted"),
        }
    }
}

impl std::error::Error for DumpError {}

impl From<io::Error> for DumpError {
    fn from(error: io::Error) -> DumpError {
        DumpError::Io(error)
    }
}

/// The waveform of a run, which is deleted when this is dropped.
///
/// ```no_run
/// # fn dumped() -> tilewright_gen::tools::Dump { unimplemented!() }
/// let dump = dumped();
/// assert!(std::fs::read_to_string(dump.path()).unwrap().contains("$enddefinitions"));
/// ```
#[derive(Debug)]
pub struct Dump(TempDir);

impl Dump {
    /// Its file, in VCD.
    ///
    /// ```no_run
    /// # fn dumped() -> tilewright_gen::tools::Dump { unimplemented!() }
    /// assert!(dumped().path().ends_with("run.vcd"));
    /// ```
    pub fn path(&self) -> PathBuf {
        self.0.path().join(WAVEFORM)
    }
}

impl Simulator {
    /// Its name in lower case.
    ///
    /// ```
    /// assert_eq!(tilewright_gen::tools::Simulator::Icarus.name(), "icarus");
    /// ```
    pub fn name(self) -> &'static str {
        match self {
            Simulator::Icarus => "icarus",
            Simulator::Verilator => "verilator",
        }
    }

    /// A program that it needs and that is not installed, with how to get it.
    ///
    /// ```
    /// use tilewright_gen::tools::{Simulator, is_installed};
    ///
    /// assert_eq!(Simulator::Icarus.missing().is_none(), is_installed("iverilog") && is_installed("vvp"));
    /// ```
    pub fn missing(self) -> Option<Missing> {
        match self {
            Simulator::Icarus => lacks(&["iverilog", "vvp"])
                .then_some(Missing { program: "iverilog", remedy: "install it (Debian: apt-get install iverilog)" }),
            Simulator::Verilator => {
                let needs = [("make", "install it (Debian: apt-get install make)")];
                let needs = needs.into_iter().chain([("g++", "install it (Debian: apt-get install g++)")]);
                let program = verilator().is_none().then_some(Missing {
                    program: "verilator",
                    remedy: "install it (Debian: apt-get install verilator)",
                });
                let missing = |(program, remedy)| Missing { program, remedy };
                program.or_else(|| needs.filter(|(name, _)| !is_installed(name)).map(missing).next())
            }
        }
    }

    /// Replays a recording of a design in its testbench, and returns the waveform of all signals, with the words of
    /// these memories, given by path and depth. A file that was edited by hand may lack some of them. The run is not
    /// judged: it may end with mismatches. `stop` is asked again and again whether to stop it.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_hdl::recording::{Recording, Step};
    /// # let design = elaborate(&tilewright_sim::for_examples::Delay).unwrap();
    /// use tilewright_gen::tools::{DumpError, Simulator};
    /// # let at = |time_ps, word, late| Step {
    /// #     time_ps,
    /// #     rising: vec![0],
    /// #     resets: vec![],
    /// #     inputs: vec![Bits::new(8, word)],
    /// #     outputs: vec![Bits::new(8, late)],
    /// # };
    /// # let recording = Recording { steps: vec![at(10_000, 5, 0), at(20_000, 0, 5)], initial: vec![] };
    ///
    /// match Simulator::Icarus.dump((&design, &recording), &tilewright_gen::verilog(&design), &[], &|| false) {
    ///     Ok(dump) => assert!(std::fs::read_to_string(dump.path()).unwrap().contains(" held ")),
    ///     Err(error) => assert!(matches!(error, DumpError::Missing(_)), "{error}"),
    /// }
    /// ```
    ///
    /// # Errors
    ///
    /// It is not installed, does not take the Verilog, or is stopped.
    pub fn dump(
        self,
        (design, recording): (&Design, &Recording),
        files: &[VerilogFile],
        memories: &[(&str, u32)],
        stop: &dyn Fn() -> bool,
    ) -> Result<Dump, DumpError> {
        if let Some(missing) = self.missing() {
            return Err(DumpError::Missing(missing));
        }
        let folder = TempDir::with_prefix("tilewright-")?;
        let write = |file: &VerilogFile| std::fs::write(folder.path().join(&file.name), &file.text);
        files.iter().try_for_each(write)?;
        let run = Run { tool: self.name(), folder: folder.path(), stop };
        let (bench, deepest) = (testbench(design, recording), memories.iter().map(|memory| memory.1).max());
        let mut compile = self.compile(&bench, files, deepest.unwrap_or(0));
        let mut compiled = |words: &[String]| {
            write(&dumping(&bench, words))?;
            run.run(&mut compile)
        };
        // Verilator takes whole arrays by itself.
        let words = if self == Simulator::Icarus { words(design, memories) } else { Vec::new() };
        let mut taken = compiled(&words)?;
        if taken.is_err() && !words.is_empty() {
            // An edited file may lack a memory. If it has another fault, this tells that one.
            taken = compiled(&[])?;
        }
        if let Err(output) = taken {
            return Err(DumpError::Refused { tool: self.name(), output });
        }
        // A failing assertion ends the run with a status of its own.
        let ended = run.run(&mut self.simulate(folder.path()))?;
        if !folder.path().join(WAVEFORM).exists() {
            let output = ended.err().unwrap_or_else(|| "it has written no waveform".to_owned());
            return Err(DumpError::Failed { tool: self.name(), output });
        }
        Ok(Dump(folder))
    }

    /// The command that compiles, with memories of so many words in the waveform.
    fn compile(self, bench: &VerilogFile, files: &[VerilogFile], deepest: u32) -> Command {
        // The testbench is read first: its time unit holds for the files after it.
        let all = [bench.name.as_str()].into_iter().chain(sources(files));
        let top = bench.name.trim_end_matches(".v");
        match self {
            Simulator::Icarus => {
                let mut command = Command::new("iverilog");
                command.args(["-g2005", WITH_MODELS, "-s", top, "-o", PROGRAM]).args(all);
                command
            }
            Simulator::Verilator => {
                let mut command = verilator().expect("it is installed");
                command.args(["--binary", "--trace", "-j", "2", "--timescale", "1ps/1ps", WITH_MODELS]);
                command.args(["--trace-max-array", &deepest.to_string(), "--trace-max-width", WIDEST]);
                // A hand-edited file may have what a linter would not have.
                command.args(["-Wno-fatal", "-Wno-lint", "-Wno-style", "--Mdir", "build", "-o", "program"]);
                command.args(["--top-module", top, "-CFLAGS", "-O0", "-MAKEFLAGS", MAKE_FLAGS]).args(all);
                command
            }
        }
    }

    fn simulate(self, folder: &Path) -> Command {
        match self {
            Simulator::Icarus => {
                let mut command = Command::new("vvp");
                command.args(["-n", PROGRAM]);
                command
            }
            Simulator::Verilator => Command::new(folder.join("build").join("program")),
        }
    }
}

/// The Verilator of the system, or else that of its Python package, ready for arguments.
fn verilator() -> Option<Command> {
    let installed = |verilator: Verilator| (!lacks(&verilator.programs())).then(|| verilator.command())?;
    installed(Verilator::System).or_else(|| installed(Verilator::Python))
}

/// The testbench that writes the waveform with these words, with its time unit said.
fn dumping(bench: &VerilogFile, words: &[String]) -> VerilogFile {
    let end = bench.text.rfind("endmodule").unwrap_or(bench.text.len());
    let (body, rest) = bench.text.split_at(end);
    let words: String = words.iter().map(|word| format!("        $dumpvars(0, {word});\n")).collect();
    let dump = format!("    initial begin\n        $dumpfile(\"{WAVEFORM}\");\n        $dumpvars;\n{words}    end\n");
    VerilogFile { name: bench.name.clone(), text: format!("`timescale 1ps/1ps\n{body}{dump}{rest}") }
}

/// Programs that run in a folder.
struct Run<'a> {
    tool: &'static str,
    folder: &'a Path,
    stop: &'a dyn Fn() -> bool,
}

impl Run<'_> {
    /// Runs a program; if it fails, returns what it says.
    fn run(&self, command: &mut Command) -> Result<Result<(), String>, DumpError> {
        let log = self.folder.join(LOG);
        let printed = File::create(&log)?;
        let watch = || if (self.stop)() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) };
        match run_watched(command.current_dir(self.folder), printed, watch)? {
            // What ends the program may have ended the other one, too.
            _ if (self.stop)() => Err(DumpError::Interrupted),
            ControlFlow::Break(()) => Err(DumpError::Interrupted),
            ControlFlow::Continue(status) if status.success() => Ok(Ok(())),
            ControlFlow::Continue(_) => Ok(Err(complaint(&std::fs::read(&log)?, self.tool))),
        }
    }
}

/// The first line of an output that tells of an error, or else its last one.
fn complaint(output: &[u8], tool: &str) -> String {
    let text = String::from_utf8_lossy(output);
    let lines = || text.lines().map(str::trim).filter(|line| !line.is_empty());
    let tells = |line: &&str| line.to_lowercase().contains("error");
    lines().find(tells).or_else(|| lines().next_back()).map_or_else(|| format!("{tool} says nothing"), str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_complaint_is_the_first_line_with_an_error() {
        assert_eq!(complaint(b"a.v:1: warning: x\na.v:3: syntax error\nI give up.\n", "icarus"), "a.v:3: syntax error");
        assert_eq!(complaint(b"one\n\ntwo\n\n", "icarus"), "two");
        assert_eq!(complaint(b"", "icarus"), "icarus says nothing");
    }

    #[test]
    fn the_waveform_is_written_before_the_testbench_ends() {
        let bench = VerilogFile { name: "a_tb.v".to_owned(), text: "module a_tb;\nendmodule\n`x\n".to_owned() };
        let text = dumping(&bench, &["dut.words[3]".to_owned()]).text;
        let places = ["`timescale", "module a_tb;", "$dumpvars;", "$dumpvars(0, dut.words[3]);", "endmodule\n`x"]
            .map(|part| text.find(part));
        assert!(places.iter().all(Option::is_some) && places.is_sorted(), "{text}");
    }
}
