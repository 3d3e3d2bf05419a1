//! Rows that are joined, and values that are split into lanes, when both have the same layout in memory.

use tilewright_hdl::{Module, bits, block, elaborate, grid, row, stack};
use tilewright_sim::{EngineKind, Pass, Passes, Simulation};

use crate::circuits::random::Random;
use crate::text_after;

block! {
    /// Rows from inputs, from words and computed ones, which neighbours read; and all lanes of one in a value.
    struct Gatherer { rows: u32, columns: u32, width: u32 }
    in(self) GathererIn {
        rows: [bits(self.width).of(row(self.columns)); self.rows - 2],
        word: bits(self.width * self.columns),
        plain: bits(self.width),
    }
    out(self) GathererOut {
        turned: bits(self.width).of(grid(self.rows, self.columns)),
        together: bits(self.width * self.columns),
    }
}

impl Gatherer {
    fn build(&self, m: Module, i: GathererIn) -> GathererOut {
        let untogether = i.word.unpack(row(self.columns));
        let sums = m.pipe("sums", i.rows[0] + untogether);
        let rows = stack(i.rows.iter().copied().chain([untogether, sums ^ i.plain]));
        let turned = m.pipe("turned", rows.rows().shifted(1, 0) ^ rows);
        GathererOut { turned, together: (sums ^ i.rows[1]).pack() }
    }
}

fn run(gatherer: &Gatherer, seed: u64) {
    let Gatherer { rows, columns, width } = *gatherer;
    let design = elaborate(gatherer).unwrap();
    let mut random = Random::new(seed);
    let text = text_after(&design, Pass::Lower, &Passes::default());
    for kept in [format!("{columns} parts of word"), format!("groups of {columns} lanes")] {
        assert!(text.contains(&kept), "{gatherer:?} has no `{kept}`:\n{text}");
    }
    let mut sim = Simulation::of(gatherer).unwrap().seeded(seed).on(EngineKind::Both);
    let ports = sim.i.clone();
    let mut number = |width: u32| (random.below(1 << 32) << 32 | random.below(1 << 32)) >> (64 - width);
    for _ in 0..30 {
        for port in &ports.rows {
            sim.set_lanes(*port, (0..columns).map(|_| number(width)));
        }
        let limbs: Vec<u64> = (0..columns * width / 64).map(|_| number(64)).collect();
        sim.set(ports.word, &limbs[..]);
        sim.set(ports.plain, number(width));
        sim.get(sim.o.together);
        sim.try_step().unwrap_or_else(|error| panic!("{error} with {gatherer:?} and seed {seed}"));
        assert_eq!(sim.lanes(sim.o.turned).len() as u32, rows * columns);
    }
}

#[test]
fn rows_are_copied_and_limbs_are_lanes() {
    for (seed, (width, columns)) in (0..).zip([(8, 32), (16, 16), (32, 64), (64, 4)]) {
        run(&Gatherer { rows: 6, columns, width }, seed);
    }
}
