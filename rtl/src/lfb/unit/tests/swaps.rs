//! Swaps of the buffers and restarts of the scan, and their effect on the pixel that the scan is looking up.

use super::*;

#[test]
fn swapping_again_before_the_merger_has_followed_is_an_error() {
    let mut bench = Bench::new(SMALL, 4, 30, 0);
    bench.sim.set(bench.sim.i.swap, 1);
    bench.clock();
    let problem = (0..4).find_map(|_| bench.sim.try_step().err()).expect("a clock of the processor passes").to_string();
    assert!(problem.contains("the buffers are not swapped again before the merger has followed"), "{problem}");
}

/// This takes two clocks of the merger after a swap, and then two of the processor, in every phase of the two clocks.
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
        // A reset at the start, and one at any time after a swap.
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

/// In each phase of the scan, with its pauses, no entry of the old back buffer is taken for one of the new.
#[test]
fn a_swap_while_the_scan_is_among_pages_sends_no_word_twice() {
    for wait in 0..40 {
        let mut bench = Bench::new(SMALL, 4, 30, 0);
        // A patch has a different page in each buffer.
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

/// With nothing left to send, the scan may restart at any time, as it does when the global frame buffer swaps.
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

/// `sending` rises at the third edge of the merger after a swap. It stays high until 2 pixels more than the screen has
/// have passed.
#[test]
fn something_is_left_to_send_until_each_pixel_has_passed() {
    let unit = LfbUnit { patches: Patches::new(SMALL, 4).unwrap(), pages: 30 };
    let pixels = SMALL.pixels() as usize + 2;
    let patterns: [fn(u64) -> bool; 4] =
        [|_| true, |clock| clock % 2 == 0, |clock| clock % 2 == 1, |clock| clock % 5 > 1];
    for (wait, enables) in (0..20).flat_map(|wait| patterns.map(|enables| (wait, enables))) {
        let mut sim = Simulation::of(&unit).unwrap().seeded(wait);
        sim.reset();
        sim.set(sim.i.scan.restart, 1);
        sim.step_clock(MERGE, 1);
        sim.set(sim.i.scan.restart, 0);
        // For each edge of the merger: whether a pixel passes, and whether anything is left.
        let (mut edges, mut swapped) = (Vec::new(), None);
        let swap_at = sim.cycles(PE).unwrap() + wait;
        while edges.len() < 3 * pixels {
            let [merges, clocks] = [MERGE, PE].map(|clock| sim.cycles(clock).unwrap());
            sim.set(sim.i.scan.enable, enables(merges));
            sim.set(sim.i.swap, clocks == swap_at);
            let sending = sim.get_u64(sim.o.sending) == 1;
            sim.step();
            if sim.cycles(MERGE).unwrap() > merges {
                edges.push((enables(merges), sending));
            }
            if clocks == swap_at && sim.cycles(PE).unwrap() > clocks {
                swapped = Some(edges.len());
            }
        }
        let known = swapped.unwrap() + 2;
        let passed = (known..).filter(|edge| edges[*edge].0).nth(pixels - 1).unwrap();
        let left: Vec<usize> = (0..edges.len()).filter(|edge| edges[*edge].1).collect();
        assert_eq!(left, Vec::from_iter(known + 1..passed + 2), "a swap after {wait} clocks");
        assert!(
            sim.covered("the buffers are swapped while the scan is within a frame").unwrap()
                == u64::from(edges[known].0)
        );
    }
}

/// It is one from the third clock after a swap, in which the merger learns of it, until everything is sent.
#[test]
fn a_restart_while_something_is_left_to_send_is_an_error() {
    for (edges, is_error) in [(1, false), (2, true), (3, true), (40, true)] {
        let mut bench = Bench::new(SMALL, 4, 30, 0);
        bench.sim.set(bench.sim.i.swap, 1);
        bench.clock();
        bench.sim.set(bench.sim.i.swap, 0);
        bench.sim.step_clock(MERGE, edges);
        bench.sim.set(bench.sim.i.scan.restart, 1);
        let end = bench.sim.cycles(MERGE).unwrap() + 1;
        let mut problem = None;
        while bench.sim.cycles(MERGE).unwrap() < end && problem.is_none() {
            problem = bench.sim.try_step().err().map(|problem| problem.to_string());
        }
        let says = problem.map(|problem| problem.contains("the scan restarts only when nothing is left to send"));
        assert_eq!(says, is_error.then_some(true), "{edges} edges after a swap");
    }
}

/// A reset clears what is left to send, and the pixel that the scan has looked up but not sent.
#[test]
fn a_reset_forgets_what_was_to_be_sent() {
    let unit = LfbUnit { patches: Patches::new(SMALL, 4).unwrap(), pages: 30 };
    for (phase, swaps) in (0..40).flat_map(|phase| [(phase, 1), (phase, 2)]) {
        let mut sim = Simulation::of(&unit).unwrap().seeded(phase);
        let i = sim.i;
        sim.reset();
        sim.set(i.scan.restart, 1);
        sim.step_clock(MERGE, 1);
        sim.set(i.scan.restart, 0);
        sim.set(i.scan.enable, 1);
        // After two swaps the front buffer is the same as after a reset.
        for word in 0..swaps {
            for x in 8..12 {
                sim.set(i.request.x, x);
                sim.set(i.request.word, word);
                sim.set(i.request.valid, 1);
                while sim.get_u64(i.request.ready) == 0 {
                    sim.step_clock(PE, 1);
                }
                sim.step_clock(PE, 1);
            }
            sim.set(i.request.valid, 0);
            sim.step_clock(PE, 9);
            while sim.get_u64(sim.o.sending) == 1 {
                sim.step();
            }
            sim.set(i.swap, 1);
            sim.step_clock(PE, 1);
            sim.set(i.swap, 0);
        }
        // The scan reaches the pixels drawn.
        while sim.get_u64(sim.o.scanned.x) != 8 || sim.get_u64(sim.o.scanned.y) != 0 {
            sim.step();
        }
        (0..phase).for_each(|_| sim.step());
        sim.set(i.scan.enable, 0);
        sim.step_clock(MERGE, 1);
        sim.reset();
        assert_eq!(sim.get_u64(sim.o.sending), 0);
        sim.set(i.scan.restart, 1);
        sim.step_clock(MERGE, 1);
        sim.set(i.scan.restart, 0);
        sim.set(i.scan.enable, 1);
        for _ in 0..4 {
            assert_eq!(sim.get_u64(sim.o.sending), 0);
            sim.step_clock(MERGE, 1);
            assert_eq!(sim.get_u64(sim.o.word), EMPTY, "a reset {phase} steps after the scan has reached the pixels");
        }
    }
}
