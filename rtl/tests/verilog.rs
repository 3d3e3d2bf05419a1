//! The Verilog of every block, to be read like hand-written Verilog: each entry at its default parameters, with the
//! blocks in it. Of modules that differ in numbers alone, `golden` has the first. Modules of `tilewright-blocks` are
//! compared in that crate.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use tilewright_gen::verilog;
use tilewright_rtl::catalog::ENTRIES;

#[path = "../../gen/tests/golden/compare.rs"]
mod compare;

#[path = "../../blocks/tests/formal/mod.rs"]
mod formal;

#[test]
fn every_block_is_printed_as_in_its_golden_file() {
    let mut left: BTreeSet<PathBuf> = files_of("tests/golden").into_iter().collect();
    let mut compared = BTreeMap::new();
    for entry in ENTRIES {
        let design = entry.design(&entry.values([]).unwrap()).unwrap();
        let files = verilog(&design);
        for module in design.modules().iter().filter(|module| module.loc.file().starts_with("rtl/")) {
            if compared.entry(without_numbers(&module.name)).or_insert_with(|| module.name.clone()) != &module.name {
                continue;
            }
            let name = format!("{}.v", module.name);
            left.remove(&Path::new("tests/golden").join(&name));
            compare::compare(files.iter().find(|file| file.name == name).expect("each module has a file"));
        }
    }
    assert!(left.is_empty(), "golden files of no module: {left:?}");
}

/// The name of a module without its numbers, and without the code that stands for long parameters.
fn without_numbers(name: &str) -> String {
    let is_code = |part: &str| part.len() == 8 && part.chars().all(|it| it.is_ascii_hexdigit());
    let parts = name.split('_').filter(|part| !is_code(part));
    parts.map(|part| part.trim_end_matches(|it: char| it.is_ascii_digit())).collect::<Vec<_>>().join("_")
}

#[test]
fn every_block_has_a_golden_file() {
    let golden = files_of("tests/golden").into_iter().map(|path| fs::read_to_string(path).unwrap());
    let headers: Vec<String> = golden.map(|text| text.split("\nmodule ").next().unwrap().to_owned()).collect();
    let mut blocks = 0;
    for path in files_of("src") {
        let text = fs::read_to_string(&path).unwrap();
        // A foreign module has no Verilog of ours.
        let is_foreign = |block: &&str| block.split("\nimpl ").next().unwrap().contains("\n    foreign = ");
        for block in text.split("\nblock! {\n").skip(1).filter(|block| !is_foreign(block)) {
            let name = block.split("pub struct ").nth(1).unwrap().split([' ', ';', '\n']).next().unwrap();
            let unit = format!("// Described   rtl/{}:", path.display());
            let parameters = [format!("// Parameters  {name} {{"), format!("// Parameters  {name}\n")];
            let is_of_block =
                |header: &String| header.contains(&unit) && parameters.iter().any(|line| header.contains(line));
            let has_one = headers.iter().any(is_of_block);
            assert!(has_one, "no entry of the catalogue has the `{name}` of {}", path.display());
            blocks += 1;
        }
    }
    assert!(blocks > 40, "only {blocks} blocks are found");
}

/// Entries with assertions that Yosys proves quickly, and entries whose assumptions used to be assertions.
const STATED: [&str; 7] = [
    "broadcast-bus",
    "patch-table",
    "page-id-generator",
    "scan-counter",
    "quadtree-pixel",
    "region-allocator",
    "image-generation-controller",
];

#[test]
fn no_input_that_is_assumed_breaks_an_assertion() {
    for name in STATED {
        let entry = ENTRIES.iter().find(|entry| entry.name == name).expect(name);
        let design = entry.design(&entry.values([]).unwrap()).unwrap();
        assert_eq!(formal::broken(&design, 4), None, "{name}");
    }
}

/// The files of a folder of the package and of its subfolders, by their paths in the package.
fn files_of(folder: &str) -> Vec<PathBuf> {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut found = Vec::new();
    let mut folders = vec![package.join(folder)];
    while let Some(folder) = folders.pop() {
        for path in fs::read_dir(&folder).unwrap().map(|file| file.unwrap().path()) {
            if path.is_dir() { folders.push(path) } else { found.push(path.strip_prefix(package).unwrap().to_owned()) }
        }
    }
    found
}
