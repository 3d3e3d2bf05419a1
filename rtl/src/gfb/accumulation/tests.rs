//! The accumulation buffer clock by clock: by example, and in [`model`] against sums in plain software.

mod model;

use tilewright_sim::Simulation;

use super::*;
use crate::clocks::CRT;

type Sim = Simulation<AccumulationIn, AccumulationOut>;

fn accumulation(width: u32, height: u32) -> Sim {
    let mut sim = Simulation::of(&Accumulation { screen: Screen { width, height }, crt: CRT }).unwrap().seeded(7);
    sim.reset();
    sim
}

/// One clock of the merger, with a software global frame buffer that returns the word of the previous address.
fn clock(sim: &mut Sim, picture: &[u64]) {
    let asked = sim.get_u64(sim.o.address) as usize;
    sim.step_clock(MERGE, 1);
    // A depth, which must not affect the sum.
    sim.set(sim.i.word, 0xabcdef << 24 | picture[asked]);
}

/// Runs a pass; returns the clocks for which it is busy.
fn pass(sim: &mut Sim, first: bool, picture: &[u64]) -> u64 {
    sim.set(sim.i.start, 1);
    sim.set(sim.i.first, first);
    clock(sim, picture);
    sim.set(sim.i.start, 0);
    sim.set(sim.i.first, 0);
    let mut clocks = 0;
    while sim.get_u64(sim.o.busy) == 1 {
        clock(sim, picture);
        clocks += 1;
        assert!(clocks < 1000, "a pass has no end");
    }
    clocks
}

/// What the display reads at each pixel.
fn shown(sim: &mut Sim, passes: Passes, pixels: usize) -> Vec<u64> {
    sim.set(sim.i.passes, passes.code());
    let read = |pixel: usize| {
        sim.set(sim.i.read_address, pixel as u64);
        sim.step_clock(CRT, 1);
        sim.get_u64(sim.o.colour)
    };
    (0..pixels).map(read).collect()
}

#[test]
fn two_passes_clock_by_clock() {
    let mut sim = accumulation(3, 1);
    let wave = sim.record([
        "start", "first", "busy", "address", "word", "stores", "stored", "old[0]", "old[1]", "added[0]", "colour",
    ]);
    sim.set(sim.i.read_address, 1);
    pass(&mut sim, true, &[0x10, 0x20, 0x30]);
    pass(&mut sim, false, &[0x12, 0x23, 0x34]);
    wave.expect(
        r"
        merge_clk |~~~~~~~~~~~~~\____________/~~~~~~~~~~~~~\____________/~~~~~~~~~~~~~\____________/~~~~~~~~~~~~~\____
        crt_clk   |~~~~\___/~~~~\___/~~~~~~~~~~~~~\___/~~~~\___/~~~~~~~~~~~~~\___/~~~~\___/~~~~~~~~~~~~~\___/~~~~\___/
        start     |~~~~~~~~~~~~~~~~~~~~~~~~~~\________________________________________________________________________
        first     |~~~~~~~~~~~~~~~~~~~~~~~~~~\________________________________________________________________________
        busy      |__________________________/~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
        address   | 0                                                   | 1                        | 2               |
        word      | 0                        | abcdef000010                                        | abcdef000020    |
        stores    |_____________________________________________________/~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
        stored    | 0                                                                              | 1               |
        old[0]    | ab079da98                                           | 1632e7915                                  |
        old[1]    | b9e940f8e                                                                      | b365f1fb7       |
        added[0]  | 0                        | 10                                                  | 20              |
        colour    | b2748b | 9bf9dc                                                                                  |

        merge_clk |________/~~~~~~~~~~~~~\____________/~~~~~~~~~~~~~\____________/~~~~~~~~~~~~~\____________/~~~~~~~~~
        crt_clk   |~~~~~~~~~~~~~\___/~~~~\___/~~~~~~~~~~~~~\___/~~~~\___/~~~~~~~~~~~~~\___/~~~~\___/~~~~~~~~~~~~~\___/
        start     |___________________________________/~~~~~~~~~~~~~~~~~~~~~~~~~~\____________________________________
        first     |___________________________________________________________________________________________________
        busy      |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~\__________________________/~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
        address   | 2      | 0                                                                              | 1      |
        word      | abcd.. | abcdef000030             | abcdef000010             | abcdef000012                      |
        stores    |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~\_____________________________________________________/~~~~~~~~~
        stored    | 1      | 2                        | 0                                                            |
        old[0]    | 1632.. | 8afbf4eb4                                                                      | 10     |
        old[1]    | b365f1fb7                                                                                        |
        added[0]  | 20     | 30                       | 10                       | ec6                      | 22     |
        colour    | 9bf9dc          | 10                                                                             |

        merge_clk |~~~~\____________/~~~~~~~~~~~~~\____________/~~~~~~~~~~~~~\____________/
        crt_clk   |~~~~\___/~~~~~~~~~~~~~\___/~~~~\___/~~~~~~~~~~~~~\___/~~~~\___/~~~~~~~~~
        start     |________________________________________________________________________
        first     |________________________________________________________________________
        busy      |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
        address   | 1               | 2                        | 0                        |
        word      | abcdef000012    | abcdef000023             | abcdef000034             |
        stores    |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
        stored    | 0               | 1                        | 2                        |
        old[0]    | 10                                         | 30                       |
        old[1]    | b365f1fb7       | 20                                                  |
        added[0]  | 22              | 43                       | 64                       |
        colour    | 10                                                  | 22              |
        ",
    );
}

#[test]
fn as_many_white_passes_as_the_average_is_of_are_white() {
    for passes in Passes::ALL {
        let mut sim = accumulation(3, 3);
        for number in 1..=passes.count() {
            assert_eq!(pass(&mut sim, number == 1, &[0xffffff; 9]), 10);
            let of_16 = if number == 16 { 9 } else { 0 };
            assert_eq!(sim.covered("a pixel is the sum of 16 passes").unwrap(), of_16, "after {number}");
        }
        assert_eq!(shown(&mut sim, *passes, 9), [0xffffff; 9], "{passes:?}");
    }
}

/// A half is rounded up and less is rounded down, for each component by itself.
#[test]
fn the_average_is_rounded() {
    for passes in Passes::ALL {
        let half = passes.count() / 2;
        let mut sim = accumulation(2, 1);
        // In red and blue, half as many ones as passes at the first pixel, and one fewer at the second.
        for number in 0..passes.count() {
            let [all, one_less] = [half, half - 1].map(|ones| u64::from(number < ones));
            pass(&mut sim, number == 0, &[all << 16 | all, one_less << 16 | one_less << 8]);
        }
        assert_eq!(shown(&mut sim, *passes, 2), [0x010001, 0x000000], "{passes:?}");
    }
}

#[test]
fn a_first_pass_replaces_what_was_there() {
    let mut sim = accumulation(2, 2);
    pass(&mut sim, true, &[0xffffff; 4]);
    pass(&mut sim, false, &[0xffffff; 4]);
    pass(&mut sim, true, &[0x102030; 4]);
    pass(&mut sim, false, &[0x122436; 4]);
    assert_eq!(shown(&mut sim, Passes::Two, 4), [0x112233; 4]);
}

/// The assertion that stops the simulation when a pass is started, if any.
fn problem(sim: &mut Sim, first: bool) -> Option<String> {
    sim.set(sim.i.start, 1);
    sim.set(sim.i.first, first);
    let to = sim.time() + MERGE.period.picoseconds();
    sim.try_run_to(to).err().map(|problem| problem.to_string())
}

#[test]
fn a_pass_at_the_wrong_time_is_an_error() {
    for (clocks, is_error) in [(1, true), (5, true), (6, false)] {
        let mut sim = accumulation(5, 1);
        sim.set(sim.i.start, 1);
        sim.set(sim.i.first, 1);
        sim.step_clock(MERGE, 1);
        sim.set(sim.i.start, 0);
        sim.step_clock(MERGE, clocks);
        let problem = problem(&mut sim, true);
        assert_eq!(problem.is_some(), is_error, "after {clocks} clocks: {problem:?}");
        assert!(problem.is_none_or(|text| text.contains("a pass begins only while none is under way")), "{clocks}");
    }
}

#[test]
fn a_pass_without_a_first_one_or_a_17th_is_an_error() {
    let sentence = "a pass is the first, or one of at most 15 that follow it";
    assert!(problem(&mut accumulation(2, 1), false).is_some_and(|text| text.contains(sentence)));
    for (passes, before) in [(1, 0), (15, 0), (16, 0), (15, 9), (16, 9), (16, 16)] {
        let mut sim = accumulation(2, 1);
        // A first pass begins afresh.
        for number in (0..before).chain(0..passes) {
            pass(&mut sim, number == 0, &[0; 2]);
        }
        let problem = problem(&mut sim, false);
        assert_eq!(problem.is_some_and(|text| text.contains(sentence)), passes == 16, "{before} and {passes} passes");
    }
}

/// A reset in the middle of a pass ends it; the next pass must be a first one.
#[test]
fn a_pass_ends_with_a_reset() {
    let mut sim = accumulation(4, 1);
    sim.set(sim.i.start, 1);
    sim.set(sim.i.first, 1);
    sim.step_clock(MERGE, 1);
    sim.set(sim.i.start, 0);
    sim.step_clock(MERGE, 2);
    sim.reset();
    assert_eq!((sim.get_u64(sim.o.busy), sim.get_u64(sim.o.address)), (0, 0));
    assert!(problem(&mut sim, false).is_some());
}
