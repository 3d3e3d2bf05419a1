//! Looks at the same values for many cycles, as most testbenches do, with any action between two looks.

use std::path::Path;

use tilewright_hdl::{Bits, Module, ReadUnderWrite, bit, bits, block, def, elaborate, lit, mux};
use tilewright_sim::{EngineKind, Passes, Simulation, Vcd};

use crate::circuits::store::Store;

block! {
    /// Registers of all kinds, plain and enabled, narrow and wide, with a given number of others beside them; memories
    /// read asynchronously and synchronously, and written by two ports.
    struct Machine { beside: u32 }
    in In { add: bits(8), gate: bit(), wide: bits(70), go: bit() }
    out Out { sum: _, next: _, gated: _, word: _, fetched: _, total: _, widened: _ }
}

impl Machine {
    fn build(&self, m: Module, i: In) -> Out {
        let sum = m.reg("sum", 8).reset(3);
        let words = m.memory("words", 16, 8, ReadUnderWrite::Old).fill(Bits::zero(8)).true_dual_port();
        let later = m.memory("later", 8, 8, ReadUnderWrite::Any).fill(Bits::new(8, 5));
        def!(found = words.read_async(sum.slice(0..4)));
        def!(coming = sum + i.add + found);
        // Always zero while the input is low.
        def!(gated = coming & i.gate.repeat(8));
        def!(widened = i.wide ^ coming.zext(70));
        let total = m.reg("total", 70).reset(0);
        total.enable(i.go | sum.bit(0)).next(total + widened);
        let fetched = later.read_when(i.go, sum.slice(1..4));
        later.write(i.gate, coming.slice(0..3), total.trunc(8));
        words.write(i.go, sum.slice(4..8), coming);
        words.write(coming.bit(3), coming.slice(0..4), gated);
        sum.next(coming);
        m.assert(coming.ne(99), "nobody gets to 99");
        for number in 0..self.beside {
            let beside = m.reg(&format!("beside{number}"), 9).reset(0);
            beside.next(mux(i.gate, beside + coming.zext(9), beside + lit(9, 1)));
        }
        Out { sum: *sum, next: coming, gated, word: found, fetched, total: *total, widened }
    }
}

/// Pseudo-random numbers.
struct Chance(u64);

impl Chance {
    fn below(&mut self, end: u64) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % end
    }
}

/// Everything seen by a testbench that looks at the same values for a while, and then does something else.
fn seen(design: &Machine, seed: u64, kind: EngineKind, passes: &Passes, file: &Path) -> Vec<String> {
    let mut sim = Simulation::with_passes(&elaborate(design).unwrap(), passes).unwrap().on(kind);
    let ports = ["sum", "next", "gated", "word", "fetched", "total", "widened"].map(|name| sim.port(name).unwrap());
    let [add, gate, wide, go] = ["add", "gate", "wide", "go"].map(|name| sim.port(name).unwrap());
    let (mut seen, mut chance) = (Vec::new(), Chance(seed));
    for round in 0..50 {
        let looked_at: Vec<_> = ports.iter().filter(|_| chance.below(3) == 0).collect();
        for _ in 0..[2, 12, 70][chance.below(3) as usize] {
            let step = sim.try_step().map_err(|error| error.to_string());
            let values: Vec<Bits> = looked_at.iter().map(|port| sim.get(**port)).collect();
            seen.push(format!("{round} {step:?} {values:?} {} {:?}", sim.time(), sim.cycles("clk")));
        }
        match chance.below(12) {
            0 => sim.set(add, chance.below(256)),
            1 => sim.set(gate, chance.below(2)),
            2 => sim.set(wide, Bits::from_limbs(70, &[chance.below(1 << 31), chance.below(64)])),
            3 => sim.set(go, chance.below(2)),
            4 => sim.poke_memory("words", chance.below(16) as u32, chance.below(256)).unwrap(),
            5 => sim.try_reset().unwrap(),
            6 => seen.push(format!("{:?}", sim.try_run(chance.below(90)).map_err(|error| error.to_string()))),
            7 => {
                let (port, number) = (ports[chance.below(3) as usize], chance.below(256));
                seen.push(format!("{:?}", sim.try_run_until(port.is(number), 40).map_err(|error| error.to_string())));
            }
            8 => seen.push(format!("{} {}", sim.peek("total").unwrap(), sim.peek("coming").unwrap())),
            9 => {
                seen.push(format!("{:?}", (0..16).map(|at| sim.peek_memory("words", at).unwrap()).collect::<Vec<_>>()))
            }
            10 => {
                sim.trace(Vcd::to(file)).unwrap();
                seen.push(format!("{:?}", sim.try_run(chance.below(20)).map_err(|error| error.to_string())));
                sim.finish().unwrap();
                seen.push(std::fs::read_to_string(file).unwrap());
            }
            _ => {
                // A value that was changed and restored is a new moment all the same.
                let before = sim.get(ports[1]);
                sim.set(add, 1);
                seen.push(sim.get(ports[1]).to_string());
                sim.set(add, 0);
                seen.push(format!("{before} {}", sim.get(ports[1])));
            }
        }
    }
    seen
}

#[test]
fn whatever_comes_between_two_looks_is_seen_by_the_next() {
    let folder = tempfile::tempdir().unwrap();
    let file = &folder.path().join("looks.vcd");
    let mut stops = 0;
    // With few registers, a look keeps all changes of an edge; with many, only what it computes anyway.
    for (beside, seed) in [(0, 1), (0, 2), (80, 3)] {
        let design = &Machine { beside };
        let expected = seen(design, seed, EngineKind::Reference, &Passes::default(), file);
        stops += expected.iter().filter(|line| line.contains("nobody gets to 99")).count();
        for (looks_after, held_after, longest) in [(1, 3, 500), (3, 30, 15), (2, u64::MAX, 15), (u64::MAX, 3, 500)] {
            let passes = Passes { looks_after, held_after, longest, ..Passes::default() };
            let seen = seen(design, seed, EngineKind::Compiled, &passes, file);
            let first = seen.iter().zip(&expected).position(|(seen, expected)| seen != expected);
            assert_eq!(first.map(|at| (&seen[at], &expected[at])), None, "{beside} {seed} {passes:?}");
        }
    }
    assert!(stops > 2, "assertions are to fail as well");
}

#[test]
fn looks_between_edges_of_two_clocks_see_each() {
    let seen = |kind: EngineKind, looks_after: u64| {
        let passes = Passes { looks_after, held_after: 5, ..Passes::default() };
        let design = elaborate(&Store { policy: ReadUnderWrite::Any }).unwrap();
        let mut sim = Simulation::with_passes(&design, &passes).unwrap().on(kind);
        let inputs = ["write", "to", "data", "read", "from"].map(|name| (sim.port(name).unwrap(), name));
        let [word, at_once] = ["word", "at_once"].map(|name| sim.port(name).unwrap());
        let (mut chance, mut seen) = (Chance(3), Vec::new());
        for _ in 0..200 {
            let (input, name) = inputs[chance.below(5) as usize];
            let end = match name {
                "write" | "read" => 2,
                "data" => 256,
                _ => 4,
            };
            sim.set(input, chance.below(end));
            for _ in 0..chance.below(6) {
                sim.step();
                seen.push((sim.time(), sim.get_u64(word), sim.get_u64(at_once)));
            }
        }
        seen
    };
    let expected = seen(EngineKind::Reference, u64::MAX);
    for looks_after in [1, 4, u64::MAX] {
        assert_eq!(seen(EngineKind::Compiled, looks_after), expected, "after {looks_after} looks");
    }
}

#[test]
fn a_run_may_end_by_what_held_inputs_make_a_constant() {
    let passes = Passes { held_after: 3, ..Passes::default() };
    let mut sim = Simulation::with_passes(&elaborate(&Machine { beside: 0 }).unwrap(), &passes).unwrap();
    let [gated, gate] = ["gated", "gate"].map(|name| sim.port(name).unwrap());
    sim.run(20);
    assert_eq!(sim.run_until(gated.is(1), 20), None);
    sim.set(gate, 1);
    sim.run(20);
    assert_eq!(sim.run_until(gated.is_not(0), 20), Some(1));
}
