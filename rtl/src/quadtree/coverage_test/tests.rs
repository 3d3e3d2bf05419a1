//! The coverage test unit clock by clock, and against the definition of a window that a polygon may cover.

use proptest::prelude::*;
use tilewright_sim::{Simulation, Wave};

use super::super::model::{Convex, Raster, Square};
use super::super::testing::{NO_STALLS, divide, first, formats, parts, polygons, rasters, small, stalls, triangle};
use super::*;

const SHOWN: [&str; 7] = ["works_valid", "works_ready", "number", "step", "moves", "parts_valid", "parts_ready"];

/// Two windows without a gap; in the first, three quarters pass and one fails. The receiver pauses in the clocks `away`.
fn two_windows(test: Test, clocks: u64, away: std::ops::Range<u64>) -> Wave {
    let unit = CoverageTest { format: small(), test, from: 2, sizes: 1 };
    let mut sim = Simulation::of(&unit).unwrap();
    sim.reset();
    let raster = first(small());
    let wave = sim.record(SHOWN);
    let shown = |valid| Stream {
        valid: Bits::new(1, valid),
        ready: Bits::zero(1),
        payload: raster.work(&triangle(), raster.root()),
    };
    for clock in 0..clocks {
        sim.drive_bits(DividerIn { works: shown(1) });
        sim.set(sim.o.parts.ready, !away.contains(&clock));
        sim.step();
    }
    wave
}

#[test]
fn a_quarter_takes_a_clock_for_each_edge_and_4_more_if_it_passes() {
    two_windows(Test::Serial, 27, 0..0).expect(
        r"
        clk         |~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/
        works_valid |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
        works_ready |~~~\____________________________________________________________________________________________
        number      | 0                             | 1                         | 2                         | 3     |
        step        | 0     | 1 | 2 | 0 | 1 | 2 | 3 | 0 | 1 | 2 | 0 | 1 | 2 | 3 | 0 | 1 | 2 | 0 | 1 | 2 | 3 | 0 | 1 |
        moves       |_______________/~~~~~~~~~~~~~~~\___________/~~~~~~~~~~~~~~~\___________/~~~~~~~~~~~~~~~\________
        parts_valid |___________________________/~~~\_______________________/~~~\_______________________/~~~\________
        parts_ready |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~

        clk         |~\_/~\_/~\_/
        works_valid |~~~~~~~~~~~~
        works_ready |~~~\________
        number      | 3 | 0     |
        step        | 2 | 0 | 1 |
        moves       |____________
        parts_valid |____________
        parts_ready |~~~~~~~~~~~~
        ",
    );
}

#[test]
fn with_an_adder_for_each_edge_a_quarter_takes_a_clock_and_4_more_if_it_passes() {
    two_windows(Test::Parallel, 19, 0..0).expect(
        r"
        clk         |~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/
        works_valid |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
        works_ready |~~~\___________________________________________________________/~~~\________
        number      | 0                     | 1                 | 2                 | 3 | 0     |
        step        | 0         | 1 | 2 | 3 | 0     | 1 | 2 | 3 | 0     | 1 | 2 | 3 | 0         |
        moves       |_______/~~~~~~~~~~~~~~~\___/~~~~~~~~~~~~~~~\___/~~~~~~~~~~~~~~~\_______/~~~~
        parts_valid |___________________/~~~\_______________/~~~\_______________/~~~\____________
        parts_ready |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
        ",
    );
}

#[test]
fn a_quarter_waits_for_its_receiver_and_nothing_else_happens() {
    two_windows(Test::Parallel, 12, 5..8).expect(
        r"
        clk         |~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/
        works_valid |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
        works_ready |~~~\____________________________________________
        number      | 0                                 | 1         |
        step        | 0         | 1 | 2 | 3             | 0     | 1 |
        moves       |_______/~~~~~~~~~~~~~~~~~~~~~~~~~~~\___/~~~~~~~~
        parts_valid |___________________/~~~~~~~~~~~~~~~\____________
        parts_ready |~~~~~~~~~~~~~~~~~~~\___________/~~~~~~~~~~~~~~~~
        ",
    );
}

/// A window of that size, reached from the root through quarters that pass, or through any quarter if none passes.
fn window(raster: &Raster, polygon: &Convex, size: u32, choice: u64) -> Square {
    let mut window = raster.root();
    while window.size > size {
        let passed = window.quarters().into_iter().filter(|quarter| raster.may_cover(polygon, *quarter));
        let passed: Vec<_> = passed.collect();
        let choice = choice as usize >> (2 * window.size);
        window = *passed.get(choice % passed.len().max(1)).unwrap_or(&window.quarters()[choice % 4]);
    }
    window
}

fn windows() -> impl Strategy<Value = (Raster, u32, u32, Vec<(Convex, Square)>)> {
    let raster = formats(2048).prop_flat_map(rasters);
    let sizes = raster.prop_flat_map(|raster| (Just(raster), 1..raster.format.levels() + 1));
    let sizes = sizes.prop_flat_map(|(raster, from)| (Just(raster), Just(from), 1..from.min(3) + 1));
    sizes.prop_flat_map(|(raster, from, sizes)| {
        let window = (polygons(raster.format), from - sizes + 1..from + 1, any::<u64>()).prop_map(
            move |(polygon, size, choice)| {
                let window = window(&raster, &polygon, size, choice);
                (polygon, window)
            },
        );
        (Just(raster), Just(from), Just(sizes), prop::collection::vec(window, 1..8))
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    /// The quarters selected by their corners and by four bounds, with all their values, and the clocks of the cost
    /// model (MPG-EQ5).
    #[test]
    fn it_sends_the_quarters_that_the_definition_says((raster, from, sizes, windows) in windows(), stalls in stalls()) {
        let works: Vec<_> = windows.iter().map(|(polygon, window)| raster.work(polygon, *window)).collect();
        let quarters = |(polygon, window): &(Convex, Square)| parts(&raster, polygon, *window, window.size - 1);
        let expected: Vec<_> = windows.iter().flat_map(quarters).collect();
        for test in [Test::Serial, Test::Parallel] {
            let unit = CoverageTest { format: raster.format, test, from, sizes };
            let (parts, tally) = divide(&unit, works.clone(), expected.len(), stalls);
            prop_assert_eq!(&parts, &expected);
            for (level, tally) in tally.iter().enumerate() {
                let size = from - level as u32;
                let here = || windows.iter().filter(|(_, window)| window.size == size);
                let passed = here().map(|window| quarters(window).len() as u64).sum::<u64>();
                let tests = |(polygon, _): &(Convex, Square)| 4 * if test == Test::Serial { polygon.edges.len() } else { 1 };
                let busy = here().map(|window| tests(window) as u64).sum::<u64>() + 4 * passed;
                prop_assert_eq!((tally.busy, tally.results), (busy, passed));
                prop_assert!(stalls.receivers > 0 || tally.stalled == 0);
            }
        }
    }
}

/// A polygon that covers one pixel by its bounds alone: one of the quarters without the pixel is beyond two bounds at
/// once.
#[test]
fn a_quarter_beyond_two_bounds_fails_as_one_beyond_one_does() {
    let raster = first(small());
    for [x, y] in [[0, 0], [6, 0], [0, 6], [6, 6]] {
        let polygon = Convex { edges: vec![[0, 0, 1]; 3], bounds: [x, y, x, y], ..triangle() };
        let expected = parts(&raster, &polygon, raster.root(), 1);
        assert_eq!(expected.len(), 1);
        for test in [Test::Serial, Test::Parallel] {
            let unit = CoverageTest { format: small(), test, from: 2, sizes: 1 };
            let (found, _) = divide(&unit, vec![raster.work(&polygon, raster.root())], 1, NO_STALLS);
            assert_eq!(found, expected);
        }
    }
}

#[test]
fn clocks_in_which_a_part_waits_are_counted_apart() {
    let raster = first(small());
    let unit = CoverageTest { format: small(), test: Test::Serial, from: 2, sizes: 1 };
    let works = vec![raster.work(&triangle(), raster.root())];
    let (_, tally) = divide(&unit, works.clone(), 3, NO_STALLS);
    assert_eq!(tally, [Tally { busy: 4 * 3 + 3 * 4, stalled: 0, results: 3 }]);
    let (_, tally) = divide(&unit, works, 3, super::super::testing::Stalls { receivers: 97, ..NO_STALLS });
    assert_eq!((tally[0].busy, tally[0].results), (24, 3));
    assert!(tally[0].stalled > 0);
}
