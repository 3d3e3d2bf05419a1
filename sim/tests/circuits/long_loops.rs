//! Loops of so many operations that they are divided.

use tilewright_hdl::{Design, Module, ReadUnderWrite, Signal, bit, bits, block, elaborate, row};
use tilewright_sim::{EngineKind, Pass, Passes, Simulation};

use crate::circuits::random::Random;
use crate::text_after;

/// A loop may have eight times as many operations: 160.
const LONGEST: usize = 20;

fn passes() -> Passes {
    Passes { longest: LONGEST, ..Passes::default() }
}

/// The number of steps in each loop of an edge.
fn loops(design: &Design) -> Vec<usize> {
    let planned = text_after(design, Pass::Plan, &passes());
    let edge = planned.split("an edge of").nth(1).expect("the clock has an edge");
    edge.split("loop over").skip(1).map(|text| text.lines().filter(|line| line.starts_with("    ")).count()).collect()
}

block! {
    /// Rows of 16 lanes, each with an enable of its own, which take what the row before has.
    struct Rows { rows: u32, circle: bool }
    in(self) RowsIn { enable: bits(self.rows), x: bits(8), swap: bit() }
    out(self) RowsOut { last: bits(8), word: bits(8) }
}

impl Rows {
    fn build(&self, m: Module, i: RowsIn) -> RowsOut {
        let lanes = row(16);
        let rows: Vec<_> =
            (0..self.rows).map(|number| m.reg(&format!("r{number}"), bits(8).of(lanes)).reset(number % 256)).collect();
        let memory = m.memory("memory", 4, bits(8).of(lanes), ReadUnderWrite::Old).true_dual_port();
        let first = if self.circle { *rows[rows.len() - 1] + i.x } else { i.x.of(lanes) };
        let before: Vec<Signal> = std::iter::once(first).chain(rows.iter().map(|row| **row)).collect();
        for ((number, register), before) in (0..).zip(&rows).zip(&before) {
            register.when(i.enable.bit(number), *before ^ **register);
        }
        // Both ports write a word: the row that comes later must win.
        memory.write(i.swap.of(lanes), i.x.trunc(2), *rows[0]);
        memory.write(i.swap.of(lanes), i.x.trunc(2), *rows[rows.len() - 1]);
        RowsOut { last: before[before.len() - 1].xor_all(), word: memory.read_async(i.x.trunc(2)).xor_all() }
    }
}

/// Runs the rows on all engines, and returns the steps of each loop.
fn run(rows: &Rows) -> Vec<usize> {
    let design = elaborate(rows).unwrap();
    let mut random = Random::new(u64::from(rows.rows));
    let mut sim = Simulation::with_passes(&design, &passes()).unwrap().on(EngineKind::Both);
    let [enable, x, swap] = ["enable", "x", "swap"].map(|name| sim.port(name).unwrap());
    for step in 0..50 {
        let limb = |_| random.below(1 << 32) << 32 | random.below(1 << 32);
        let limbs: Vec<u64> = (0..rows.rows / 64).map(limb).collect();
        sim.set(enable, &limbs[..]);
        sim.set(x, random.below(256));
        sim.set(swap, random.below(2));
        sim.try_step().unwrap_or_else(|error| panic!("{error}, at step {step} of {rows:?}"));
    }
    loops(&design)
}

#[test]
fn independent_rows_are_in_several_loops() {
    let loops = run(&Rows { rows: 128, circle: false });
    assert!(loops.len() > 2 && loops.iter().all(|steps| *steps <= 8 * LONGEST), "{loops:?}");
}

/// Each row reads what another changes, so that no loop can precede all others.
#[test]
fn rows_in_a_circle_are_in_one_loop() {
    let loops = run(&Rows { rows: 128, circle: true });
    assert!(loops.iter().any(|steps| *steps > 2 * 128), "{loops:?}");
}
