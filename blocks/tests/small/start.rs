//! Blocks that start with their power-on values.

use proptest::prelude::*;
use tilewright_blocks::*;
use tilewright_sim::Simulation;

proptest! {
    #![proptest_config(ProptestConfig { cases: 32, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_reset_lasts_its_number_of_clocks(clocks in 1..9u64, asked in prop::collection::vec(prop::bool::weighted(0.1), 1..60), seed in any::<u64>()) {
        let mut sim = Simulation::of(&PowerOnReset::new(clocks)).unwrap().seeded(seed);
        let mut left = clocks;
        for again in asked {
            sim.set(sim.i.again, u64::from(again));
            prop_assert_eq!(sim.get_u64(sim.o.reset), u64::from(left > 0));
            sim.step();
            left = if again { clocks } else { left.saturating_sub(1) };
        }
    }

    #[test]
    fn ticks_come_once_in_each_period(every in 2..9u64, restarts in prop::collection::vec(prop::bool::weighted(0.1), 1..60), seed in any::<u64>()) {
        let mut sim = Simulation::of(&Ticks::new(every)).unwrap().seeded(seed);
        let mut clock = 0;
        for restart in restarts {
            sim.set(sim.i.restart, u64::from(restart));
            prop_assert_eq!(sim.get_u64(sim.o.tick), u64::from(clock % every == 0));
            sim.step();
            clock = if restart { 0 } else { clock + 1 };
        }
    }
}

/// On an FPGA the block may never be reset.
#[test]
fn a_sequence_begins_without_a_reset() {
    let mut sim = Simulation::of(&Lfsr::new(8)).unwrap().seeded(5);
    assert_eq!(sim.get_u64(sim.o.number), 1);
}

#[test]
#[should_panic(expected = "a reset of 0 clocks resets nothing")]
fn a_reset_of_nothing() {
    PowerOnReset::new(0);
}

#[test]
#[should_panic(expected = "a tick every 1 clocks: a period has 2 or more")]
fn a_tick_in_every_clock() {
    Ticks::new(1);
}
