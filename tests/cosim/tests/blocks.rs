//! The scenario of every block of the catalogue, repeated by Icarus, Verilator and Yosys.

use tilewright_cosim::batch::{self, Tool};
use tilewright_cosim::check::Run;
use tilewright_hdl::Design;
use tilewright_rtl::catalog::{ENTRIES, Scenario};
use tilewright_sim::{Error, Simulation};

/// Plays a scenario: a reset, and then its events.
fn play(sim: &mut Simulation, scenario: &Scenario) -> Result<(), Error> {
    sim.reset();
    let start = sim.time();
    for event in &scenario.events {
        sim.try_run_until(start + event.at_ps)?;
        let port = sim.port(&event.input)?;
        sim.set(port, event.value.clone());
    }
    sim.try_run_until(start + scenario.end_ps)
}

/// Each block by name, with its defaults.
fn blocks() -> Vec<(&'static str, Design, Run)> {
    let block = |entry: &tilewright_rtl::catalog::Entry| {
        let values = entry.values([]).unwrap();
        let (design, scenario) = (entry.design(&values).unwrap(), entry.scenario(&values).unwrap());
        let run = Run::of(&design, |sim| play(sim, &scenario)).unwrap();
        (entry.name, design, run)
    };
    ENTRIES.iter().map(block).collect()
}

fn replayed_by(tool: Tool) {
    if !tool.is_here() {
        return;
    }
    let blocks = blocks();
    let printed: Vec<_> = blocks.iter().map(|(_, _, run)| run.printed.clone()).collect();
    let verdicts = batch::run(tool, &printed).unwrap();
    for ((name, ..), wrong) in blocks.iter().zip(verdicts) {
        assert!(wrong.is_none(), "{} differs on the scenario of {name}:\n{}", tool.name(), wrong.unwrap_or_default());
    }
}

#[test]
fn icarus_repeats_every_scenario() {
    replayed_by(Tool::Icarus);
}

#[test]
fn verilator_repeats_every_scenario() {
    replayed_by(Tool::Verilator);
}

#[test]
fn yosys_agrees_with_every_dump() {
    let differences = blocks()
        .into_iter()
        .filter_map(|(name, design, run)| run.check_dump(&design).err().map(|problems| format!("{name}:\n{problems}")));
    let differences: Vec<String> = differences.collect();
    assert!(differences.is_empty(), "{}", differences.join("\n"));
}
