//! What Yosys makes of the memories of appendix F, on three families of FPGAs.

use crate::tools::is_version_shown;
use std::collections::BTreeMap;
use std::fmt::Write;
use std::fs;
use std::process::Command;
use tilewright_gen::tools::skipped_without;
use tilewright_guide::book::folder;
use tilewright_guide::words::{AllWords, KINDS};
use tilewright_hdl::{Block, elaborate};

const FAMILIES: [&str; 3] = ["synth_ice40 -noflatten", "synth_ecp5 -noflatten", "synth_xilinx -noiopad"];

#[test]
fn memories_become_what_the_appendix_says() {
    if skipped_without(&["yosys"]).is_some() || !is_version_shown("yosys") {
        return;
    }
    let families = FAMILIES.map(cells_by_module);
    let mut rows = String::new();
    for words in KINDS {
        let (module, depth) = (words.name(), words.depth);
        let read = match (words.at_once, words.in_bounds) {
            (true, _) => "`read_async`".to_owned(),
            (false, true) => format!("`read`, `{:?}`, `.in_bounds()`", words.policy),
            (false, false) => format!("`read`, `{:?}`", words.policy),
        };
        let cells = families.each_ref().map(|cells| cells[&module].join(", "));
        writeln!(rows, "| {depth} | {read} | {} |", cells.join(" | ")).unwrap();
    }
    let appendix = fs::read_to_string(folder().join("f-memories.md")).unwrap();
    assert!(appendix.contains(&rows), "the appendix does not have\n{rows}");
}

/// The cells that a synthesizer makes of each module.
fn cells_by_module(synthesizer: &str) -> BTreeMap<String, Vec<String>> {
    let folder = tempfile::tempdir().unwrap();
    for file in tilewright_gen::verilog(&elaborate(&AllWords).unwrap()) {
        fs::write(folder.path().join(file.name), file.text).unwrap();
    }
    let script = format!("read_verilog *.v; {synthesizer} -top {}; tee -o cells.txt stat", AllWords.name());
    let run = Command::new("yosys").current_dir(&folder).args(["-q", "-p", &script]).output().unwrap();
    assert!(run.status.success(), "{run:?}");
    let mut modules: BTreeMap<String, Vec<String>> = BTreeMap::new();
    let mut module = String::new();
    for line in fs::read_to_string(folder.path().join("cells.txt")).unwrap().lines() {
        match line.split_whitespace().collect::<Vec<_>>()[..] {
            ["===", name, ..] => module = name.to_owned(), // `design`, of all modules, too
            [cell, count] if line.starts_with("     ") => {
                modules.entry(module.clone()).or_default().push(format!("{count} `{cell}`"));
            }
            _ => {}
        }
    }
    modules
}
