//! The engines agree in everything that a testbench can see, whatever it does: values, names inside, memories,
//! errors, times, waveform files, text waves and recordings.

use std::fs;

use proptest::prelude::*;
use tilewright_hdl::{
    Bits, Block, Clock, Module, Period, ReadUnderWrite, Width, bit, bits, bundle, codes, constants, def, goto, mux,
    when,
};
use tilewright_sim::program::hierarchy;
use tilewright_sim::{Checkpoint, EngineKind, Error, Simulation, Vcd};

const FAST: Clock = Clock::new("fast", Period::ps(2_000));
const SLOW: Clock = Clock::new("slow", Period::ps(3_000));

bundle! {
    pub struct CellIn<T> { pub enable: T, pub left: T, pub own: T, pub wide: T, pub pick: T }
    pub struct CellOut<T> { pub value: T, pub total: T, pub word: T, pub seen: T }
}

codes! {
    enum Phase { Idle, Busy, Done }
}

/// Registers with a reset and without, a memory between two clocks, a state machine, an assertion.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Cell;

impl Block for Cell {
    type In = CellIn;
    type Out = CellOut;

    fn inputs(&self) -> CellIn<Width> {
        let fast = |width| bits(width).on(FAST);
        CellIn { enable: bit().on(FAST), left: fast(8), own: fast(8), wide: fast(70), pick: bits(3).on(SLOW) }
    }

    fn build(&self, m: Module, i: CellIn) -> CellOut {
        let (fast, slow) = (m.on(FAST), m.on(SLOW));
        let value = fast.reg("value", 8);
        let total = fast.reg("total", 70).reset(3);
        let phase = fast.fsm("phase", Phase::Idle);
        phase.next(|now| match now {
            Phase::Idle => when(i.enable, Phase::Busy),
            Phase::Busy => goto(Phase::Done),
            Phase::Done => when(i.left.bit(0), Phase::Idle),
        });
        def!(sum = i.left + i.own + *value);
        value.enable(i.enable).next(sum);
        total.next(*total + mux(phase.is(Phase::Busy), i.wide, sum.zext(70)));
        let store = m.memory("store", 5, 8, ReadUnderWrite::Any);
        store.on(FAST).write(i.enable, value.slice(0..3), sum);
        fast.assert(!(i.enable & i.left.eq(77)), "the left one says 77");
        CellOut {
            value: *value,
            total: *total,
            word: store.on(SLOW).read(i.pick) ^ store.on(SLOW).read_async(i.pick).quasi_static("the test samples it"),
            seen: slow.pipe("seen", value.quasi_static("the test samples it")),
        }
    }
}

bundle! {
    pub struct RowIn<T> { pub enable: T, pub x: T, pub wide: T, pub pick: T }
    pub struct RowOut<T> { pub sum: T, pub last: T, pub total: T, pub word: T, pub seen: T }
}

/// A chain of cells.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
struct Row {
    lanes: u32,
}

impl Block for Row {
    type In = RowIn;
    type Out = RowOut;

    fn inputs(&self) -> RowIn<Width> {
        RowIn { enable: bit().on(FAST), x: bits(8).on(FAST), wide: bits(70).on(FAST), pick: bits(3).on(SLOW) }
    }

    fn build(&self, m: Module, i: RowIn) -> RowOut {
        let cells = m.array("u_cell", self.lanes, &Cell, |a| CellIn {
            enable: i.enable,
            left: a.value.following(i.x),
            own: constants(bits(8).of(self.lanes), |lane| u64::from(5 * lane % 16)),
            wide: i.wide,
            pick: i.pick,
        });
        m.on(SLOW).assert(i.pick.ne(7), "nobody picks 7");
        RowOut {
            sum: cells.value.sum(),
            last: cells.value.last(),
            total: cells.total.xor_all(),
            word: cells.word.or_all(),
            seen: cells.seen.xor_all(),
        }
    }
}

/// An action of a testbench.
#[derive(Debug, Clone)]
enum Act {
    Drive { enable: u64, x: u64, wide: u128, pick: u64 },
    Step,
    Run(u64),
    RunUntil(u64),
    Ticks(bool, u64),
    Reset,
    Poke { lane: u32, address: u32, word: u64 },
    PeekAll,
}

fn act() -> impl Strategy<Value = Act> {
    let x = prop_oneof![4 => 0..=255u64, 1 => Just(77)];
    prop_oneof![
        4 => (0..2u64, x, any::<u128>(), 0..8u64)
            .prop_map(|(enable, x, wide, pick)| Act::Drive { enable, x, wide: wide >> 58, pick }),
        4 => Just(Act::Step),
        2 => (0..9u64).prop_map(Act::Run),
        1 => (0..20_000u64).prop_map(Act::RunUntil),
        1 => (any::<bool>(), 0..4u64).prop_map(|(fast, ticks)| Act::Ticks(fast, ticks)),
        1 => Just(Act::Reset),
        2 => (0..3u32, 0..5u32, 0..256u64).prop_map(|(lane, address, word)| Act::Poke { lane, address, word }),
        2 => Just(Act::PeekAll),
    ]
}

/// Every name of the circuit that `peek` accepts, and that of every memory.
fn names(sim: &Simulation<RowIn, RowOut>) -> (Vec<String>, Vec<String>) {
    let hierarchy = &sim.program().hierarchy;
    let (mut signals, mut memories) = (Vec::new(), Vec::new());
    for place in hierarchy.places(0) {
        let scope = hierarchy.scope(place.scope);
        memories.extend(scope.memories.iter().map(|(name, ..)| hierarchy.path_in(place, name)));
        for signal in &scope.signals {
            let name = hierarchy.path_in(place, &signal.name);
            let lanes = 0..signal.shape.lanes();
            signals.extend(lanes.map(|lane| format!("{name}{}", hierarchy::index(signal.shape, lane))));
        }
    }
    (signals, memories)
}

/// Does what a testbench does in this action.
fn perform(sim: &mut Simulation<RowIn, RowOut>, act: &Act) -> Result<(), Error> {
    match act {
        Act::Drive { enable, x, wide, pick } => {
            let wide = Bits::from_limbs(70, &[*wide as u64, (*wide >> 64) as u64]);
            let [enable, x, pick] = [(1, *enable), (8, *x), (3, *pick)].map(|(width, value)| Bits::new(width, value));
            sim.drive_bits(RowIn { enable, x, wide, pick });
        }
        Act::Step => sim.try_step()?,
        Act::Run(n) => sim.try_run(*n)?,
        Act::RunUntil(later) => sim.try_run_to(sim.time() + later)?,
        Act::Ticks(fast, ticks) => {
            // An assertion panics here: with these inputs none fails.
            let enable = sim.peek("enable").unwrap();
            sim.set(sim.i.enable, 0);
            sim.set(sim.i.pick, 1);
            if *fast {
                sim.step_clock(FAST, *ticks);
            } else {
                sim.step_clock("slow_clk", *ticks);
            }
            sim.set(sim.i.enable, &enable);
        }
        Act::Reset => sim.try_reset()?,
        Act::Poke { lane, address, word } => {
            sim.poke_memory(&format!("u_cell[{lane}].store"), *address, *word).unwrap();
        }
        Act::PeekAll => {}
    }
    Ok(())
}

/// The value of every name, and the words of every memory.
fn everything(sim: &mut Simulation<RowIn, RowOut>) -> Vec<String> {
    let (signals, memories) = names(sim);
    let mut seen: Vec<String> = signals.iter().map(|name| format!("{name} = {:?}", sim.peek(name).unwrap())).collect();
    for name in &memories {
        let words = (0..5).map(|address| sim.peek_memory(name, address).unwrap());
        seen.push(format!("{name} = {:?}", words.collect::<Vec<_>>()));
    }
    seen
}

/// Everything seen during these actions on an engine.
fn transcript(row: Row, kind: EngineKind, seed: u64, observed: bool, acts: &[Act]) -> Vec<String> {
    let mut sim = Simulation::of(&row).unwrap().on(kind).seeded(seed);
    assert_eq!(sim.engine(), kind);
    let (signals, memories) = names(&sim);
    assert!(
        signals.len() > 10 * row.lanes as usize && memories.len() == row.lanes as usize,
        "{signals:?} {memories:?}"
    );
    let folder = tempfile::tempdir().unwrap();
    let files = ["whole.vcd", "some.vcd", "last.vcd"].map(|name| folder.path().join(name));
    let mut wave = None;
    let mut recording = None;
    if observed {
        sim.trace(Vcd::to(&files[0])).unwrap();
        sim.trace(Vcd::to(&files[1]).only("u_cell[1].**").times(4_000..30_000)).unwrap();
        sim.trace(Vcd::to(&files[2]).last(5)).unwrap();
        wave = Some(sim.record(["enable", "sum", "u_cell[0].phase", "u_cell[1].sum", "u_cell[2].total", "seen"]));
        recording = (seed == 0).then(|| sim.recording());
    }
    let mut seen = Vec::new();
    for act in acts {
        let result = match act {
            // A recording accepts no more of them.
            Act::Poke { .. } if recording.is_some() && sim.time() > 0 => Ok(()),
            Act::PeekAll => {
                seen.extend(everything(&mut sim));
                Ok(())
            }
            act => perform(&mut sim, act),
        };
        seen.push(format!(
            "{act:?} at {}: {}",
            sim.time(),
            result.map_or_else(|error| error.to_string(), |()| "done".to_owned())
        ));
        seen.push(format!("{:?} {:?} {:?}", sim.cycles("fast"), sim.cycles("slow"), sim.read()));
    }
    seen.push(format!("{:?}", sim.finish().map_err(|error| error.to_string())));
    seen.extend(wave.map(|wave| wave.to_string()));
    seen.extend(recording.map(|recording| format!("{:#?}", recording.take())));
    // The flight recorder leaves a file if an assertion fails.
    seen.extend(files.iter().map(|file| fs::read_to_string(file).unwrap_or_else(|_| "no file".to_owned())));
    seen
}

#[track_caller]
fn assert_alike(row: Row, seed: u64, observed: bool, acts: &[Act]) {
    let reference = transcript(row, EngineKind::Reference, seed, observed, acts);
    for kind in [EngineKind::Interpreter, EngineKind::Compiled, EngineKind::Both] {
        let other = transcript(row, kind, seed, observed, acts);
        assert_eq!(reference.len(), other.len());
        for (expected, got) in reference.iter().zip(&other) {
            assert_eq!(expected, got, "on {kind:?}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_testbench_sees_the_same_on_every_engine(
        lanes in 3..6u32,
        seed in prop_oneof![Just(0), 1..99u64],
        observed: bool,
        acts in prop::collection::vec(act(), 1..40),
    ) {
        assert_alike(Row { lanes }, seed, observed, &acts);
    }
}

/// Another engine goes on from a checkpoint as the first one does.
fn assert_goes_on(kinds: [EngineKind; 2], seed: u64, before: &[Act], after: &[Act]) {
    let row = Row { lanes: 4 };
    let [mut sim, mut other] = kinds.map(|kind| Simulation::of(&row).unwrap().on(kind).seeded(seed));
    for act in before {
        let _ = perform(&mut sim, act);
    }
    let checkpoint = sim.checkpoint();
    let mut file = Vec::new();
    checkpoint.write(&mut file).unwrap();
    // The other one has been elsewhere.
    let _ = perform(&mut other, &Act::Drive { enable: 1, x: 3, wide: 9, pick: 2 });
    let _ = other.try_run(5);
    let read = Checkpoint::read(&file[..], &other).unwrap();
    assert_eq!(read, checkpoint);
    other.restore(&read).unwrap();
    assert_eq!((everything(&mut other), other.time()), (everything(&mut sim), sim.time()));
    assert_eq!(other.checkpoint(), checkpoint);
    for act in after {
        let results = [&mut sim, &mut other].map(|sim| perform(sim, act).map_err(|error| error.to_string()));
        assert_eq!(results[0], results[1], "{act:?}");
        assert_eq!(everything(&mut other), everything(&mut sim), "{act:?}");
    }
    assert_same(&sim.checkpoint(), &other.checkpoint());
}

/// Where these actions went, everything is there again as it was.
fn assert_remembers(kind: EngineKind, (bytes, instants): (usize, u64), acts: &[Act], places: &[usize]) {
    let mut sim = Simulation::of(&Row { lanes: 4 }).unwrap().on(kind);
    sim.remember_often(bytes, instants);
    let mut was = vec![(0, everything(&mut sim))];
    // `Ticks` gives other inputs at the time at which it begins.
    for act in acts.iter().filter(|act| !matches!(act, Act::Ticks(..))) {
        let _ = perform(&mut sim, act);
        if was.last().is_some_and(|(time, _)| *time == sim.time()) {
            was.pop();
        }
        was.push((sim.time(), everything(&mut sim)));
    }
    let (present, end) = (sim.time(), sim.checkpoint());
    for place in places {
        let (time, expected) = &was[place % was.len()];
        match sim.go_to(*time) {
            Ok(()) => assert_eq!((sim.time(), &everything(&mut sim)), (*time, expected)),
            Err(Error::Unremembered(_)) => assert!(bytes < 10_000),
            Err(error) => panic!("{error}"),
        }
    }
    sim.go_to(present).unwrap();
    assert_same(&sim.checkpoint(), &end);
    // Another future, from the last place on, is that of a simulation that was never there.
    let mut other = Simulation::of(&Row { lanes: 4 }).unwrap().on(kind);
    if sim.go_to(was[places[0] % was.len()].0).is_ok() {
        other.restore(&sim.checkpoint()).unwrap();
        let apart = Act::Drive { enable: 1, x: 5, wide: 1 << 65, pick: 3 };
        for act in [&apart].into_iter().chain(acts) {
            let _ = [&mut sim, &mut other].map(|sim| perform(sim, act).is_ok());
        }
        assert_same(&sim.checkpoint(), &other.checkpoint());
    }
}

#[track_caller]
fn assert_same(one: &Checkpoint, other: &Checkpoint) {
    let differences = one.differences(other);
    assert!(differences.is_empty() && one == other, "{one:?}, {other:?}: {differences:?}");
}

const ALL: [EngineKind; 4] = [EngineKind::Reference, EngineKind::Interpreter, EngineKind::Compiled, EngineKind::Both];

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_engine_goes_on_from_a_checkpoint_of_any_other(
        kinds in (0..4usize, 0..4usize),
        seed in prop_oneof![Just(0), 1..99u64],
        before in prop::collection::vec(act(), 0..20),
        after in prop::collection::vec(act(), 1..20),
    ) {
        assert_goes_on([ALL[kinds.0], ALL[kinds.1]], seed, &before, &after);
    }

    #[test]
    fn a_simulation_goes_back_to_where_it_was(
        kind in 0..4usize,
        bytes in prop_oneof![Just(1 << 30), 500..10_000usize],
        instants in 1..9u64,
        acts in prop::collection::vec(act(), 1..40),
        places in prop::collection::vec(any::<usize>(), 1..12),
    ) {
        assert_remembers(ALL[kind], (bytes, instants), &acts, &places);
    }
}
