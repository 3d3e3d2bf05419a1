//! A line that bounces.

use proptest::prelude::*;
use tilewright_blocks::*;
use tilewright_sim::Simulation;

#[test]
fn a_switch_that_bounces_twice() {
    let mut sim = Simulation::of(&Debouncer { clocks: 3, idle: true }).unwrap().seeded(7);
    sim.set(sim.i.line, 1);
    sim.reset();
    let lines = [0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1];
    let seen = sim.stream(lines.map(|line| DebouncerIn { line }));
    let out = |level, rises, falls| DebouncerOut { level, rises, falls };
    let mut expected = vec![out(1, 0, 0); 10];
    expected.extend([out(0, 0, 1), out(0, 0, 0), out(0, 0, 0), out(0, 0, 0), out(0, 0, 0), out(0, 0, 0)]);
    expected.extend([out(1, 1, 0), out(1, 0, 0)]);
    assert_eq!(seen, expected);
}

#[test]
fn a_reset_ends_a_count() {
    let mut sim = Simulation::of(&Debouncer { clocks: 4, idle: false }).unwrap().seeded(3);
    sim.reset();
    sim.set(sim.i.line, 1);
    sim.run(8);
    sim.reset();
    let levels: Vec<u64> = sim.stream([DebouncerIn { line: 1 }; 8]).iter().map(|out| out.level).collect();
    assert_eq!(levels, [0, 0, 0, 0, 0, 0, 1, 1]);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    /// The level is that of the last `clocks` samples, if these are all the same; otherwise it stays.
    #[test]
    fn a_level_is_one_that_lasts(
        clocks in 1u64..9, idle: bool, pulses in prop::collection::vec((any::<bool>(), 1usize..14), 1..24), seed in any::<u64>(),
    ) {
        let mut sim = Simulation::of(&Debouncer { clocks, idle }).unwrap().seeded(seed);
        sim.set(sim.i.line, idle);
        sim.reset();
        let lines: Vec<bool> = pulses.iter().flat_map(|&(line, length)| vec![line; length]).collect();
        // Two clocks pass in the synchronizer.
        let mut samples = vec![idle; clocks as usize + 2];
        let mut before = idle;
        for line in lines {
            let window = &samples[samples.len() - 2 - clocks as usize..samples.len() - 2];
            let level = if window.iter().all(|sample| *sample == window[0]) { window[0] } else { before };
            sim.drive(DebouncerIn { line: line.into() });
            let expected = DebouncerOut {
                level: level.into(),
                rises: (level && !before).into(),
                falls: (!level && before).into(),
            };
            prop_assert_eq!(sim.read_u64(), expected);
            sim.step();
            samples.push(line);
            before = level;
        }
    }
}

#[test]
fn a_level_of_no_clocks() {
    let problem = tilewright_hdl::elaborate(&Debouncer { clocks: 0, idle: false }).unwrap_err().to_string();
    assert!(problem.starts_with("`clocks` of `Debouncer` is 0: it has to be at least 1"), "{problem}");
}
