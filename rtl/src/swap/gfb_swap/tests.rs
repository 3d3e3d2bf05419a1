//! Frames that are merged late and early, clock by clock and against a model of the guards.

use proptest::prelude::*;
use tilewright_sim::Simulation;

use super::*;

#[test]
fn the_banks_change_when_all_is_stored_and_the_display_is_dark() {
    let control = GfbSwap { processors: 2, merge_clocks: 6, way: 8, late: 2 };
    let mut sim = Simulation::of(&control).unwrap();
    let wave = sim.record(["frames_0", "frames_1", "sending_1", "blanking", "since", "way_left", "swap", "shown"]);
    sim.reset();
    let steps = [
        ([0, 0], 0, 1, 1),
        ([1, 0], 0, 1, 3),
        ([1, 1], 1, 1, 4),
        ([1, 1], 0, 1, 3),
        ([1, 1], 0, 0, 2),
        ([1, 1], 0, 1, 3),
    ];
    for (frames, sending, blanking, clocks) in steps {
        sim.drive(GfbSwapIn { frames: frames.to_vec(), sending: vec![0, sending], enable: 1, blanking });
        sim.run(clocks);
    }
    wave.expect(
        r"
        clk       |___/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/
        frames_0  |_______/~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
        frames_1  |___________________/~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
        sending_1 |___________________/~~~~~~~~~~~~~~~\________________________________
        blanking  |___/~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~\_______/~~~~~~~~~~~~
        since     | 0                     | 1 | 2 | 3 | 4 | 5 | 6 | 7 | 8     | 0     |
        way_left  | 8                     | 7 | 6 | 5 | 4 | 3 | 2 | 1 | 0     | 8     |
        swap      |_______________________________________________________/~~~\________
        shown     |___________________________________________________________/~~~~~~~~
        ",
    );
    assert_eq!(sim.covered("a merged frame waits for the blanking").unwrap(), 1);
}

#[test]
fn a_frame_that_is_not_stored_soon_after_t_m_is_an_error() {
    let mut sim = Simulation::of(&GfbSwap { processors: 1, merge_clocks: 6, way: 3, late: 8 }).unwrap();
    sim.reset();
    sim.drive(GfbSwapIn { frames: vec![1], sending: vec![0], enable: 0, blanking: 1 });
    let problem = (0..20).find_map(|_| sim.try_step().err()).unwrap().to_string();
    assert!(problem.contains("the frame is stored soon after T_m"), "{problem}");
}

/// The wait is longer than any of the counters counts.
#[test]
fn a_merged_frame_waits_as_long_as_the_display_takes() {
    let mut sim = Simulation::of(&GfbSwap { processors: 1, merge_clocks: 6, way: 3, late: 3 }).unwrap();
    sim.reset();
    sim.drive(GfbSwapIn { frames: vec![1], sending: vec![0], enable: 1, blanking: 0 });
    sim.run(6);
    for _ in 0..100 {
        assert_eq!((sim.get_u64(sim.o.merged), sim.get_u64(sim.o.swap)), (1, 0));
        sim.step();
    }
    assert_eq!(sim.covered("a merged frame waits for the blanking").unwrap(), 100);
}

#[test]
fn a_frame_that_ends_before_the_last_one_is_on_display_is_an_error() {
    let mut sim = Simulation::of(&GfbSwap { processors: 2, merge_clocks: 6, way: 3, late: 8 }).unwrap();
    sim.reset();
    let turned = |frames: [u64; 2]| GfbSwapIn { frames: frames.to_vec(), sending: vec![0; 2], enable: 1, blanking: 0 };
    sim.drive(turned([0, 1]));
    sim.run(2);
    sim.drive(turned([0, 0]));
    let problem = sim.try_step().unwrap_err().to_string();
    assert!(problem.contains("a frame ends only when the previous one is on display"), "{problem}");
}

/// A reset clears the count of clocks that a frame has waited, and selects the first bank.
#[test]
fn a_reset_begins_anew() {
    let mut sim = Simulation::of(&GfbSwap { processors: 1, merge_clocks: 6, way: 3, late: 8 }).unwrap();
    sim.reset();
    let waits = |frame| GfbSwapIn { frames: vec![frame], sending: vec![0], enable: 1, blanking: 0 };
    sim.drive(waits(1));
    sim.run(6);
    assert_eq!(sim.get_u64(sim.o.merged), 1);
    // The count reaches its end, at which an assertion demands that the frame is stored.
    sim.run(10);
    sim.reset();
    assert_eq!(sim.get_u64(sim.o.merged), 0, "T_m begins again");
    sim.run(6);
    sim.drive(GfbSwapIn { blanking: 1, ..waits(1) });
    sim.step();
    assert_eq!(sim.get_u64(sim.o.shown), 1);
    sim.reset();
    assert_eq!(sim.get_u64(sim.o.shown), 0);
    // An input that toggles during the reset does not end a frame.
    sim.drive(waits(0));
    sim.step();
}

#[test]
fn a_swap_of_banks_before_all_is_sent_is_an_error() {
    let mut sim = Simulation::of(&GfbSwap { processors: 1, merge_clocks: 6, way: 3, late: 8 }).unwrap();
    sim.reset();
    sim.drive(GfbSwapIn { frames: vec![1], sending: vec![1], enable: 1, blanking: 1 });
    let problem = (0..20).find_map(|_| sim.try_step().err()).unwrap().to_string();
    assert!(problem.contains("all of a frame is sent before the banks change"), "{problem}");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 128, failure_persistence: None, ..ProptestConfig::default() })]

    /// Compares the swap with the clocks of the events (VC1-SW2).
    #[test]
    fn the_banks_change_in_the_first_clock_in_which_all_guards_hold(
        (merge_clocks, way) in (1..30u64, 1..9u32),
        frames in prop::collection::vec((prop::collection::vec(0..20u64, 3), 0..30u64), 1..6),
        seed in any::<u64>(),
        (blanks, enables) in (prop::collection::vec(any::<bool>(), 7), prop::collection::vec(prop::bool::weighted(0.7), 11)),
    ) {
        let control = GfbSwap { processors: 3, merge_clocks, way, late: 400 };
        let mut sim = Simulation::of(&control).unwrap().seeded(seed);
        sim.reset();
        let (mut waits, ended) = (0, frames.len() as u64);
        let blanks = |clock: u64| blanks[clock as usize % 7] || clock.is_multiple_of(50);
        let enables = |clock: u64| enables[clock as usize % 11] || clock.is_multiple_of(4);
        let (mut clock, mut parity) = (0u64, 1);
        for (swaps, sent_after) in frames {
            let begun = clock;
            let all_swapped = begun + swaps.iter().max().unwrap();
            // The frame is sent within T_m, as an assumption demands.
            let all_sent = all_swapped + sent_after.min(merge_clocks);
            let mut advanced = 0;
            loop {
                let turned = swaps.iter().map(|swap| u64::from(begun + swap <= clock) ^ (1 - parity));
                let sending = vec![0, u64::from(clock < all_sent), 0];
                let (enable, blanking) = (enables(clock), blanks(clock));
                let frames = turned.collect();
                sim.drive(GfbSwapIn { frames, sending, enable: enable.into(), blanking: blanking.into() });
                let swaps = clock >= all_swapped + merge_clocks && advanced >= way && blanking;
                prop_assert_eq!(sim.get_u64(sim.o.swap) == 1, swaps, "clock {}", clock);
                let merged = clock >= all_swapped + merge_clocks && advanced >= way;
                prop_assert_eq!(sim.get_u64(sim.o.merged) == 1, merged);
                waits += u64::from(merged && !blanking);
                if clock >= all_swapped {
                    advanced += u32::from(enable);
                }
                sim.step();
                clock += 1;
                prop_assert_eq!(sim.get_u64(sim.o.shown), if swaps { parity } else { 1 - parity });
                if swaps {
                    break;
                }
                prop_assert!(clock < begun + 400);
            }
            parity = 1 - parity;
        }
        prop_assert_eq!(sim.covered("the banks change").unwrap(), ended);
        prop_assert_eq!(sim.covered("a merged frame waits for the blanking").unwrap(), waits);
    }
}
