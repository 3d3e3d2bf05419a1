//! Random designs, as many as every test run can afford; the command of this package runs more.
//!
//! `CAMPAIGN_SEED` is the seed of the designs that Icarus runs, 1 if it is not set. CI takes it from the commit, so that each has designs of its own.

use std::collections::{BTreeMap, BTreeSet};
use tilewright_cosim::batch::Tool;
use tilewright_cosim::drawn::Kind;
use tilewright_cosim::features::{Feature, used_by};
use tilewright_cosim::{Campaign, Failure};
use tilewright_gen::{VerilogFile, tools, verilog};
use tilewright_hdl::Design;
use tilewright_hdl::ir::{Op, Property, Register};

const SEED: u64 = 1;

/// The seed of the designs that are others at each commit.
fn changing_seed() -> u64 {
    let seed = std::env::var("CAMPAIGN_SEED").ok();
    seed.map_or(SEED, |seed| {
        seed.parse().unwrap_or_else(|_| panic!("CAMPAIGN_SEED is {seed:?}: it is a number, such as 7"))
    })
}

fn expect_agreement(campaign: &Campaign) {
    if !campaign.tool.is_here() {
        return;
    }
    let summary = campaign.run(|_| {});
    println!("{}: {summary}", campaign.tool.name());
    let failures: Vec<String> = summary.failures.iter().map(ToString::to_string).collect();
    assert!(failures.is_empty(), "{}", failures.join("\n\n"));
    assert_eq!(summary.designs, campaign.designs);
    // Some steps of each, and an output or more at each step.
    assert!(summary.cycles >= 4 * summary.designs && summary.outputs >= summary.cycles, "{summary}");
    // A design that the other simulator breaks on is rare, or the generator is no good.
    assert!(summary.unusable <= 2 + summary.designs / 500, "{summary}");
}

#[test]
fn icarus_agrees_on_1000_designs() {
    expect_agreement(&Campaign::icarus(changing_seed(), 1000));
}

/// In any order of the nodes, and reads of what is being written: what is not printed.
#[test]
fn both_engines_agree_on_400_circuits_with_shapes() {
    expect_agreement(&Campaign { kind: Kind::Odd, ..Campaign::icarus(SEED, 400) });
}

#[test]
fn verilator_agrees_on_100_designs() {
    expect_agreement(&Campaign::verilator(SEED, 100));
}

/// Prints a greater-than where an expression has a less-than.
fn wrong_printer(design: &Design) -> Vec<VerilogFile> {
    let wrong = |line: &str| match line.trim_start().starts_with("assign") {
        true => line.replace(" < ", " > ") + "\n",
        false => line.to_owned() + "\n",
    };
    let files = verilog(design).into_iter();
    files.map(|file| VerilogFile { text: file.text.lines().map(wrong).collect(), ..file }).collect()
}

#[test]
fn a_wrong_operator_is_found_and_shrunk() {
    if !Tool::Icarus.is_here() {
        return;
    }
    // Design 8 fails, too, but whichever step of it is left out, later ones read other values.
    let campaign = Campaign {
        printer: wrong_printer,
        first: 9,
        batch: 20,
        lints: false,
        shrinks: 1,
        ..Campaign::icarus(SEED, 160)
    };
    let summary = campaign.run(|_| {});
    let steps = |failure: &Failure| failure.spec.steps();
    let smallest = summary.failures.first().map(steps).expect("a wrong operator goes unnoticed");
    assert!(smallest <= 3, "the smallest failing design still has {smallest} steps");
    let text = summary.failures[0].to_string();
    assert!(text.contains("FAIL: cycle ") && text.contains("--first "), "{text}");
}

/// Gives labels in lanes the names that ports have.
fn hiding_printer(design: &Design) -> Vec<VerilogFile> {
    let hiding = |line: &str| match line.contains(" assign ") {
        true => line.replace("begin : lane_", "begin : ") + "\n",
        false => line.to_owned() + "\n",
    };
    let files = verilog(design).into_iter();
    files.map(|file| VerilogFile { text: file.text.lines().map(hiding).collect(), ..file }).collect()
}

/// Lets go of a pad while it drives.
fn letting_go(design: &Design) -> Vec<VerilogFile> {
    let wrong = |line: &str| match line.ends_with("'bz;") {
        true => line.replace(" ? ", " === 1'b0 ? ") + "\n",
        false => line.to_owned() + "\n",
    };
    let files = verilog(design).into_iter();
    files.map(|file| VerilogFile { text: file.text.lines().map(wrong).collect(), ..file }).collect()
}

#[test]
fn a_pad_that_lets_go_is_found() {
    if !Tool::Icarus.is_here() {
        return;
    }
    let campaign = Campaign { printer: letting_go, batch: 30, lints: false, shrinks: 0, ..Campaign::icarus(SEED, 60) };
    let summary = campaign.run(|_| {});
    let failure = summary.failures.first().expect("a wrong pad goes unnoticed");
    assert!(failure.what.starts_with("on a board: FAIL: cycle "), "{failure}");
}

#[test]
fn a_label_that_hides_a_name_is_found() {
    let campaign = Campaign::icarus(SEED, 0);
    let designs = (0..500).map(|number| (number, campaign.design(number))).filter(|(_, spec)| spec.is_printed());
    let printed = designs.map(|(number, spec)| {
        let design = spec.design(number).unwrap();
        (verilog(&design), hiding_printer(&design))
    });
    let printed: Vec<_> = printed.collect();
    let differing: Vec<&[VerilogFile]> =
        printed.iter().filter(|(right, wrong)| right != wrong).map(|(_, wrong)| wrong.as_slice()).collect();
    assert!(!differing.is_empty(), "no design has a label that could hide a name");
    match tools::lint_quickly(&differing) {
        Ok(linted) => assert!(linted.ran.is_empty(), "a hidden name goes unnoticed"),
        Err(wrong) => println!("{} of {} designs are refused", wrong.len(), differing.len()),
    }
}

#[test]
fn a_seed_makes_the_same_designs_and_another_one_others() {
    let designs = |seed| {
        let campaign = Campaign::icarus(seed, 0);
        (0..20).map(|number| format!("{:?}", campaign.design(number))).collect::<Vec<_>>()
    };
    assert_eq!(designs(SEED), designs(SEED));
    let all: BTreeSet<String> = [SEED, SEED + 1].into_iter().flat_map(designs).collect();
    assert_eq!(all.len(), 40, "designs of two seeds are alike");
}

#[test]
fn every_node_of_the_circuit_is_generated() {
    let campaign = Campaign::icarus(SEED, 0);
    let mut seen = BTreeSet::new();
    for number in 0..400 {
        let design = campaign.design(number).design(number).unwrap();
        for module in design.modules() {
            seen.extend(module.nodes.iter().map(|node| kind(&node.op)));
        }
    }
    let all = [
        "Binary",
        "Broadcast",
        "Case",
        "Compare",
        "Concat",
        "Const",
        "Extend",
        "Input",
        "Interleave",
        "Lane",
        "Map",
        "Mux",
        "Output",
        "Pack",
        "Pick",
        "QuasiStatic",
        "Read",
        "Reduce",
        "Register",
        "Repeat",
        "Select",
        "Shift",
        "Slice",
        "Stack",
        "Unary",
        "Unpack",
        "Wire",
    ];
    assert_eq!(seen, all.map(String::from).into());
}

#[test]
fn every_statement_is_generated() {
    let campaign = Campaign::icarus(SEED, 0);
    let mut seen = BTreeSet::new();
    for number in 0..400 {
        let design = campaign.design(number).design(number).unwrap();
        for module in design.modules() {
            seen.extend(module.properties.iter().map(|property| format!("{:?}", property.directive)));
            let of_code = |property: &&Property| property.message.contains("is a code of");
            seen.extend(module.properties.iter().find(of_code).map(|_| "code".to_owned()));
            let named = |name: &str| module.nodes.iter().any(|node| node.name.as_deref() == Some(name));
            seen.extend(named("has_past").then(|| "past".to_owned()));
            let initial = |register: &Register| register.initial.is_some() && register.reset.is_none();
            seen.extend(module.registers.iter().any(initial).then(|| "initial".to_owned()));
        }
    }
    assert_eq!(seen, ["Assert", "Assume", "Cover", "Display", "code", "initial", "past"].map(String::from).into());
}

#[test]
fn every_feature_of_the_language_is_used_by_several_designs() {
    let campaign = Campaign::icarus(SEED, 0);
    let mut designs: BTreeMap<Feature, u32> = Feature::ALL.iter().map(|feature| (*feature, 0)).collect();
    for number in 0..1500 {
        let (design, used) = used_by(|| campaign.design(number).design(number));
        design.unwrap();
        for feature in used {
            *designs.entry(feature).or_default() += 1;
        }
    }
    println!("{designs:?}");
    let rare: Vec<_> = designs.iter().filter(|(_, designs)| **designs < 5).collect();
    assert!(rare.is_empty(), "used by few designs of 1500: {rare:?}");
}

/// The name of a node's variant.
fn kind(op: &Op) -> String {
    let text = format!("{op:?}");
    text.split(|c: char| !c.is_alphanumeric()).next().unwrap_or_default().to_owned()
}
