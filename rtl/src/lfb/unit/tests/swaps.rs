//! When the buffers are swapped, and the scan restarted, and what becomes of the pixel that the scan seeks meanwhile.

use super::*;

#[test]
fn swapping_again_before_the_merger_has_followed_is_an_error() {
    let mut bench = Bench::new(SMALL, 4, 30, 0);
    bench.sim.set(bench.sim.i.swap, 1);
    bench.clock();
    let problem = (0..4).find_map(|_| bench.sim.try_step().err()).expect("a clock of the processor passes").to_string();
    assert!(problem.contains("the buffers are not swapped again before the merger has followed"), "{problem}");
}

/// Two clocks of the merger after a swap, and then two of the processor, in every phase of the two clocks.
#[test]
fn the_table_is_free_when_the_merger_has_followed_a_swap() {
    let [pe, merge] = [PE, MERGE].map(|clock| clock.period.picoseconds());
    for wait in 0..16 {
        let mut bench = Bench::new(SMALL, 4, 30, 0);
        (0..wait).for_each(|_| bench.clock());
        bench.sim.set(bench.sim.i.swap, 1);
        bench.clock();
        bench.sim.set(bench.sim.i.swap, 0);
        let followed = (bench.sim.time() / merge + 2) * merge;
        bench.wait_until(bench.sim.i.clear.ready);
        assert_eq!(bench.sim.time(), (followed / pe + 2) * pe, "a swap after {wait} clocks");
    }
}

#[test]
fn after_a_reset_the_table_is_free_and_stays_free() {
    for wait in 0..16 {
        let unit = LfbUnit { patches: Patches::new(SMALL, 4).unwrap(), pages: 30 };
        let mut sim = Simulation::of(&unit).unwrap().seeded(wait);
        // At the start, and at any time after a swap.
        for swap in [1, 0] {
            sim.reset();
            for clock in 0..16 {
                assert_eq!(sim.get_u64(sim.i.clear.ready), 1, "clock {clock} of {wait}");
                sim.step_clock(PE, 1);
            }
            sim.set(sim.i.swap, swap);
            sim.step_clock(PE, 1);
            sim.set(sim.i.swap, 0);
            sim.step_clock(PE, wait);
        }
    }
}

/// In each phase of the scan, which holds now and then: of the buffer that was behind no entry is taken for one of the other.
#[test]
fn a_swap_while_the_scan_is_among_pages_sends_no_word_twice() {
    for wait in 0..40 {
        let mut bench = Bench::new(SMALL, 4, 30, 0);
        // A patch has another page in each buffer.
        for first in [0, 23] {
            for x in 0..24 {
                bench.draw((u64::abs_diff(first, x), 0), x);
            }
            bench.wait_until(bench.sim.o.idle);
            bench.wait_for_scan(2);
            (0..wait).for_each(|_| bench.clock());
            bench.swap();
        }
        bench.finish_scan();
    }
}

/// With nothing left to send the scan may begin again at any time, as it does when the global frame buffer swaps.
#[test]
fn a_restart_is_followed_by_whole_frames() {
    for (restart_at, enable) in [(19, 0), (19, 1), (20, 1), (21, 0), (23, 1)] {
        let mut bench = Bench::new(SMALL, 4, 30, 2);
        for first in [0, 23] {
            for x in 0..24 {
                bench.draw((u64::abs_diff(first, x), 0), x);
            }
            bench.wait_until(bench.sim.o.idle);
            bench.finish_scan();
            bench.wait_for_scan(restart_at);
            bench.sim.set(bench.sim.i.scan.restart, 1);
            bench.sim.set(bench.sim.i.scan.enable, enable);
            while bench.advanced > 1 {
                bench.clock();
            }
            bench.swap();
        }
        bench.finish_scan();
    }
}
