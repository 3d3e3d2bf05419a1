//! Clocks whose registers act where they fall, on every engine and in waves.

use std::path::PathBuf;

use tilewright_hdl::*;
use tilewright_sim::{EngineKind, Simulation, Vcd};

const BUS: Clock = Clock::new("bus", Period::ns(30));

block! {
    /// A counter on the own clock, and one on a bus.
    struct Counters { bus: Clock }
    out CountersOut { own: bits(8), other: bits(8) }
}

impl Counters {
    fn build(&self, m: Module, _: ()) -> CountersOut {
        let on = |m: Module, name: &str| {
            let count = m.reg(name, 8).reset(0);
            count.next(count + 1);
            *count
        };
        CountersOut { own: on(m, "own"), other: on(m.on(self.bus), "other") }
    }
}

block! {
    /// A counter.
    struct Counter;
    out CounterOut { count: bits(8) }
}

impl Counter {
    fn build(&self, m: Module, _: ()) -> CounterOut {
        def!(count = m.reg(8).reset(0));
        count.next(count + 1);
        CounterOut { count: *count }
    }
}

#[test]
fn a_falling_clock_is_high_first_and_counts_where_it_falls() {
    for kind in [EngineKind::Interpreter, EngineKind::Compiled, EngineKind::Both] {
        let mut sim = Simulation::of(&Counters { bus: BUS.falling() }).unwrap().on(kind);
        let wave = sim.record([sim.o.own, sim.o.other]);
        sim.run(7);
        wave.expect(
            r"
            clk     |___/~\_/~\_/~\_/~\_/~\_/~\_/
            bus_clk |~~~~~~~~~~~\_____/~~~~~\____
            own     | 0 | 1 | 2 | 3 | 4 | 5 | 6 |
            other   | 0         | 1         | 2 |",
        );
    }
}

/// The lines of a waveform, and the characters that stand for its variables.
fn waveform<B: Block>(block: &B, clock: DefaultClock, kind: EngineKind) -> Vec<String> {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("edges_{:?}.vcd", kind));
    let mut sim = Simulation::at(block, clock).unwrap().on(kind);
    sim.trace(Vcd::to(&path)).unwrap();
    sim.run(50);
    sim.reset();
    sim.run(50);
    sim.finish().unwrap();
    std::fs::read_to_string(path).unwrap().lines().map(str::to_owned).collect()
}

/// The waveform with the other levels of a clock.
fn inverted(lines: &[String], clock: &str) -> Vec<String> {
    let declared = lines.iter().find(|line| line.starts_with("$var") && line.ends_with(&format!(" {clock} $end")));
    let id = declared.expect("a clock").split_whitespace().nth(3).unwrap();
    let invert = |line: &String| match line.strip_suffix(id) {
        Some("0") => format!("1{id}"),
        Some("1") => format!("0{id}"),
        _ => line.clone(),
    };
    lines.iter().map(invert).collect()
}

/// One clock is written in rows, several are written step by step.
#[test]
fn a_waveform_differs_in_the_levels_of_the_clock_alone() {
    let own = DefaultClock::new(DEFAULT_PERIOD);
    for kind in [EngineKind::Reference, EngineKind::Compiled] {
        let rising = waveform(&Counter, own, kind);
        assert!(rising == inverted(&waveform(&Counter, own.falling(), kind), "clk"), "{kind:?}");
        let rising = waveform(&Counters { bus: BUS }, own, kind);
        let falling = waveform(&Counters { bus: BUS.falling() }, own, kind);
        assert!(rising == inverted(&falling, "bus_clk") && rising != falling, "{kind:?}");
    }
}
