//! Going back in time, with one clock: the way on which an engine runs many edges at once.

use proptest::prelude::*;
use tilewright_hdl::{Module, ReadUnderWrite, bit, bits, block, def};
use tilewright_sim::{EngineKind, Error, Simulation, Unremembered, Vcd};

block! {
    /// Adds up what it is given, and keeps the last sums.
    struct Sums;
    in SumsIn { x: bits(8), enable: bit() }
    out SumsOut { sum: bits(8), kept: bits(8), is_zero: bit() }
}

impl Sums {
    fn build(&self, m: Module, i: SumsIn) -> SumsOut {
        def!(sum = m.reg(8).reset(0));
        sum.when(i.enable, sum + i.x);
        def!(place = m.reg(4).reset(0));
        place.next(place + 1);
        def!(sums = m.memory(16, 8, ReadUnderWrite::Old));
        sums.write(i.enable, *place, *sum);
        m.cover("it adds nothing", i.enable & i.x.eq(0));
        SumsOut { sum: *sum, kept: sums.read(*place), is_zero: sum.eq(0) }
    }
}

const KINDS: [EngineKind; 4] = [EngineKind::Compiled, EngineKind::Interpreter, EngineKind::Reference, EngineKind::Both];

/// What there is to see at a time.
type Seen = (u64, [u64; 3], Vec<u64>, u64);

fn seen(sim: &mut Simulation<SumsIn, SumsOut>) -> Seen {
    let words = sim.peek_words("sums").unwrap();
    let words = words.iter().map(|word| word.to_u64().unwrap()).collect();
    let outputs = [sim.get_u64(sim.o.sum), sim.get_u64(sim.o.kept), sim.get_u64(sim.i.x)];
    (sim.time(), outputs, words, sim.covered("it adds nothing").unwrap())
}

/// A simulation that has done this, remembers it, and what was to be seen after each instant.
fn run(kind: EngineKind, bytes: usize, every: u64, inputs: &[u64]) -> (Simulation<SumsIn, SumsOut>, Vec<Seen>) {
    let mut sim = Simulation::of(&Sums).unwrap().on(kind);
    sim.remember_often(bytes, every);
    let mut was = Vec::new();
    for &x in inputs {
        if x % 3 != 0 {
            sim.set(sim.i.x, x % 8);
            sim.set(sim.i.enable, x & 1);
        }
        if x == 99 {
            sim.poke_memory("sums", 3, 77).unwrap();
        }
        if x == 55 {
            sim.set_reset("clk", true);
        }
        was.push(seen(&mut sim));
        sim.step();
        sim.set_reset("clk", false);
    }
    was.push(seen(&mut sim));
    (sim, was)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 32, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn every_cycle_is_there_again(
        kind in 0..4usize,
        every in 1..40u64,
        inputs in prop::collection::vec(0..100u64, 1..200),
        goals in prop::collection::vec((any::<usize>(), 0..60u64), 1..12),
    ) {
        let (mut sim, was) = run(KINDS[kind], 1 << 30, every, &inputs);
        for (goal, further) in goals {
            let goal = goal % was.len();
            sim.go_to_cycle("clk", goal as u64).unwrap();
            prop_assert_eq!(&seen(&mut sim), &was[goal]);
            let further = further.min((was.len() - 1 - goal) as u64);
            sim.run(further);
            // The inputs of the next clock come with it.
            prop_assert_eq!(sim.get_u64(sim.o.sum), was[goal + further as usize].1[0]);
        }
    }

    #[test]
    fn a_condition_is_found_again(
        kind in 0..4usize,
        every in 1..40u64,
        inputs in prop::collection::vec(0..100u64, 1..200),
        number in 0..20u64,
        from in any::<usize>(),
    ) {
        let (mut sim, was) = run(KINDS[kind], 1 << 30, every, &inputs);
        let from = from % was.len();
        sim.go_to_cycle("clk", from as u64).unwrap();
        let expected = was[..from].iter().rev().find(|(_, [sum, ..], ..)| *sum == number).cloned();
        let found = sim.run_until_back(sim.o.sum.is(number)).unwrap();
        prop_assert_eq!(found, expected.as_ref().map(|seen| seen.0));
        prop_assert_eq!(seen(&mut sim), expected.unwrap_or(was[from].clone()));
        // Forward from there, the next one is found as it was.
        let next = was[(sim.time() / 10_000) as usize + 1..].iter().position(|(_, [sum, ..], ..)| *sum == number);
        let instants = (was.len() as u64 - 1) - sim.time() / 10_000;
        prop_assert_eq!(sim.run_until(sim.o.sum.is(number), instants), next.map(|instants| instants as u64 + 1));
    }
}

#[test]
fn memory_is_bounded_and_the_earliest_time_goes_first() {
    let inputs: Vec<u64> = (0..3000).map(|step| step * 7 % 50).collect();
    let (mut sim, was) = run(EngineKind::Compiled, 40_000, 10, &inputs);
    let Err(Error::Unremembered(Unremembered::Forgotten { time: 10_000, earliest })) = sim.go_to(10_000) else {
        panic!("all fits")
    };
    assert!((1_000_000..29_000_000).contains(&earliest), "{earliest}");
    for cycle in (earliest / 10_000..=3000).step_by(37) {
        sim.go_to_cycle("clk", cycle).unwrap();
        assert_eq!(seen(&mut sim), was[cycle as usize]);
    }
    assert!(sim.go_to(earliest - 1).is_err());
}

#[test]
fn fewer_checkpoints_are_kept_before_anything_is_forgotten() {
    let mut sim = Simulation::of(&Sums).unwrap();
    sim.remember_often(20_000, 10);
    sim.set(sim.i.enable, 1);
    sim.set(sim.i.x, 3);
    sim.run(20_000);
    sim.go_to_cycle("clk", 0).unwrap();
    assert_eq!(sim.get_u64(sim.o.sum), 0);
    sim.go_to_cycle("clk", 12_345).unwrap();
    assert_eq!(sim.get_u64(sim.o.sum), 12_345 * 3 % 256);
}

/// A simulation that remembers everything.
fn remembering() -> Simulation<SumsIn, SumsOut> {
    let mut sim = Simulation::of(&Sums).unwrap();
    sim.remember(1 << 20);
    sim.set(sim.i.enable, 1);
    sim.set(sim.i.x, 1);
    sim.run(100);
    sim
}

#[test]
fn what_is_set_in_the_past_makes_another_future() {
    let mut sim = remembering();
    sim.go_to_cycle("clk", 50).unwrap();
    sim.set(sim.i.x, 2);
    sim.run(10);
    assert_eq!(sim.get_u64(sim.o.sum), 70);
    sim.go_to_cycle("clk", 55).unwrap();
    assert_eq!(sim.get_u64(sim.o.sum), 60);
    // Time after the new present comes with the present inputs.
    sim.go_to_cycle("clk", 100).unwrap();
    assert_eq!(sim.get_u64(sim.o.sum), 150);
}

#[test]
fn another_state_is_another_past() {
    let mut sim = remembering();
    let checkpoint = sim.checkpoint();
    sim.run(50);
    sim.restore(&checkpoint).unwrap();
    sim.run(10);
    let error = sim.go_to_cycle("clk", 99).unwrap_err().to_string();
    let said =
        "990000 ps is forgotten: the simulation remembers the time from 1000000 ps on, so give `remember` more memory";
    assert_eq!(error, said);
    sim.go_to_cycle("clk", 105).unwrap();
    assert_eq!(sim.get_u64(sim.o.sum), 105);
}

#[test]
#[should_panic(expected = "a trace is attached, whose time cannot go back: end it with `finish`")]
fn a_trace_does_not_go_back() {
    let mut sim = remembering();
    let folder = tempfile::tempdir().unwrap();
    sim.trace(Vcd::to(folder.path().join("sums.vcd"))).unwrap();
    let _ = sim.go_to(0);
}

#[test]
fn a_trace_may_be_made_of_the_past() {
    let mut sim = remembering();
    sim.go_to_cycle("clk", 5).unwrap();
    let wave = sim.record(["sum"]);
    sim.run(3);
    assert!(wave.to_string().ends_with("sum | 5 | 6 | 7 |\n"), "{wave}");
}

#[test]
fn a_damaged_file_is_refused() {
    use tilewright_sim::{Checkpoint, CheckpointError};
    let mut sim = remembering();
    let mut file = Vec::new();
    sim.checkpoint().write(&mut file).unwrap();
    for byte in 0..file.len() {
        let mut damaged = file.clone();
        damaged[byte] ^= 0x10;
        assert!(Checkpoint::read(&damaged[..], &sim).is_err(), "byte {byte}");
        assert!(Checkpoint::read(&file[..byte], &sim).is_err(), "{byte} bytes");
    }
    file.push(0);
    assert!(matches!(Checkpoint::read(&file[..], &sim), Err(CheckpointError::Damaged)));
}
