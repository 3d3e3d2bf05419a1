//! Waveforms of a part of a run: in that part they show what a waveform of the whole run shows.

use std::collections::BTreeMap;
use std::fs;
use std::ops::Range;
use std::path::Path;

use proptest::prelude::*;
use tilewright_hdl::{Design, elaborate};
use tilewright_sim::{EngineKind, Simulation, Trace, Vcd};
use vcd::Command;

use super::instants::Clocks;
use super::vcd_rows::Mix;

/// What a testbench does.
#[derive(Debug, Clone)]
enum Act {
    Set(u64),
    Step,
    Run(u64),
    RunTo(u64),
    RunUntil(u64),
    Reset,
}

fn acts() -> impl Strategy<Value = Vec<Act>> {
    let act = prop_oneof![
        (0..4u64).prop_map(Act::Set),
        Just(Act::Step),
        (0..30u64).prop_map(Act::Run),
        (0..60_000u64).prop_map(Act::RunTo),
        (0..40u64).prop_map(Act::RunUntil),
        Just(Act::Reset),
    ];
    prop::collection::vec(act, 1..20)
}

/// Runs with these traces.
fn run(design: &Design, kind: EngineKind, acts: &[Act], traces: impl IntoIterator<Item = Trace>) -> u64 {
    let mut sim = Simulation::from_design(design).unwrap().on(kind);
    let input = sim.port(&design.top().inputs[0].name).unwrap();
    // Only the circuit of several clocks fails at a limit of 0.
    if design.top().clocks.len() > 1 {
        let limit = sim.port("limit").unwrap();
        sim.set(limit, 0xfff);
    }
    let output = sim.port(&design.top().outputs.last().unwrap().name).unwrap();
    traces.into_iter().for_each(|trace| sim.trace(trace).unwrap());
    for act in acts {
        match act {
            Act::Set(number) => sim.set(input, number & 1),
            Act::Step => sim.step(),
            Act::Run(instants) => sim.run(*instants),
            Act::RunTo(span) => sim.run_to(sim.time() + span),
            Act::RunUntil(limit) => {
                let now = sim.get_u64(output);
                sim.run_until(output.is_not(now), *limit);
            }
            Act::Reset => sim.reset(),
        }
    }
    sim.finish().unwrap();
    sim.time()
}

/// The changes of a file, by time: of each variable the value.
fn changes(file: &Path) -> BTreeMap<u64, Vec<(vcd::IdCode, String)>> {
    let bytes = fs::read(file).unwrap();
    let mut parser = vcd::Parser::new(&bytes[..]);
    parser.parse_header().unwrap();
    let (mut changes, mut time) = (BTreeMap::new(), None);
    for command in parser {
        let change = match command.unwrap() {
            Command::Timestamp(next) => {
                time = Some(next);
                changes.entry(next).or_insert_with(Vec::new);
                continue;
            }
            Command::ChangeScalar(id, value) => (id, value.to_string()),
            Command::ChangeVector(id, digits) => (id, digits.to_string()),
            Command::ChangeString(id, state) => (id, state),
            _ => continue,
        };
        changes.get_mut(&time.expect("a change has a time")).expect("its time is there").push(change);
    }
    changes
}

/// The values of all variables from a time on, at each time of a change.
fn values(file: &Path, from: u64) -> Vec<(u64, BTreeMap<vcd::IdCode, String>)> {
    let mut changes = changes(file);
    let later = changes.split_off(&(from + 1));
    let mut now: BTreeMap<_, _> = changes.into_values().flatten().collect();
    let mut values = vec![(from, now.clone())];
    for (time, changed) in later {
        now.extend(changed);
        values.push((time, now.clone()));
    }
    values
}

fn check(design: &Design, kind: EngineKind, acts: &[Act], windows: &[Range<u64>]) {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name);
    let names: Vec<String> = (0..windows.len()).map(|number| format!("{number}.vcd")).collect();
    let end = run(design, kind, acts, [Vcd::to(file("whole.vcd"))]);
    run(design, kind, acts, names.iter().zip(windows).map(|(name, window)| Vcd::to(file(name)).times(window.clone())));
    for (name, window) in names.iter().zip(windows) {
        let shown = changes(&file(name));
        // The values after the last instant stay until the next one would come.
        assert!(!shown.is_empty() || window.start > end, "{name} of {acts:?}");
        if let Some(first) = shown.keys().next() {
            assert_eq!(*first, window.start, "{name} of {acts:?}");
            let within = |file: &Path| {
                let values = values(file, window.start).into_iter();
                values.filter(|(time, _)| *time < window.end).collect::<Vec<_>>()
            };
            assert!(within(&file(name)) == within(&file("whole.vcd")), "{name}, {window:?} of {acts:?}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_part_shows_what_the_whole_shows(
        acts in acts(),
        windows in prop::collection::vec((0..300_000u64, 1..100_000u64), 1..4),
        is_one_clock in any::<bool>(),
        kind in prop::sample::select(vec![EngineKind::Reference, EngineKind::Compiled, EngineKind::Tiered]),
    ) {
        let design = if is_one_clock { elaborate(&Mix) } else { elaborate(&Clocks) }.unwrap();
        let windows: Vec<_> = windows.into_iter().map(|(from, length)| from..from + length).collect();
        check(&design, kind, &acts, &windows);
    }
}

/// A run waits in machine code for the window, and goes on in it afterwards.
#[test]
fn a_part_far_from_both_ends_is_there() {
    let acts = [Act::Set(1), Act::RunTo(5_000_000), Act::Run(1000), Act::RunUntil(300)];
    for (design, from) in [(elaborate(&Mix), 4_000_123), (elaborate(&Clocks), 4_999_999)] {
        for kind in [EngineKind::Compiled, EngineKind::Tiered] {
            check(design.as_ref().unwrap(), kind, &acts, &[from..from + 77_000, 20..70, from + 5_000..u64::MAX]);
        }
    }
}
