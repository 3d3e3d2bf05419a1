//! The scenario of every block of the catalogues, repeated by Icarus, Verilator and Yosys.

use std::sync::OnceLock;
use tilewright_cosim::batch::{self, Tool};
use tilewright_cosim::check::Run;
use tilewright_cosim::workers;
use tilewright_gen::{VerilogFile, tools};
use tilewright_hdl::Design;
use tilewright_hdl::catalog::Entry;

/// Small sizes. Those of memories are no powers of two, so that there are addresses that a memory does not have.
const OTHER: &[(&str, u64)] =
    &[("width", 9), ("height", 5), ("units", 2), ("overhead", 3), ("renderers", 3), ("chips", 3), ("pixels", 5)];

/// A size that has to be a power of two: half the default.
const HALVED: &str = "side";

/// Sizes that have to be powers of two, or that are small already: twice the default. An array of pixels gets half of its lines where it
/// may have so few: the same pixels in another shape, as twice of both takes the tools ten times as long.
const DOUBLED: &[&str] = &["line", "lines"];

/// Those of the machines, and those that any design uses.
fn entries() -> impl Iterator<Item = &'static Entry> {
    tilewright_rtl::catalog::ENTRIES.iter().chain(tilewright_blocks::catalog::ENTRIES)
}

fn has(entry: &Entry, parameter: &str) -> bool {
    entry.parameters.iter().any(|it| it.name == parameter)
}

/// Those of the small sizes that a block has.
fn small(entry: &Entry) -> impl Iterator<Item = (&'static str, u64)> {
    let halved = entry.parameters.iter().filter(|it| it.name == HALVED).map(|it| (it.name, it.default / 2));
    OTHER.iter().copied().filter(|(name, _)| has(entry, name)).chain(halved)
}

fn doubled(entry: &Entry) -> Vec<(&'static str, u64)> {
    let parameters = || entry.parameters.iter().filter(|it| DOUBLED.contains(&it.name));
    let doubled = parameters().map(|it| (it.name, 2 * it.default)).collect();
    if !has(entry, "line") {
        return doubled;
    }
    let flat: Vec<_> =
        parameters().map(|it| (it.name, if it.name == "line" { 2 * it.default } else { it.default / 2 })).collect();
    let exists = entry.values(flat.clone()).is_ok_and(|values| entry.design(&values).is_ok());
    if exists { flat } else { doubled }
}

/// A block in one size, and the run of its scenario.
struct Subject {
    /// Its name in the catalogue, with its parameters.
    name: String,
    design: Design,
    run: Run,
    size: Size,
}

/// Who looks at a size of a block. Yosys looks at every bit of every signal, which takes minutes in large sizes.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Size {
    Everybody,
    SimulatorsAndLinters,
    YosysAlone,
}

impl Subject {
    fn new(entry: &Entry, set: Vec<(&'static str, u64)>, size: Size) -> Subject {
        let values = entry.values(set).unwrap();
        let (design, scenario) = (entry.design(&values).unwrap(), entry.scenario(&values).unwrap());
        let run = Run::of(&design, |sim| sim.play(&scenario)).unwrap();
        // A replay of nothing passes.
        assert!(!run.printed.bench.text.contains("// Replays 0 recorded steps"), "{} does nothing", entry.name);
        Subject { name: format!("{} {values:?}", entry.name), design, run, size }
    }
}

/// The sizes of a block: its defaults, and others if it has sizes.
fn sizes(entry: &Entry) -> Vec<(Vec<(&'static str, u64)>, Size)> {
    let (small, doubled): (Vec<_>, _) = (small(entry).collect(), doubled(entry));
    let simulators = Size::SimulatorsAndLinters;
    match (small.is_empty(), doubled.is_empty()) {
        (true, true) => vec![(small, Size::Everybody)],
        (false, true) => vec![(Vec::new(), simulators), (small, Size::Everybody)],
        (true, false) => vec![(small, Size::Everybody), (doubled, simulators)],
        (false, false) => {
            let both = [small.clone(), doubled].concat();
            vec![(Vec::new(), simulators), (both, simulators), (small, Size::YosysAlone)]
        }
    }
}

/// Each block in its sizes, made once for all tests.
fn blocks() -> &'static [Subject] {
    static BLOCKS: OnceLock<Vec<Subject>> = OnceLock::new();
    BLOCKS.get_or_init(|| {
        for name in OTHER.iter().map(|(name, _)| name).chain([&HALVED]).chain(DOUBLED) {
            assert!(entries().any(|entry| has(entry, name)), "no block has a {name}");
        }
        let sized = |entry: &'static Entry| sizes(entry).into_iter().map(move |(set, size)| (entry, set, size));
        let jobs: Vec<_> = entries().flat_map(sized).collect();
        workers::each(&jobs, |(entry, set, size)| Subject::new(entry, set.clone(), *size))
    })
}

/// The blocks that simulators and linters look at.
fn for_simulators() -> Vec<&'static Subject> {
    blocks().iter().filter(|it| it.size != Size::YosysAlone).collect()
}

#[test]
fn no_linter_complains_of_any_block() {
    let blocks = for_simulators();
    let files: Vec<&[VerilogFile]> = blocks.iter().map(|it| it.run.printed.files.as_slice()).collect();
    let wrong = tools::lint_all(&files).err().unwrap_or_default();
    let wrong: Vec<String> =
        wrong.iter().map(|(&place, problems)| format!("{}: {problems}", blocks[place].name)).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Blocks that a simulator gets at once. Compiling what Verilator makes of all of them takes gigabytes.
const TOGETHER: usize = 12;

fn replayed_by(tool: Tool) {
    if !tool.is_here() {
        return;
    }
    let blocks = for_simulators();
    let groups: Vec<_> = blocks.chunks(TOGETHER).collect();
    let wrong = workers::each(&groups, |group| differing(tool, group)).concat();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// What a simulator says of the blocks whose scenario it does not repeat.
fn differing(tool: Tool, blocks: &[&Subject]) -> Vec<String> {
    let printed: Vec<_> = blocks.iter().map(|it| it.run.printed.clone()).collect();
    let verdicts = batch::run(tool, &printed, batch::PATIENCE).unwrap();
    let differing = blocks.iter().zip(verdicts).filter_map(|(it, wrong)| {
        wrong.map(|wrong| format!("{} differs on the scenario of {}:\n{wrong}", tool.name(), it.name))
    });
    differing.collect()
}

#[test]
fn icarus_repeats_every_scenario() {
    replayed_by(Tool::Icarus);
}

#[test]
fn verilator_repeats_every_scenario() {
    replayed_by(Tool::VerilatorOfLarge);
}

#[test]
fn yosys_agrees_with_every_dump() {
    let mut blocks: Vec<_> = blocks().iter().filter(|it| it.size != Size::SimulatorsAndLinters).collect();
    assert_eq!(blocks.len(), entries().count());
    // The longest work first, so that neither worker is left with it.
    blocks.sort_by_key(|it| std::cmp::Reverse(it.run.dump_size()));
    let problems =
        |it: &&Subject| it.run.check_dump(&it.design).err().map(|problems| format!("{}:\n{problems}", it.name));
    let differences: Vec<String> = workers::each(&blocks, problems).into_iter().flatten().collect();
    assert!(differences.is_empty(), "{}", differences.join("\n"));
}
