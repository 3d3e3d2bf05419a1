//! The scenario of every block of the catalogues, repeated by Icarus, Verilator and Yosys.

use std::iter;
use std::sync::Mutex;
use tilewright_cosim::batch::{self, Tool};
use tilewright_cosim::check::Run;
use tilewright_gen::{VerilogFile, tools};
use tilewright_hdl::Design;
use tilewright_hdl::catalog::Entry;

/// Small sizes that are no powers of two, so that there are addresses that a memory does not have.
const OTHER: &[(&str, u64)] =
    &[("width", 9), ("height", 5), ("units", 2), ("overhead", 3), ("renderers", 5), ("chips", 3), ("pixels", 5)];

/// Sizes that have to be powers of two: twice the default.
const DOUBLED: &[&str] = &["side", "line", "lines"];

/// Those of the machines, and those that any design uses.
fn entries() -> impl Iterator<Item = &'static Entry> {
    tilewright_rtl::catalog::ENTRIES.iter().chain(tilewright_blocks::catalog::ENTRIES)
}

fn has(entry: &Entry, parameter: &str) -> bool {
    entry.parameters.iter().any(|it| it.name == parameter)
}

/// Those of the small sizes that a block has.
fn small(entry: &Entry) -> impl Iterator<Item = (&'static str, u64)> {
    OTHER.iter().copied().filter(|(name, _)| has(entry, name))
}

fn doubled(entry: &Entry) -> impl Iterator<Item = (&'static str, u64)> {
    let parameters = entry.parameters.iter().filter(|it| DOUBLED.contains(&it.name));
    parameters.map(|it| (it.name, 2 * it.default))
}

/// A block with such sizes in its scenario, by name.
fn block(entry: &Entry, set: Vec<(&str, u64)>) -> (String, Design, Run) {
    let values = entry.values(set).unwrap();
    let (design, scenario) = (entry.design(&values).unwrap(), entry.scenario(&values).unwrap());
    let run = Run::of(&design, |sim| sim.play(&scenario)).unwrap();
    // A replay of nothing passes.
    assert!(!run.printed.bench.text.contains("// Replays 0 recorded steps"), "{} does nothing", entry.name);
    (format!("{} {values:?}", entry.name), design, run)
}

/// Each block by name, with its defaults, and with other sizes if it has sizes.
fn blocks() -> Vec<(String, Design, Run)> {
    let mut blocks = Vec::new();
    for name in OTHER.iter().map(|(name, _)| name).chain(DOUBLED) {
        assert!(entries().any(|entry| has(entry, name)), "no block has a {name}");
    }
    for entry in entries() {
        let other: Vec<_> = small(entry).chain(doubled(entry)).collect();
        blocks.push(block(entry, Vec::new()));
        blocks.extend((!other.is_empty()).then(|| block(entry, other)));
    }
    blocks
}

#[test]
fn no_linter_complains_of_any_block() {
    let blocks = blocks();
    let files: Vec<&[VerilogFile]> = blocks.iter().map(|(_, _, run)| run.printed.files.as_slice()).collect();
    let wrong = tools::lint_all(&files).err().unwrap_or_default();
    let wrong: Vec<String> =
        wrong.iter().map(|(&place, problems)| format!("{}: {problems}", blocks[place].0)).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Blocks that a simulator gets at once. Compiling what Verilator makes of all of them takes gigabytes.
const TOGETHER: usize = 12;

fn replayed_by(tool: Tool) {
    if !tool.is_here() {
        return;
    }
    let blocks = blocks();
    let groups = Mutex::new(blocks.chunks(TOGETHER));
    let next = || groups.lock().expect("no other thread panics while it has it").next();
    let work = || iter::from_fn(next).flat_map(|group| differing(tool, group)).collect::<Vec<_>>();
    let wrong = std::thread::scope(|scope| {
        let other = scope.spawn(work);
        [work(), other.join().expect("it does not panic")].concat()
    });
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// What a simulator says of the blocks whose scenario it does not repeat.
fn differing(tool: Tool, blocks: &[(String, Design, Run)]) -> Vec<String> {
    let printed: Vec<_> = blocks.iter().map(|(_, _, run)| run.printed.clone()).collect();
    let verdicts = batch::run(tool, &printed, batch::PATIENCE).unwrap();
    let differing = blocks.iter().zip(verdicts).filter_map(|((name, ..), wrong)| {
        wrong.map(|wrong| format!("{} differs on the scenario of {name}:\n{wrong}", tool.name()))
    });
    differing.collect()
}

#[test]
fn icarus_repeats_every_scenario() {
    replayed_by(Tool::Icarus);
}

#[test]
fn verilator_repeats_every_scenario() {
    replayed_by(Tool::Verilator);
}

/// Each block, in uneven sizes but not in larger ones: Yosys looks at every bit of every signal, which takes minutes.
fn blocks_in_one_size() -> impl Iterator<Item = (String, Design, Run)> {
    entries().map(|entry| block(entry, small(entry).collect()))
}

#[test]
fn yosys_agrees_with_every_dump() {
    let differences = blocks_in_one_size()
        .filter_map(|(name, design, run)| run.check_dump(&design).err().map(|problems| format!("{name}:\n{problems}")));
    let differences: Vec<String> = differences.collect();
    assert!(differences.is_empty(), "{}", differences.join("\n"));
}
