//! The printed Verilog of every block does what the description does: the catalogue's scenarios, replayed in Icarus.

use tilewright_gen::{Replay, ReplayStep, testbench, tools, verilog};
use tilewright_hdl::Design;
use tilewright_rtl::catalog::{ENTRIES, Scenario};
use tilewright_sim::{Simulation, Step};

/// Plays a scenario; what went in and came out at each edge.
fn record(design: &Design, scenario: &Scenario) -> Replay {
    let mut sim = Simulation::from_design(design).unwrap();
    let recording = sim.recording();
    sim.reset();
    let start = sim.time();
    for event in &scenario.events {
        sim.run_until(start + event.at_ps);
        sim.set(sim.port(&event.input).unwrap(), &event.value);
    }
    sim.run_until(start + scenario.end_ps);
    sim.finish().unwrap();
    let steps = std::mem::take(&mut recording.lock().unwrap().steps);
    let step = |Step { time, clocks, resets, inputs, outputs }| ReplayStep {
        time_ps: time,
        rising: clocks,
        resets,
        inputs,
        outputs,
    };
    Replay { steps: steps.into_iter().map(step).collect(), initial: Vec::new() }
}

/// A merger of two units and a screen whose sides are no powers of two: addresses that a memory does not have.
const UNEVEN: &[(&str, u64)] = &[("width", 9), ("height", 5), ("units", 2), ("overhead", 3)];

#[test]
fn the_verilog_of_every_block_is_clean_and_replays_its_scenario() {
    for entry in ENTRIES {
        for set in [&[][..], UNEVEN] {
            let set = set.iter().copied().filter(|(name, _)| entry.parameters.iter().any(|it| it.name == *name));
            let values = entry.values(set).unwrap();
            let design = entry.design(&values).unwrap();
            let replay = record(&design, &entry.scenario(&values).unwrap());
            let (files, bench) = (verilog(&design), testbench(&design, &replay));
            let checked = tools::lint(&files).and_then(|_| tools::replay_in_icarus(&files, &bench));
            let _ = checked.unwrap_or_else(|problems| panic!("{} {values:?}: {problems}", entry.name));
        }
    }
}
