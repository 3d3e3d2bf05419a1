//! Chapter 7: the lesser of two numbers, found in a pipeline.

use tilewright_hdl::*;

/// How many stages there are.
pub const STAGES: u32 = 3;

bundle! {
    /// What is known of two numbers in a stage.
    pub struct Race<T> {
        /// One number.
        pub left: T,
        /// The other one.
        pub right: T,
        /// They differ in the bits that were compared.
        pub decided: T,
        /// If so, the right one is less.
        pub right_is_less: T,
    }
}

/// Compares 8 bits of 24 in each stage, from the most significant on.
fn compare(stage: u32, race: Race) -> Race {
    let part = |word: Signal| word.part(24 - 8 * stage, 8);
    let (left, right) = (part(race.left), part(race.right));
    Race {
        decided: race.decided | right.ne(left),
        right_is_less: race.right_is_less | (!race.decided & right.lt(left)),
        ..race
    }
}

block! {
    /// Finds the lesser of two numbers.
    pub struct Lesser;
    in LesserIn {
        /// One number.
        left: bits(24),
        /// The other one.
        right: bits(24),
        /// The pipeline advances.
        enable: bit(),
    }
    out LesserOut {
        /// The lesser one.
        lesser: bits(24),
    }
}

impl Lesser {
    fn build(&self, m: Module, i: LesserIn) -> LesserOut {
        let start = Race { left: i.left, right: i.right, decided: lit(1, 0), right_is_less: lit(1, 0) };
        let race = m.stages(STAGES, i.enable, start, compare);
        LesserOut { lesser: mux(race.right_is_less, race.right, race.left) }
    }
}

block! {
    /// Finds the lesser of two numbers, between streams.
    pub struct LesserStream;
    in LesserStreamIn {
        /// Two numbers.
        pairs: stream(pub struct Pair {
            /// One number.
            left: bits(24),
            /// The other one.
            right: bits(24),
        }),
    }
    out LesserStreamOut {
        /// The lesser one.
        lesser: stream(bits(24)),
    }
}

impl LesserStream {
    fn build(&self, m: Module, i: LesserStreamIn) -> LesserStreamOut {
        let Pair { left, right } = *i.pairs;
        let start = Race { left, right, decided: lit(1, 0), right_is_less: lit(1, 0) };
        let races = m.stream_stages(STAGES, i.pairs.with(start), compare);
        LesserStreamOut { lesser: races.with(mux(races.right_is_less, races.right, races.left)) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tilewright_sim::{Pauses, Simulation, monitor};

    #[test]
    fn a_pair_a_clock() -> Result<(), tilewright_sim::Error> {
        let mut sim = Simulation::of(&Lesser)?;
        let wave = sim.record(["left", "right", "enable", "decided1", "decided2", "decided3", "lesser"]);
        for (left, right, enable) in
            [(5, 7, 1), (0x10000, 9, 1), (0x3ff, 0x310, 0), (0x3ff, 0x310, 1), (0, 0, 1), (0, 0, 1)]
        {
            sim.drive(LesserIn { left, right, enable });
            sim.step();
        }
        sim.run(2);
        wave.expect(
            r"
            clk      |_______/~~~\___/~~~\___/~~~\___/~~~\___/~~~\___/~~~\___/~~~\___/
            left     | 5     | 10000 | 3ff           | 0                             |
            right    | 7     | 9     | 310           | 0                             |
            enable   |~~~~~~~~~~~~~~~\_______/~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
            decided1 |_______________/~~~~~~~~~~~~~~~\________________________________
            decided2 |_______________________________/~~~~~~~\________________________
            decided3 |_______________________________/~~~~~~~~~~~~~~~~~~~~~~~\________
            lesser   | 0                             | 5     | 9     | 310   | 0     |",
        );
        Ok(())
    }

    #[test]
    fn whatever_the_pauses_are() -> Result<(), tilewright_sim::Error> {
        let mut sim = Simulation::of(&LesserStream)?.seeded(1);
        sim.reset();
        let (pairs, lesser) = (sim.i.pairs, sim.o.lesser);
        let t = sim.testbench();
        let numbers = (0..200u64).map(|k| (k * 7_654_321 % (1 << 24), k * 1_234_567 % (1 << 24)));
        t.run((
            t.send_all(pairs, numbers.clone().map(|(left, right)| Pair { left, right }), Pauses::percent(30, 1)),
            t.expect_all(lesser, numbers.map(|(left, right)| left.min(right)), Pauses::percent(50, 2)),
            monitor(t.holds(lesser)),
        ));
        Ok(())
    }
}
