//! Frames and overflows, clock by clock and against a model of the guards.

use proptest::prelude::*;
use tilewright_sim::Simulation;

use super::*;

const IDLE: LfbSwapIn<u64> =
    LfbSwapIn { done: 0, idle: 1, overflow: 0, draws: 0, clears: 0, patch: 0, line: 0, shown: 0, sending: 0 };

fn control(merge_clocks: u64) -> LfbSwap {
    LfbSwap { patches: 2, merge_clocks, sent_clocks: merge_clocks + 30, overflow_clocks: 100 }
}

type Sim = Simulation<LfbSwapIn, LfbSwapOut>;

fn clock(sim: &mut Sim, inputs: LfbSwapIn<u64>) {
    sim.drive(inputs);
    sim.step_clock(PE, 1);
}

fn clear(sim: &mut Sim, inputs: LfbSwapIn<u64>) {
    (0..2).for_each(|patch| clock(sim, LfbSwapIn { clears: 1, patch, ..inputs }));
}

#[test]
fn a_frame_ends_with_the_line_and_an_overflow_waits_for_its_guards() {
    let mut sim = Simulation::of(&control(12)).unwrap();
    let wave = sim.record(["state", "ready", "line", "shown", "since", "swap", "resume", "frame_end"]);
    sim.reset();
    clear(&mut sim, IDLE);
    clock(&mut sim, LfbSwapIn { done: 1, ..IDLE });
    clock(&mut sim, LfbSwapIn { done: 1, line: 1, ..IDLE });
    clock(&mut sim, IDLE);
    clear(&mut sim, IDLE);
    // T_m has not passed, and the frame is not shown.
    let overflow = LfbSwapIn { overflow: 1, idle: 0, ..IDLE };
    (0..4).for_each(|_| clock(&mut sim, overflow));
    (0..9).for_each(|_| clock(&mut sim, LfbSwapIn { shown: 1, ..overflow }));
    clear(&mut sim, LfbSwapIn { shown: 1, ..overflow });
    clock(&mut sim, LfbSwapIn { shown: 1, ..IDLE });
    wave.expect(
        r"
        pe_clk    |______/~~~\__/~~~\__/~~~~~~~~~~\__/~~~\__/~~~\__/~~~~~~~~~~\__/~~~\__/~~~\__/~~~\_________/~~~\__/
        merge_clk |___________________________/~~~~~~~~~~\________________/~~~~~~~~~~~~~\_____________/~~~~~~~~~~~~~~
        state     | Clear                                   | Draw               | Due  | Clear              | Draw |
        ready     |_________________________________________/~~~~~~~~~~~~~~~~~~~~\___________________________________
        line      |________________________________________________/~~~~~~~~~~~~~\___________________________________
        shown     |__________________________________________________________________________________________________
        since     | 2a                                                                  | 0    | 1           | 2    |
        swap      |______________________________________________________________/~~~~~~\____________________________
        resume    |__________________________________________________________________________________________________
        frame_end |______________________________________________________________/~~~~~~\____________________________

        pe_clk    |~~~\__/~~~\_________/~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/~~~~~~~~~~\__/~~~\__/~~~\__/~~~~~~~
        merge_clk |~~~\_________/~~~~~~~~~~~~~~~~~\_________/~~~~~~~~~~\________________/~~~~~~~~~~\________________/
        state     | Overflow                                                                          | Clear       |
        ready     |__________________________________________________________________________________________________
        line      |__________________________________________________________________________________________________
        shown     |___________________________/~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
        since     | 3    | 4           | 5    | 6    | 7    | 8    | 9    | a    | b           | c    | 0    | 1    |
        swap      |____________________________________________________________________________/~~~~~~\______________
        resume    |__________________________________________________________________________________________________
        frame_end |__________________________________________________________________________________________________

        pe_clk    |~~~\__/~~~\__/~~~\__/~~~\_________/
        merge_clk |~~~~~~~~~~~~~\_____________/~~~~~~~
        state     | Clear              | Draw        |
        ready     |___________________________________
        line      |___________________________________
        shown     |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
        since     | 1    | 2    | 3    | 4           |
        swap      |___________________________________
        resume    |_____________/~~~~~~\______________
        frame_end |___________________________________
        ",
    );
    for what in ["a frame ends", "a buffer overflows"] {
        assert_eq!(sim.covered(what).unwrap(), 1, "{what}");
    }
}

/// If it released the line, a fast processing element that has drawn its next frame would end it with the line of the
/// old one.
#[test]
fn a_processing_element_whose_swap_is_due_pulls_the_line_low() {
    let mut sim = Simulation::of(&control(12)).unwrap();
    sim.reset();
    assert_eq!(sim.get_u64(sim.o.ready), 0);
    clear(&mut sim, IDLE);
    clock(&mut sim, LfbSwapIn { done: 1, idle: 0, ..IDLE });
    assert_eq!(sim.get_u64(sim.o.ready), 0, "a pixel is under way");
    sim.drive(LfbSwapIn { done: 1, ..IDLE });
    assert_eq!(sim.get_u64(sim.o.ready), 1);
    clock(&mut sim, LfbSwapIn { done: 1, line: 1, ..IDLE });
    clock(&mut sim, IDLE);
    clear(&mut sim, IDLE);
    // The previous frame is not shown: the swap is due, and waits.
    clock(&mut sim, LfbSwapIn { done: 1, line: 1, ..IDLE });
    for shown in [0; 20].into_iter().chain([1; 3]) {
        sim.drive(LfbSwapIn { done: 1, shown, ..IDLE });
        assert_eq!((sim.get_u64(sim.o.state), sim.get_u64(sim.o.ready)), (SwapState::Due as u64, 0));
        sim.step_clock(PE, 1);
    }
    sim.drive(LfbSwapIn { shown: 1, ..IDLE });
    assert_eq!((sim.get_u64(sim.o.state), sim.get_u64(sim.o.ready)), (SwapState::Clear as u64, 0));
}

/// The merger learns of a frame's swap at the third of its edges after it. A reset clears `frame`, and the count of
/// cleared entries.
#[test]
fn a_frame_toggles_its_output_and_a_reset_begins_anew() {
    let mut sim = Simulation::of(&control(1)).unwrap();
    sim.reset();
    for phase in 0..16 {
        assert_eq!((sim.get_u64(sim.o.frame), sim.get_u64(sim.o.state)), (0, SwapState::Clear as u64));
        for _ in 0..4 {
            sim.drive(IDLE);
            sim.step_clock(MERGE, 1);
            assert_eq!(sim.get_u64(sim.o.frame), 0);
        }
        clear(&mut sim, IDLE);
        clock(&mut sim, LfbSwapIn { done: 1, line: 1, ..IDLE });
        clock(&mut sim, IDLE);
        let merged = sim.cycles(MERGE).unwrap();
        sim.drive(IDLE);
        while sim.get_u64(sim.o.frame) == 0 {
            sim.step();
        }
        assert_eq!(sim.cycles(MERGE).unwrap(), merged + 3);
        // A reset comes while the program clears or draws, at any distance from the next edges.
        clock(&mut sim, LfbSwapIn { clears: 1, ..IDLE });
        if phase % 2 == 1 {
            clock(&mut sim, LfbSwapIn { clears: 1, patch: 1, ..IDLE });
        }
        sim.drive(IDLE);
        (0..phase).for_each(|_| sim.step());
        sim.reset();
    }
    assert_eq!(sim.get_u64(sim.o.frame), 0);
}

/// Here the previous frame is never shown (VC1-SW4).
#[test]
fn an_overflow_without_a_swap_for_longer_than_its_guards_may_take_is_an_error() {
    let mut sim = Simulation::of(&control(12)).unwrap();
    sim.reset();
    clear(&mut sim, IDLE);
    clock(&mut sim, LfbSwapIn { done: 1, line: 1, ..IDLE });
    clock(&mut sim, IDLE);
    clear(&mut sim, IDLE);
    // The state is `Overflow` in the next clock.
    let overflow = LfbSwapIn { overflow: 1, idle: 0, ..IDLE };
    clock(&mut sim, overflow);
    let start = sim.cycles(PE).unwrap();
    let problem = std::iter::from_fn(|| Some(sim.try_step())).find_map(Result::err).unwrap().to_string();
    let sentence = "the swap of an overflow comes within 2 T_m and the refreshes that the banks wait for";
    assert!(problem.contains(sentence), "{problem}");
    assert_eq!(sim.cycles(PE).unwrap() - start, 100);
}

#[test]
fn what_the_program_must_not_do_is_an_error() {
    let problem = |inputs: LfbSwapIn<u64>| {
        let mut sim = Simulation::of(&control(12)).unwrap();
        sim.reset();
        sim.drive(inputs);
        // Only the first edge counts, because later edges show consequences of the mistake.
        sim.try_step().err().map(|problem| problem.to_string()).unwrap_or_default()
    };
    for (inputs, sentence) in [
        (LfbSwapIn { clears: 1, patch: 1, ..IDLE }, "after a swap the entries are cleared in sequence, each once"),
        (LfbSwapIn { draws: 1, ..IDLE }, "no pixel is drawn between a swap and the last entry cleared"),
        (LfbSwapIn { line: 1, ..IDLE }, "the line is high only while this processing element releases it"),
        (LfbSwapIn { done: 1, ..IDLE }, "`done` is low while the program clears the table"),
    ] {
        assert!(problem(inputs).contains(sentence), "{inputs:?}: {}", problem(inputs));
    }
}

/// A reset also clears `sending` where it has crossed into the processing element's clock.
#[test]
fn a_reset_forgets_what_is_sent() {
    let mut sim = Simulation::of(&control(12)).unwrap();
    for phase in 0..16 {
        sim.reset();
        // After a reset the count of clocks since a swap is at its end, where an assertion demands that all is sent.
        clear(&mut sim, IDLE);
        clock(&mut sim, LfbSwapIn { done: 1, line: 1, ..IDLE });
        clock(&mut sim, IDLE);
        sim.drive(LfbSwapIn { sending: 1, ..IDLE });
        (0..8 + phase).for_each(|_| sim.step());
        sim.reset();
        (0..2).for_each(|_| clock(&mut sim, IDLE));
    }
}

#[test]
fn an_entry_that_is_cleared_while_the_program_draws_is_an_error() {
    let mut sim = Simulation::of(&control(12)).unwrap();
    sim.reset();
    clear(&mut sim, IDLE);
    sim.drive(LfbSwapIn { clears: 1, ..IDLE });
    let clocks = sim.cycles(PE).unwrap();
    let mut problem = None;
    while sim.cycles(PE).unwrap() == clocks && problem.is_none() {
        problem = sim.try_step().err();
    }
    let problem = problem.unwrap().to_string();
    assert!(problem.contains("after a swap the entries are cleared in sequence, each once"), "{problem}");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 96, failure_persistence: None, ..ProptestConfig::default() })]

    /// Compares each swap with the clock of the last one, and with the counts of frames ended and shown (VC1-SW3). A
    /// swap comes in the first clock in which all guards are true. Ports of the other clock are seen 2 clocks later.
    #[test]
    fn a_swap_comes_when_all_guards_hold(
        merge_clocks in 12..40u64,
        jobs in prop::collection::vec((any::<bool>(), 0..30u64, 0..60u64, 0..60u64), 1..12),
        seed in any::<u64>(),
    ) {
        let control = LfbSwap { patches: 3, merge_clocks, sent_clocks: merge_clocks + 200, overflow_clocks: 300 };
        let mut sim = Simulation::of(&control).unwrap().seeded(seed);
        sim.reset();
        let (mut now, mut last_swap, mut ended) = (0, None::<u64>, 0);
        // The clocks in each of which one more frame is shown, and the clock in which the back buffer has been sent.
        let (mut shown_at, mut sent_at) = (Vec::<u64>::new(), 0);
        let step = |sim: &mut Sim, inputs: LfbSwapIn<u64>, now: &mut u64, shown_at: &[u64], sent_at: u64| {
            let shown = shown_at.iter().filter(|at| **at <= *now).count() as u64 % 2;
            sim.drive(LfbSwapIn { shown, sending: u64::from(sent_at > *now), ..inputs });
            let seen = (sim.get_u64(sim.o.swap), sim.get_u64(sim.o.resume));
            sim.step_clock(PE, 1);
            *now += 1;
            seen
        };
        // What the covers count: overflows, tables cleared, and waits for only the shown frame, only T_m, or only the
        // merger.
        let (mut overflowed, mut tables, mut waits_alone) = (0, 0, [0; 3]);
        // A request has been waiting since the last swap.
        let mut holds = false;
        for (overflows, draws, shown_after, sent_after) in jobs {
            for patch in 0..3 {
                // The program pauses between entries.
                for _ in 0..(draws + patch) % 3 {
                    prop_assert_eq!(step(&mut sim, IDLE, &mut now, &shown_at, sent_at), (0, 0));
                }
                let cleared = step(&mut sim, LfbSwapIn { clears: 1, patch, ..IDLE }, &mut now, &shown_at, sent_at);
                prop_assert_eq!(cleared, (0, u64::from(holds && patch == 2)));
            }
            tables += 1;
            holds = overflows;
            for _ in 0..draws {
                step(&mut sim, LfbSwapIn { draws: 1, ..IDLE }, &mut now, &shown_at, sent_at);
            }
            let waits = if overflows { LfbSwapIn { overflow: 1, idle: 0, ..IDLE } } else { IDLE };
            let begins = if overflows { waits } else { LfbSwapIn { done: 1, line: 1, ..IDLE } };
            prop_assert_eq!(step(&mut sim, begins, &mut now, &shown_at, sent_at).0, 0);
            let shown = |now: u64, shown_at: &[u64]| shown_at.iter().filter(|at| **at + 2 <= now).count();
            let (mut guards, mut clocks) = (false, 0);
            while !guards {
                let hold = [
                    shown(now, &shown_at) == ended,
                    last_swap.is_none_or(|at| now - at > merge_clocks),
                    sent_at + 2 <= now.max(2),
                ];
                guards = hold == [true; 3];
                for (guard, count) in waits_alone.iter_mut().enumerate() {
                    *count += u64::from((0..3).all(|other| hold[other] == (other != guard)));
                }
                let (swap, _) = step(&mut sim, waits, &mut now, &shown_at, sent_at);
                prop_assert_eq!(swap == 1, guards, "clock {}", now - 1);
                clocks += 1;
                prop_assert!(clocks < 400);
            }
            last_swap = Some(now - 1);
            sent_at = now + sent_after;
            overflowed += u64::from(overflows);
            if !overflows {
                ended += 1;
                let at = now + 10 + shown_after;
                shown_at.push(at);
            }
        }
        let mut covered = |what: &str| sim.covered(what).unwrap();
        prop_assert_eq!(covered("a frame ends"), ended as u64);
        prop_assert_eq!([covered("a buffer overflows"), covered("an overflow ends with a swap")], [overflowed; 2]);
        prop_assert_eq!(covered("the last entry is cleared"), tables);
        let alone = ["the global frame buffer", "T_m", "the merger"];
        prop_assert_eq!(alone.map(|it| covered(&format!("a swap waits for {it} alone"))), waits_alone);
    }
}
