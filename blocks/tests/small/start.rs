//! Blocks that start with their power-on values.

use proptest::prelude::*;
use tilewright_blocks::*;
use tilewright_hdl::{Clock, Period, Reset, elaborate};
use tilewright_sim::{EngineKind, Simulation};

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

    /// The reset comes and goes at any time; the output ends two edges after it.
    #[test]
    fn a_reset_ends_two_edges_after_its_own(steps in prop::collection::vec((any::<bool>(), 1..4u64), 1..40), low in any::<bool>()) {
        let kind = if low { Reset::AsynchronousLow } else { Reset::Asynchronous };
        let clock = Clock::new("board", Period::ns(20)).reset(kind);
        let mut sim = Simulation::of(&ResetSynchronizer::new(clock)).unwrap().on(EngineKind::Both);
        let (mut left, mut is_reset) = (2u64, false);
        for (reset, edges) in steps {
            if reset != is_reset {
                sim.set_reset(clock, reset);
                is_reset = reset;
            }
            for _ in 0..edges {
                left = if is_reset { 2 } else { left };
                prop_assert_eq!(sim.get_u64(sim.o.reset), u64::from(left > 0));
                sim.step();
                left = if is_reset { 2 } else { left.saturating_sub(1) };
            }
        }
    }
}

#[test]
fn a_reset_begins_at_once_and_ends_two_edges_later() {
    let clock = Clock::new("board", Period::ns(20)).reset(Reset::AsynchronousLow);
    let mut sim = Simulation::of(&ResetSynchronizer::new(clock)).unwrap();
    let wave = sim.record(["reset_meta", "reset"]);
    sim.run(3);
    sim.set_reset(clock, true);
    sim.run(2);
    sim.set_reset(clock, false);
    sim.run(3);
    // Active from 60 ns to 100 ns.
    wave.expect(
        r"
        board_clk  |___/~\_/~\_/~\_/~\_/~\_/~\_/~\_/
        reset_meta |~~~\_______/~~~~~~~~~~~\________
        reset      |~~~~~~~\___/~~~~~~~~~~~~~~~\____",
    );
}

#[test]
fn a_reset_synchronizer_is_left_alone_by_synthesizers() {
    let clock = Clock::new("board", Period::ns(20)).reset(Reset::AsynchronousLow);
    let design = elaborate(&ResetSynchronizer::new(clock)).unwrap();
    let text = &tilewright_gen::verilog(&design)[0].text;
    let expected = "    always @(posedge board_clk or negedge board_rst_n) begin
        if (!board_rst_n) begin
            reset_meta <= 1'b1;
            reset <= 1'b1;
        end else begin
            reset_meta <= 1'b0;
            reset <= reset_meta;
        end
    end
";
    assert!(text.contains(expected), "{text}");
    assert_eq!(text.matches("(* ASYNC_REG = \"TRUE\" *)").count(), 2, "{text}");
}

#[test]
#[should_panic(
    expected = "clock `board` has no asynchronous reset to synchronize: declare it with `.reset(Reset::AsynchronousLow)`"
)]
fn a_reset_that_needs_no_synchronizer() {
    ResetSynchronizer::new(Clock::new("board", Period::ns(20)));
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
