//! Some of many adjacent words at an address: only the selected ones are read, and they are correct.

use tilewright_hdl::{Block, Clock, Module, Period, ReadUnderWrite, bit, bits, block, constants, elaborate, grid, row};
use tilewright_sim::{EngineKind, Pass, Passes, Simulation};

use crate::circuits::random::Random;
use crate::text_after;

const FAST: Clock = Clock::new("fast", Period::ps(2_000));
const SLOW: Clock = Clock::new("slow", Period::ps(3_000));

block! {
    /// A memory at each place of a grid, and from each row the word in one column.
    struct Picker { rows: u32, columns: u32, width: u32, depth: u32 }
    in(self) PickerIn { at: bits(3).on(FAST), column: bits(8).on(FAST), to: bits(3).on(SLOW), go: bit().on(SLOW) }
    out(self) PickerOut { seen: bits(self.width).of(row(self.rows)), kept: bits(self.width).of(row(self.rows)) }
}

impl Picker {
    fn build(&self, m: Module, i: PickerIn) -> PickerOut {
        let all = grid(self.rows, self.columns);
        let words = m.memory("words", self.depth, bits(self.width).of(all), ReadUnderWrite::Any);
        let numbers = constants(bits(self.width).of(all), |lane| u64::from(lane * 37) & ((1 << self.width) - 1));
        let mixed = m.on(SLOW).reg("mixed", bits(self.width).of(all)).reset(1);
        mixed.next((*mixed + *mixed) ^ numbers);
        words.on(SLOW).write(i.go.of(all), i.to, *mixed);
        let read = words.on(FAST).read_async(i.at).quasi_static("the test looks on");
        let seen = read.columns().pick(i.column.of(row(self.rows)));
        PickerOut { seen, kept: m.on(FAST).pipe("kept", seen) }
    }
}

fn run<B: Block>(picker: &B, seed: u64) {
    let design = elaborate(picker).unwrap();
    let mut random = Random::new(seed);
    let planned = text_after(&design, Pass::Plan, &Passes::default());
    assert!(planned.lines().any(|line| line.contains("= lane ") && line.contains(" of words[")), "{planned}");
    let mut sim = Simulation::from_design(&design).unwrap().seeded(seed % 2).on(EngineKind::Both);
    let ports = ["at", "column", "to", "go"].map(|name| sim.port(name).unwrap());
    let seen = sim.port("seen").unwrap();
    for _ in 0..100 {
        let numbers = [random.below(8), random.below(256), random.below(8), random.below(2)];
        ports.into_iter().zip(numbers).for_each(|(port, number)| sim.set(port, number));
        sim.get(seen);
        sim.try_step().unwrap_or_else(|error| panic!("{error} with seed {seed}"));
    }
}

#[test]
fn words_that_are_taken_of_many_are_the_right_ones() {
    for (seed, width) in (0..).zip([2, 8, 13, 32, 47]) {
        run(&Picker { rows: 3, columns: 40, width, depth: 5 }, seed);
        run(&Picker { rows: 16, columns: 256, width, depth: 8 }, seed);
    }
}
