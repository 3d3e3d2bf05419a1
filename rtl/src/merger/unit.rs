//! The merging unit: passes on the nearer of two pixels (VC1-MU).
//!
//! ```text
//!            stage 1     stage 2     stage 3     stage 4
//! left  --+---[ ]-----+---[ ]-----+---[ ]-----+---.
//!         |           |           |           |   mux--[ ]--> nearer
//! right --|+--[ ]-----|+--[ ]-----|+--[ ]-----|+--'
//!         ||          ||          ||          ||   ^
//!        z high      z low      r, g high   g low, b
//!         compare ->[ ]-> compare ->[ ]-> compare ->[ ]-> compare
//! ```
//!
//! Latency: 4 clocks; a pair every clock. While `enable` is low, all registers keep their values.
//!
//! A pixel is a word of depth above colour, so the nearer pixel is the smaller word. If depths are equal the colour
//! decides, so the result does not depend on the sequence of merging (facts E0). A stage compares 12 bits of the words,
//! from the top down, because a comparison of all 48 bits does not fit into a clock.

use crate::prelude::*;

/// The stages of the pipeline (VC1-MU).
pub const STAGES: u32 = 4;
/// The bits that a stage compares.
const PART: u32 = WORD / STAGES;

block! {
    /// Passes on the nearer of two pixels, each a word of depth above colour: the smaller word.
    pub struct MergingUnit;
    source = "VC-1, section 3.3, pipelined image merger (VC1-MU)";
    in MergingUnitIn {
        /// The pixel of the preceding unit of the chain.
        left: bits(WORD),
        /// The pixel of the local frame buffer.
        right: bits(WORD),
        /// The pipeline advances.
        enable: bit(),
    }
    out MergingUnitOut {
        /// The nearer pixel.
        nearer: bits(WORD),
    }
}

// A comparison in a stage. `decided`: the words differ in the bits compared so far. If so, `right_is_nearer` says whether
// the right word is the smaller one.
bundle! { struct Race<T> { left: T, right: T, decided: T, right_is_nearer: T } }

impl MergingUnit {
    fn build(&self, m: Module, i: MergingUnitIn) -> MergingUnitOut {
        let compare = |stage: u32, race: Race| {
            let [left, right] = [race.left, race.right].map(|word| word.part(WORD - stage * PART, PART));
            let right_is_nearer = race.right_is_nearer | (!race.decided & right.lt(left));
            Race { decided: race.decided | right.ne(left), right_is_nearer, ..race }
        };
        let start = Race { left: i.left, right: i.right, decided: lit(1, 0), right_is_nearer: lit(1, 0) };
        // The last stage registers only the chosen word, so it is not one of `stages`.
        let race = compare(STAGES, m.stages(STAGES - 1, i.enable, start, compare));
        def!(nearer = m.pipe_when(i.enable, mux(race.right_is_nearer, race.right, race.left)));
        MergingUnitOut { nearer }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use tilewright_sim::Simulation;

    use super::*;

    #[test]
    fn the_nearer_pixel_comes_out_4_clocks_later() {
        let mut sim = Simulation::of(&MergingUnit).unwrap();
        let (i, o) = (sim.i, sim.o);
        let wave = sim.record([i.left, i.right, i.enable, o.nearer]);
        let pairs = [(5, 7), (9, 8), (99, 6), (4, 99), (3, 3), (99, 99)];
        for (left, right) in pairs.into_iter().chain([(0, 0); 4]) {
            sim.drive(MergingUnitIn { left, right, enable: 1 });
            sim.step();
        }
        wave.expect(
            r"
            clk    |____/~~\_/~~\_/~~\_/~~\_/~~\_/~~\_/~~\_/~~\_/~~\_/
            left   | 5  | 9  | 63 | 4  | 3  | 63 | 0                 |
            right  | 7  | 8  | 6  | 63 | 3  | 63 | 0                 |
            enable |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
            nearer | 0                 | 5  | 8  | 6  | 4  | 3  | 63 |
            ",
        );
    }

    /// Words that often agree in their high parts.
    fn words() -> impl Strategy<Value = u64> {
        let part = || prop_oneof![Just(0), Just(0xfff), 0..0x1000u64];
        [part(), part(), part(), part()].prop_map(|parts| parts.into_iter().fold(0, |word, part| word << 12 | part))
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        /// Compares with `min` under random pauses of the pipeline.
        #[test]
        fn it_is_the_minimum(steps in prop::collection::vec((words(), words(), prop::bool::weighted(0.8)), 1..60)) {
            let mut sim = Simulation::of(&MergingUnit).unwrap();
            let mut under_way = std::collections::VecDeque::from([0; STAGES as usize]);
            for (left, right, enable) in steps {
                sim.drive(MergingUnitIn { left, right, enable: enable.into() });
                prop_assert_eq!(sim.get_u64(sim.o.nearer), under_way[0]);
                sim.step();
                if enable {
                    under_way.pop_front();
                    under_way.push_back(left.min(right));
                }
            }
        }
    }
}
