//! Every kind of reset, on every engine.

use tilewright_hdl::*;
use tilewright_sim::{EngineKind, Simulation, Vcd};

const VIDEO: Clock = Clock::new("video", Period::ns(30)).reset(Reset::AsynchronousLow);

block! {
    /// A counter from 5 on, a ring of lanes, its sum a clock later, and the same counter four times.
    struct Counters;
    in CountersIn { enable: bit() }
    out CountersOut { count: bits(8), ring: bits(4).of(row(3)), sum: bits(4), late: bits(8), others: bits(8) }
}

impl Counters {
    fn build(&self, m: Module, i: CountersIn) -> CountersOut {
        def!(count = m.reg(8).reset(5));
        count.enable(i.enable).next(count + 1);
        def!(ring = m.reg(bits(4).of(row(3))).reset_each([7, 8, 9]));
        ring.next(ring.previous(ring.last()));
        def!(sum = ring.sum());
        def!(late = m.pipe(*count));
        let cells = m.array("u_cell", 4, &Cell, |_| CellIn { enable: i.enable.of(row(4)) });
        m.assert(count.ne(40), "it does not come to 40");
        CountersOut { count: *count, ring: *ring, sum, late, others: cells.count.sum() }
    }
}

block! {
    /// A counter from 1 on.
    struct Cell;
    in CellIn { enable: bit() }
    out CellOut { count: bits(8) }
}

impl Cell {
    fn build(&self, m: Module, i: CellIn) -> CellOut {
        def!(count = m.reg(8).reset(1).when(i.enable, 2));
        CellOut { count: *count }
    }
}

const ENGINES: [EngineKind; 4] =
    [EngineKind::Reference, EngineKind::Interpreter, EngineKind::Compiled, EngineKind::Both];

fn simulation(reset: Reset, engine: EngineKind) -> Simulation<CountersIn, CountersOut> {
    let clock = DefaultClock::new(DEFAULT_PERIOD).reset(reset);
    let mut sim = Simulation::at(&Counters, clock).unwrap().on(engine);
    sim.set(sim.i.enable, 1);
    sim
}

/// Count, ring, sum, the count before and the sum of the cells.
fn state(sim: &mut Simulation<CountersIn, CountersOut>) -> [u64; 5] {
    let o = &sim.o;
    [o.count, o.ring, o.sum, o.late, o.others].map(|port| sim.get_u64(port))
}

#[test]
fn all_kinds_begin_alike() {
    for (reset, engine) in Reset::ALL.into_iter().flat_map(|reset| ENGINES.map(|engine| (reset, engine))) {
        let mut sim = simulation(reset, engine);
        assert_eq!(state(&mut sim), [5, 0x987, 8, 0, 4], "{reset:?} {engine:?}");
        sim.run(2);
        assert_eq!(state(&mut sim), [7, 0x798, 8, 6, 8], "{reset:?} {engine:?}");
    }
}

#[test]
fn a_reset_takes_effect_at_the_edge_or_at_once() {
    for (reset, engine) in Reset::ALL[..4].iter().flat_map(|reset| ENGINES.map(|engine| (*reset, engine))) {
        let mut sim = simulation(reset, engine);
        sim.run(4);
        let running = [9, 0x987 << 4 & 0xfff | 0x9, 8, 8, 8];
        assert_eq!(state(&mut sim), running, "{reset:?} {engine:?}");
        sim.set_reset("clk", true);
        // The pipeline has no reset.
        let is_set = [5, 0x987, 8, 8, 4];
        let expected = if reset.is_asynchronous() { is_set } else { running };
        assert_eq!(state(&mut sim), expected, "{reset:?} {engine:?}");
        sim.step();
        let late = if reset.is_asynchronous() { 5 } else { 9 };
        assert_eq!(state(&mut sim), [5, 0x987, 8, late, 4], "{reset:?} {engine:?}");
        sim.run(3);
        assert_eq!(state(&mut sim), [5, 0x987, 8, 5, 4], "{reset:?} {engine:?}");
        // The release counts from the next edge.
        sim.set_reset("clk", false);
        assert_eq!(state(&mut sim), [5, 0x987, 8, 5, 4], "{reset:?} {engine:?}");
        sim.step();
        assert_eq!(state(&mut sim), [6, 0x879, 8, 5, 8], "{reset:?} {engine:?}");
    }
}

#[test]
fn without_a_reset_nothing_goes_back() {
    for engine in ENGINES {
        let mut sim = simulation(Reset::PowerOn, engine);
        sim.run(3);
        sim.reset();
        assert_eq!(state(&mut sim)[0], 9, "{engine:?}: an edge like all others");
        // Assertions are checked as ever.
        let failed = (0..40).find_map(|_| sim.try_reset().err()).unwrap();
        assert!(failed.to_string().contains("it does not come to 40"), "{failed}");
    }
}

block! {
    /// A counter on the own clock, and one on another.
    struct TwoClocks;
    out TwoClocksOut { own: bits(8), video: bits(8) }
}

impl TwoClocks {
    fn build(&self, m: Module, _: ()) -> TwoClocksOut {
        let on = |m: Module, name| {
            let count = m.reg(name, 8).reset(0);
            count.next(count + 1);
            *count
        };
        TwoClocksOut { own: on(m, "own_count"), video: on(m.on(VIDEO), "video_count") }
    }
}

#[test]
fn each_clock_has_its_own_kind() {
    for engine in ENGINES {
        let mut sim = Simulation::of(&TwoClocks).unwrap().on(engine);
        sim.run_to(60_000);
        let counts = |sim: &mut Simulation<(), TwoClocksOut>| [sim.o.own, sim.o.video].map(|port| sim.get_u64(port));
        assert_eq!(counts(&mut sim), [6, 2]);
        sim.set_reset(VIDEO, true);
        assert_eq!(counts(&mut sim), [6, 0], "{engine:?}");
        sim.step();
        assert_eq!(counts(&mut sim), [7, 0], "{engine:?}");
        sim.set_reset("video", false);
        sim.run_to(90_000);
        assert_eq!(counts(&mut sim), [9, 1], "{engine:?}");
        sim.reset();
        assert_eq!((counts(&mut sim), sim.time()), ([0, 0], 120_000), "{engine:?}");
    }
}

#[test]
fn a_trace_shows_the_level_of_the_port() {
    let folder = tempfile::tempdir().unwrap();
    let text = |reset: Reset| {
        let file = folder.path().join("counters.vcd");
        let mut sim = simulation(reset, EngineKind::Compiled);
        sim.trace(Vcd::to(&file).only("rst*").only("count")).unwrap();
        sim.run(2);
        sim.set_reset("clk", true);
        sim.run(2);
        sim.set_reset("clk", false);
        sim.run(1);
        sim.finish().unwrap();
        let text = std::fs::read_to_string(&file).unwrap();
        let (_, changes) = text.split_once("$enddefinitions $end").unwrap();
        (text.contains(" rst_n $end"), changes.replace('\n', " "))
    };
    let (low, changes) = text(Reset::AsynchronousLow);
    assert!(low);
    // It is low from 20 ns, where the count goes back, and released halfway between two edges.
    assert_eq!(
        changes,
        " #0 $dumpvars b101 # 0! 1\" $end #10000 b110 # 1! #15000 0! #20000 b101 # 1! 0\" #25000 0! #30000 1! #35000 0! \
         #40000 1! #45000 0! 1\" #50000 b110 # 1! #55000 0! #60000 "
    );
    let (low, changes) = text(Reset::Synchronous);
    assert!(!low);
    assert_eq!(
        changes,
        " #0 $dumpvars b101 # 0! 0\" $end #10000 b110 # 1! #15000 0! #20000 b111 # 1! 1\" #25000 0! #30000 b101 # 1! #35000 0! \
         #40000 1! 0\" #45000 0! #50000 b110 # 1! #55000 0! #60000 "
    );
}

/// The count goes back at 40 ns, between two edges of its own clock.
#[test]
fn a_trace_sees_what_a_reset_of_another_clock_does() {
    for engine in ENGINES {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("clocks.vcd");
        let mut sim = Simulation::of(&TwoClocks).unwrap().on(engine);
        sim.trace(Vcd::to(&file).only("video_count")).unwrap();
        sim.run_to(40_000);
        sim.set_reset(VIDEO, true);
        sim.run_to(70_000);
        sim.finish().unwrap();
        let text = std::fs::read_to_string(&file).unwrap();
        assert!(text.replace('\n', " ").contains(" #40000 b0 # "), "{engine:?}\n{text}");
    }
}

#[test]
#[should_panic(expected = "clock `clk` has no reset: its registers have their values at power-on in a new simulation")]
fn what_has_no_reset_cannot_be_reset() {
    simulation(Reset::PowerOn, EngineKind::Compiled).set_reset("clk", true);
}

#[test]
#[should_panic(expected = "there is no clock `clock`")]
fn only_a_clock_has_a_reset() {
    simulation(Reset::Synchronous, EngineKind::Compiled).set_reset("clock", true);
}

#[test]
#[should_panic(
    expected = "the reset of clock `clk` is released at the time at which it became active: step in between"
)]
fn an_asynchronous_reset_is_no_pulse_between_two_edges() {
    let mut sim = simulation(Reset::Asynchronous, EngineKind::Compiled);
    sim.run(3);
    sim.set_reset("clk", true);
    sim.set_reset("clk", false);
}

#[test]
fn a_synchronous_reset_between_two_edges_is_none() {
    let mut sim = simulation(Reset::SynchronousLow, EngineKind::Both);
    sim.run(3);
    sim.set_reset("clk", true);
    sim.set_reset("clk", false);
    sim.step();
    assert_eq!(state(&mut sim)[0], 9);
}
