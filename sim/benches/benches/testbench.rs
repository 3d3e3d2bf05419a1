//! The cost of a testbench that looks at every clock, beside a run without observers:
//! `cargo bench -p tilewright-benches --bench testbench`, or `.. -- step` for the measurements with that in their
//! names.

use std::hint::black_box;
use std::time::Instant;

use tilewright_benches::designs::{Dots, DotsIn, DotsOut, Processor, ProcessorIn, ProcessorOut};
use tilewright_sim::{Simulation, Vcd};

/// The number of measurements of each; the best time counts, because neighbours only add to it.
const ROUNDS: usize = 25;
/// Cycles of a measurement.
const CYCLES: u64 = 50_000;
/// Products, and so pairs of inputs, of the second design.
const PAIRS: u32 = 16;

type Core = Simulation<ProcessorIn, ProcessorOut>;
type Sums = Simulation<DotsIn, DotsOut>;

fn core() -> Core {
    let mut core = Simulation::of(&Processor).expect("the description has no mistake");
    core.drive(ProcessorIn { rst: 1, word: 12345 });
    core.step();
    core.set(core.i.rst, 0);
    core.run(CYCLES);
    core
}

fn sums() -> Sums {
    let mut sums = Simulation::of(&Dots { pairs: PAIRS }).expect("the description has no mistake");
    sums.run(CYCLES);
    sums
}

/// Nanoseconds for each of `count` calls.
fn timed<S>(sim: &mut S, count: u64, mut call: impl FnMut(&mut S, u64)) -> f64 {
    let started = Instant::now();
    (0..count).for_each(|number| call(sim, number));
    started.elapsed().as_secs_f64() * 1e9 / count as f64
}

/// The measurements, each with its function of the design.
type Measures<S> = Vec<(&'static str, fn(&mut S) -> f64)>;

/// The best time of each, measured round robin.
fn least<S>(mut sim: S, measures: &Measures<S>) -> Vec<f64> {
    let mut times = vec![f64::INFINITY; measures.len()];
    for _ in 0..ROUNDS {
        for ((_, measure), least) in measures.iter().zip(&mut times) {
            *least = least.min(measure(&mut sim));
        }
    }
    times
}

fn print<S>(design: &str, sim: S, mut measures: Measures<S>) {
    // Cargo itself adds `--bench`.
    let asked: Vec<String> = std::env::args().skip(1).filter(|it| !it.starts_with("--")).collect();
    measures.retain(|(name, _)| asked.is_empty() || asked.iter().any(|it| name.contains(it)));
    if measures.is_empty() {
        return;
    }
    let times = least(sim, &measures);
    println!("{design:44}        ns    ratio");
    for ((name, _), time) in measures.iter().zip(&times) {
        println!("  {name:42}  {time:8.1}  {:7.2}", time / times[0]);
    }
}

/// Runs a core for some cycles, with a waveform of everything.
fn traced(_: &mut Core) -> f64 {
    let folder = std::env::temp_dir().join(format!("tilewright-testbench-{}", std::process::id()));
    let mut sim = core();
    sim.trace(Vcd::to(&folder)).expect("a temporary file can be made");
    let time = timed(&mut sim, 1, |sim, _| {
        sim.run(CYCLES);
        sim.finish().expect("the file can be written");
    });
    std::fs::remove_file(folder).expect("it was made");
    time / CYCLES as f64
}

fn main() {
    let measures: Measures<Core> = vec![
        ("run(n), a cycle", |sim| timed(sim, 1, |sim, _| sim.run(CYCLES)) / CYCLES as f64),
        ("run_until a register is a number", |sim| {
            timed(sim, 1, |sim, _| {
                black_box(sim.run_until(sim.o.pc.is(1), CYCLES));
            }) / CYCLES as f64
        }),
        ("run_until a result is a number", |sim| {
            timed(sim, 1, |sim, _| {
                black_box(sim.run_until(sim.o.address.is(0xffff_ffff), CYCLES));
            }) / CYCLES as f64
        }),
        ("step", |sim| timed(sim, CYCLES, |sim, _| sim.step())),
        ("step, get of a register", |sim| {
            timed(sim, CYCLES, |sim, _| {
                sim.step();
                black_box(sim.get(sim.o.sum));
            })
        }),
        ("step, get_u64 of a register", |sim| {
            timed(sim, CYCLES, |sim, _| {
                sim.step();
                black_box(sim.get_u64(sim.o.sum));
            })
        }),
        ("step, get of a result", |sim| {
            timed(sim, CYCLES, |sim, _| {
                sim.step();
                black_box(sim.get(sim.o.result));
            })
        }),
        ("step, get_u64 of a result", |sim| {
            timed(sim, CYCLES, |sim, _| {
                sim.step();
                black_box(sim.get_u64(sim.o.result));
            })
        }),
        ("step, read_u64 of 7 ports", |sim| {
            timed(sim, CYCLES, |sim, _| {
                sim.step();
                black_box(sim.read_u64());
            })
        }),
        ("set, step, get_u64 of a result", |sim| {
            timed(sim, CYCLES, |sim, number| {
                sim.set(sim.i.word, number & 0xffff_ffff);
                sim.step();
                black_box(sim.get_u64(sim.o.result));
            })
        }),
        ("run(n) with a waveform of everything", traced),
    ];
    print("a processor of RV32I", core(), measures);
    let measures: Measures<Sums> = vec![
        ("run(n), a cycle", |sim| timed(sim, 1, |sim, _| sim.run(CYCLES)) / CYCLES as f64),
        ("32 sets", |sim| {
            timed(sim, CYCLES, |sim, number| {
                for pair in 0..PAIRS as usize {
                    sim.set(sim.i.left[pair], number & 0xff);
                    sim.set(sim.i.right[pair], number & 0xff);
                }
            })
        }),
        ("32 sets, step, get_u64", |sim| {
            timed(sim, CYCLES, |sim, number| {
                for pair in 0..PAIRS as usize {
                    sim.set(sim.i.left[pair], number & 0xff);
                    sim.set(sim.i.right[pair], number & 0xff);
                }
                sim.step();
                black_box(sim.get_u64(sim.o.sum));
            })
        }),
        ("set_list of 16 inputs, twice", |sim| {
            timed(sim, CYCLES, |sim, number| {
                sim.set_list(|i| &i.left, [number & 0xff; PAIRS as usize]);
                sim.set_list(|i| &i.right, [number & 0xff; PAIRS as usize]);
            })
        }),
        ("get_list of 16 outputs", |sim| {
            timed(sim, CYCLES, |sim, _| {
                black_box(sim.get_list(|o| &o.products));
            })
        }),
        ("drive of 32 inputs", |sim| {
            timed(sim, CYCLES, |sim, number| {
                let side = || vec![number & 0xff; PAIRS as usize];
                sim.drive(DotsIn { left: side(), right: side() });
            })
        }),
        ("read_u64 of 17 outputs", |sim| {
            timed(sim, CYCLES, |sim, _| {
                black_box(sim.read_u64());
            })
        }),
    ];
    print("16 products and their sum", sums(), measures);
}
