//! The cost of remembering the past, beside the same run without it: `cargo bench -p tilewright-benches --bench past`.

use std::hint::black_box;
use std::time::Instant;

use tilewright_benches::designs::{Processor, Simd, Vc1Frames};
use tilewright_hdl::Block;
use tilewright_rtl::parameter::Screen;
use tilewright_sim::Simulation;

/// The number of pairs of measurements; the best time of each side counts, because neighbours only add to it.
const ROUNDS: usize = 25;
/// Cycles of a measurement of a small circuit.
const CYCLES: u64 = 200_000;
/// Bytes that a simulation remembers with.
const BYTES: usize = 512 << 20;

/// Prints nanoseconds a cycle, without the past and with it, and how long it takes to go back.
fn compare<B: Block>(name: &str, block: &B, cycles: u64, run: impl Fn(&mut Simulation<B::In, B::Out>, u64)) {
    let sim = || Simulation::of(block).expect("the description has no mistake");
    let (mut plain, mut remembers) = (sim(), sim());
    remembers.remember(BYTES);
    let mut best = [f64::INFINITY; 2];
    for _ in 0..ROUNDS {
        for (sim, best) in [&mut plain, &mut remembers].into_iter().zip(&mut best) {
            let started = Instant::now();
            run(sim, cycles);
            *best = best.min(started.elapsed().as_secs_f64() * 1e9 / cycles as f64);
        }
    }
    assert_eq!(plain.checkpoint(), remembers.checkpoint(), "remembering changes something");
    let (end, started) = (remembers.time(), Instant::now());
    remembers.go_to(end / 3).expect("that time is remembered");
    let back = started.elapsed().as_secs_f64() * 1e3;
    remembers.go_to(end).expect("that time is remembered");
    assert_eq!(plain.checkpoint(), remembers.checkpoint(), "another present");
    println!("{name:42} {:8.2} {:8.2}   {:6.3} {back:8.2}", best[0], best[1], best[1] / best[0]);
}

fn main() {
    println!("{:42}       ns     with    ratio  ms back", "");
    compare("a processor of RV32I, run(n)", &Processor, CYCLES, |sim, cycles| sim.run(cycles));
    compare("a processor of RV32I, step", &Processor, CYCLES, |sim, cycles| (0..cycles).for_each(|_| sim.step()));
    compare("a processor of RV32I, set, step, get_u64", &Processor, CYCLES, |sim, cycles| {
        for number in 0..cycles {
            sim.set(sim.i.word, number & 0xffff);
            sim.step();
            black_box(sim.get_u64(sim.o.result));
        }
    });
    compare("64x64 processors of 8 bits, run(n)", &Simd { edge: 64 }, 4_000, |sim, cycles| sim.run(cycles));
    let screen = Screen { width: 320, height: 240 };
    let vc1 = Vc1Frames::new(screen, 3).expect("there is such a VC-1");
    compare("a VC-1 of 3 processors, run(n)", &vc1, 200_000, |sim, cycles| sim.run(cycles));
}
