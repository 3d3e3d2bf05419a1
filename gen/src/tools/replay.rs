//! Replays: a testbench in Icarus and in Verilator, and a dump against the printed Verilog in Yosys.

use super::WITH_MODELS;
use super::binary::{installed, verilated_by};
use super::run::{Folder, problem, skipped_without, sources, top};
use super::{Checked, Problems};
use crate::VerilogFile;
use std::path::Path;
use std::process::Command;

/// Runs the testbench in Icarus.
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = elaborate(&tilewright_sim::for_examples::Delay).unwrap();
/// use tilewright_gen::tools::{Checked, replay_in_icarus};
/// # use tilewright_hdl::recording::{Recording, Step};
/// # let at = |time_ps, word, late| Step {
/// #     time_ps,
/// #     rising: vec![0],
/// #     resets: vec![],
/// #     inputs: vec![Bits::new(8, word)],
/// #     outputs: vec![Bits::new(8, late)],
/// # };
/// # let right = Recording { steps: vec![at(10_000, 5, 0), at(20_000, 0, 5)], initial: vec![] };
/// # let wrong = Recording { steps: vec![at(10_000, 5, 0), at(20_000, 0, 6)], initial: vec![] };
///
/// let files = tilewright_gen::verilog(&design);
/// let passed = replay_in_icarus(&files, &tilewright_gen::testbench(&design, &right)).unwrap();
/// let failed = replay_in_icarus(&files, &tilewright_gen::testbench(&design, &wrong));
/// assert_eq!(passed == Checked::Passed, failed.is_err()); // or both are skipped
/// ```
///
/// # Errors
///
/// The output of Icarus or the testbench, unless it is `PASS`.
pub fn replay_in_icarus(files: &[VerilogFile], bench: &VerilogFile) -> Result<Checked, Problems> {
    if let Some(skipped) = skipped_without(&["iverilog", "vvp"]) {
        return Ok(skipped);
    }
    let folder = folder_with(files, bench);
    let mut compile = Command::new("iverilog");
    compile.args(["-g2005", "-Wall", WITH_MODELS, "-o", "bench.vvp", &bench.name]).args(sources(files));
    let (succeeded, output) = folder.run(&mut compile);
    if !succeeded || !output.is_empty() {
        return Err(problem("iverilog", output));
    }
    let (succeeded, output) = folder.run(Command::new("vvp").args(["-n", "bench.vvp"]));
    verdict("iverilog", succeeded, output)
}

/// Builds the testbench with each installed Verilator and runs it; needs a C++ compiler and some seconds.
///
/// ```no_run
/// # use tilewright_hdl::*;
/// # let design = elaborate(&tilewright_sim::for_examples::Delay).unwrap();
/// use tilewright_gen::tools::{Checked, replay_in_verilator};
/// # let recording = Recording::default();
///
/// let bench = tilewright_gen::testbench(&design, &recording);
/// let checked = replay_in_verilator(&tilewright_gen::verilog(&design), &bench).unwrap();
/// assert!(matches!(checked, Checked::Passed | Checked::Skipped)); // otherwise it is an error
/// ```
///
/// # Errors
///
/// The output of Verilator, the compiler or the testbench, unless it is `PASS`.
pub fn replay_in_verilator(files: &[VerilogFile], bench: &VerilogFile) -> Result<Checked, Problems> {
    let top = bench.name.trim_end_matches(".v");
    let all: Vec<&str> = [bench.name.as_str()].into_iter().chain(sources(files)).collect();
    for verilator in installed() {
        let folder = folder_with(files, bench);
        let program = verilated_by(verilator, folder.path(), &all, top, &[WITH_MODELS])?;
        let Some(program) = program else { return Ok(Checked::Skipped) };
        let (succeeded, output) = folder.run(&mut Command::new(program));
        let _ = verdict(verilator.name(), succeeded, output)?;
    }
    Ok(Checked::Passed)
}

fn folder_with(files: &[VerilogFile], bench: &VerilogFile) -> Folder {
    let mut all = files.to_vec();
    all.push(bench.clone());
    Folder::with(&all)
}

fn verdict(tool: &str, succeeded: bool, output: String) -> Result<Checked, Problems> {
    let says = |what: &str| output.lines().any(|line| line.starts_with(what));
    match succeeded && says("PASS: ") && !says("FAIL: ") {
        true => Ok(Checked::Passed),
        false => Err(problem(tool, output)),
    }
}

/// Replays a dump (VCD or FST) against the Verilog in Yosys and compares every signal that is in both. Inputs are
/// driven from the dump; all other signals must follow. An input that is a row must be one vector in the dump, lane 0
/// lowest.
///
/// `scope` is the top module's scope in the dump, such as `tb.dut`; `clocks` are the names of its clocks there.
///
/// ```no_run
/// # use tilewright_hdl::*;
/// # let design = elaborate(&tilewright_sim::for_examples::Delay).unwrap();
/// use tilewright_gen::tools::{Checked, yosys_replay_vcd};
///
/// let files = tilewright_gen::verilog(&design);
/// let checked = yosys_replay_vcd(&files, "delay.vcd".as_ref(), "delay", &["clk"]).unwrap();
/// assert!(matches!(checked, Checked::Passed | Checked::Skipped));
/// ```
///
/// # Errors
///
/// The output of Yosys, if it found a difference.
pub fn yosys_replay_vcd(files: &[VerilogFile], dump: &Path, scope: &str, clocks: &[&str]) -> Result<Checked, Problems> {
    // Yosys reads FST itself, and VCD through another program.
    let is_vcd = dump.extension().is_some_and(|extension| extension == "vcd");
    if let Some(skipped) = skipped_without(if is_vcd { &["yosys", "vcd2fst"] } else { &["yosys"] }) {
        return Ok(skipped);
    }
    let folder = Folder::with(files);
    // Yosys converts `NAME.vcd` to a file of that name in a shared folder of the computer: two conversions at once
    // need two names.
    let unique = folder.path().file_name().expect("a folder has a name").to_string_lossy().into_owned();
    let copy = format!("{unique}.{}", if is_vcd { "vcd" } else { "fst" });
    let copied = std::fs::copy(dump, folder.path().join(&copy));
    let _ = copied.unwrap_or_else(|error| panic!("{} cannot be read: {error}", dump.display()));
    let clocks: String = clocks.iter().map(|clock| format!("-clock {clock} ")).collect();
    let (sources, top) = (sources(files).join(" "), top(files));
    let script = format!(
        "read_verilog {WITH_MODELS} {sources}; prep -top {top}; sim -zinit -r {copy} -scope {scope} {clocks}-sim-cmp {top}"
    );
    let (succeeded, output) = folder.run(Command::new("yosys").args(["-q", "-p", &script]));
    if succeeded && !output.contains("ERROR") { Ok(Checked::Passed) } else { Err(problem("yosys", output)) }
}
