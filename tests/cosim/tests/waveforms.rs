//! The waveform of a random design is the same byte for byte, whether it is taken step by step by the plainest engine or in
//! rows by generated code.

use proptest::strategy::ValueTree;
use std::path::Path;
use tilewright_cosim::drawn::Kind;
use tilewright_cosim::spec::Stimulus;
use tilewright_cosim::stimulus::Numbers;
use tilewright_hdl::Design;
use tilewright_sim::{EngineKind, Error, Passes, Simulation, Vcd};

const SEED: u64 = 1;

/// The file of a run under a random stimulus, which ends where an assertion fails.
fn waveform(design: &Design, stimulus: &Stimulus, mut sim: Simulation, path: &Path) -> Vec<u8> {
    let mut numbers = Numbers(stimulus.seed);
    let top = design.top();
    let inputs = top.inputs.iter().map(|input| (sim.port(&input.name).expect("it is a port"), top.node(input.node)));
    let inputs: Vec<_> = inputs.collect();
    sim.trace(Vcd::to(path)).expect("the file can be made");
    for _ in 0..stimulus.steps {
        for (port, node) in &inputs {
            if !numbers.draw().is_multiple_of(4) {
                sim.set(*port, numbers.lanes(node));
            }
        }
        let done = match numbers.draw() % 12 {
            0 => sim.try_reset(),
            number => sim.try_run(number % 4 * number),
        };
        match done {
            Err(Error::Violated(_)) => break,
            done => done.expect("the file can be written"),
        }
    }
    sim.finish().expect("the file can be written");
    std::fs::read(path).expect("it was written")
}

#[test]
fn waveforms_of_400_designs_are_those_of_the_reference_engine() {
    let folder = tempfile::tempdir().expect("there is a place for files");
    let path = folder.path().join("run.vcd");
    let mut with_clocks = 0;
    for number in 0..400 {
        let drawn = Kind::Mixed.draw(SEED, number).current();
        let (design, stimulus) =
            (drawn.design(number).unwrap_or_else(|problems| panic!("{problems}")), drawn.stimulus());
        if design.top().clocks.is_empty() {
            continue;
        }
        with_clocks += 1;
        let sim = |passes: Passes, kind| Simulation::with_passes(&design, &passes).expect("it can be run").on(kind);
        let expected = waveform(&design, stimulus, sim(Passes::default(), EngineKind::Reference), &path);
        let longest = if number.is_multiple_of(2) { 20 } else { Passes::default().longest };
        let rows = Passes { looks_after: 0, longest, guarded: true, ..Passes::default() };
        let taken = waveform(&design, stimulus, sim(rows, EngineKind::Compiled), &path);
        assert!(taken == expected, "the waveform of design {number} of seed {SEED} is another one");
    }
    assert!(with_clocks > 200, "{with_clocks} designs have clocks");
}
