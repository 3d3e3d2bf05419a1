//! The time from a description to the first cycle, on the interpreter and with machine code, by size: `cargo bench -p tilewright-benches --bench compile`.
//! Twice the size should take twice the time.

use std::time::Instant;

use tilewright_hdl::{Block, Module, Signal, bits, block, bundle, row};
use tilewright_sim::{EngineKind, Simulation};

bundle! {
    struct In<T> { x: T }
    struct Enabled<T> { enable: T, x: T }
    struct Out<T> { y: T }
}

block! {
    /// Operations on values of this width, each on the previous two, with a register after every eighth.
    struct Flat {
        operations: u32,
        width: u32,
    }
    in(self) = In { x: bits(self.width) };
    out(self) = Out { y: bits(self.width) };
}

impl Flat {
    fn build(&self, m: Module, i: In) -> Out {
        let (mut before, mut last) = (i.x, !i.x);
        for number in 0..self.operations {
            let next = operation(number, before, last);
            let next = if number % 8 == 7 { m.pipe(&format!("r{number}"), next) } else { next };
            (before, last) = (last, next);
        }
        Out { y: last }
    }
}

fn operation(number: u32, a: Signal, b: Signal) -> Signal {
    match number % 5 {
        0 => a + b,
        1 => a ^ b,
        2 => (a & b) - u64::from(number % 2),
        3 => a - b,
        _ => a | !b,
    }
}

block! {
    /// An array of such blocks.
    struct Lanes {
        lanes: u32,
        flat: Flat,
    }
    in(self) = In { x: bits(self.flat.width) };
    out(self) = Out { y: bits(self.flat.width) };
}

impl Lanes {
    fn build(&self, m: Module, i: In) -> Out {
        Out { y: m.array("u_lane", self.lanes, &self.flat, |a| In { x: a.y.previous(i.x) }).y.xor_all() }
    }
}

block! {
    /// Rows of 16 lanes, each with an enable of its own.
    struct Rows {
        rows: u32,
    }
    in(self) = Enabled { enable: bits(self.rows), x: bits(8) };
    out(self) = Out { y: bits(8) };
}

impl Rows {
    fn build(&self, m: Module, i: Enabled) -> Out {
        let mut last = i.x.of(row(16));
        for number in 0..self.rows {
            let register = m.reg(&format!("r{number}"), bits(8).of(row(16))).reset(0);
            register.when(i.enable.bit(number), *register ^ last);
            last = *register;
        }
        Out { y: last.xor_all() }
    }
}

/// Milliseconds to describe a block, and from there to the first cycle on an engine; the best of three times.
fn measure<B: Block>(block: &B, engine: EngineKind) -> [f64; 2] {
    let once = || {
        let start = Instant::now();
        let mut sim = Simulation::of(block).expect("the description has no mistake").on(engine);
        let described = start.elapsed().as_secs_f64() * 1e3;
        sim.step();
        [described, start.elapsed().as_secs_f64() * 1e3 - described]
    };
    (0..3).map(|_| once()).reduce(|a, b| [a[0].min(b[0]), a[1].min(b[1])]).expect("three times")
}

fn print<B: Block>(what: &str, size: u32, block: &B) {
    let [_, interpreted] = measure(block, EngineKind::Interpreter);
    let [described, compiled] = measure(block, EngineKind::Compiled);
    let each = (described + compiled) * 1e3 / f64::from(size);
    println!(
        "{what:40} {size:7}   described {described:8.1} ms   first cycle {interpreted:8.1} ms   in code {compiled:8.1} ms   {each:6.2} us each"
    );
}

fn main() {
    for operations in [12_500, 25_000, 50_000, 100_000] {
        print("operations of 16 bits, flat", operations, &Flat { operations, width: 16 });
    }
    for operations in [640, 1280, 2560, 5120] {
        print(
            "operations in one loop over 64 lanes",
            operations,
            &Lanes { lanes: 64, flat: Flat { operations, width: 16 } },
        );
    }
    for rows in [1000, 2000, 4000, 8000] {
        print("rows of 16 lanes, each with an enable", rows, &Rows { rows });
    }
    for lanes in [16, 32, 64, 128] {
        print(
            "lanes of 16 operations of 4096 bits",
            lanes,
            &Lanes { lanes, flat: Flat { operations: 16, width: 4096 } },
        );
    }
}
