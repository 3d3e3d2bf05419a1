//! The tree clock by clock, for all small coefficients, and at random.

use proptest::prelude::*;
use tilewright_sim::Simulation;

use super::super::linear_tree::{LinearTree, LinearTreeIn};
use super::*;

/// An expression, and how many of its bits are sent.
#[derive(Debug, Clone, Copy)]
struct Sent {
    /// A to F.
    coefficients: [u64; 6],
    bits: u32,
    /// Clocks in which something is sent that belongs to no expression.
    pause: u32,
}

/// The value at a pixel, modulo 2^64.
fn at([a, b, c, d, e, f]: [u64; 6], x: u64, y: u64) -> u64 {
    let terms = [(a, x), (b, y), (c, 1), (d, x * x), (e, x * y), (f, y * y)];
    terms.iter().fold(0, |sum: u64, (coefficient, times)| sum.wrapping_add(coefficient.wrapping_mul(*times)))
}

fn inputs([a, b, c, d, e, f]: [u64; 6], first: bool) -> QuadraticTreeIn<u64> {
    QuadraticTreeIn { coefficients: Coefficients { a, b, c }, curve: Curve { d, e, f }, first: first.into() }
}

/// Sends expressions one after another, and compares each pixel's bits with the formula.
fn expect_sums(side: u32, all: &[Sent]) {
    let tree = QuadraticTree { side };
    let mut sim = Simulation::of(&tree).unwrap().seeded(u64::from(side));
    sim.reset();
    let clocks = all.iter().flat_map(|sent| (0..sent.bits + sent.pause).map(move |clock| (*sent, clock)));
    let clocks: Vec<(Sent, u32)> = clocks.collect();
    for time in 0..clocks.len() + tree.latency() as usize {
        if let Some(&(Sent { coefficients, bits, .. }, clock)) = clocks.get(time) {
            let sent = coefficients.map(|number| if clock < bits { number >> clock & 1 } else { 1 });
            sim.drive(inputs(sent, clock == 0));
        }
        if let Some(&(Sent { coefficients, bits, .. }, clock)) = time
            .checked_sub(tree.latency() as usize)
            .map(|sent| &clocks[sent])
            .filter(|(sent, clock)| *clock < sent.bits)
        {
            let side = u64::from(side);
            let bit = |pixel| at(coefficients, pixel % side, pixel / side) >> clock & 1;
            let expected: Vec<u64> = (0..side * side).map(bit).collect();
            assert_eq!(sim.lanes(sim.o.value), expected, "bit {clock} of {bits} of {coefficients:?}");
        }
        sim.step();
    }
}

#[test]
fn each_level_takes_two_clocks() {
    let mut sim = Simulation::of(&QuadraticTree { side: 2 }).unwrap();
    sim.reset();
    let wave = sim.record(["first", "coefficients_a", "coefficients_c", "curve_d", "value[0][0]", "value[0][1]"]);
    // 3 x + 5 + x², and right behind it -x - 1 + 6 x², 4 bits each.
    for (a, c, d) in [(3, 5, 1), (15, 15, 6), (0, 0, 0)] {
        for clock in 0..4 {
            sim.drive(inputs([a, 0, c, d, 0, 0].map(|number| number >> clock & 1), clock == 0));
            sim.step();
        }
    }
    wave.expect(
        r"
        clk            |~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/
        first          |~~~\___________/~~~\___________/~~~\____________
        coefficients_a |~~~~~~~\_______/~~~~~~~~~~~~~~~\________________
        coefficients_c |~~~\___/~~~\___/~~~~~~~~~~~~~~~\________________
        curve_d        |~~~\_______________/~~~~~~~\____________________
        value[0][0]    |_______________/~~~\___/~~~\___/~~~~~~~~~~~~~~~~
        value[0][1]    |_______________/~~~\_______/~~~\_______/~~~\____
        ",
    );
}

#[test]
fn it_gives_all_sums_of_small_coefficients_on_2x2_and_4x4_pixels() {
    for (side, widths) in [(2, 1..3), (4, 2..3)] {
        for bits in widths {
            let numbers = 0..1u64 << (6 * bits);
            let sent = |all: u64| {
                let part = |place: u32| all >> (place * bits) & ((1 << bits) - 1);
                Sent { coefficients: [0, 1, 2, 3, 4, 5].map(part), bits, pause: 0 }
            };
            expect_sums(side, &numbers.map(sent).collect::<Vec<_>>());
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 16, failure_persistence: None, ..ProptestConfig::default() })]

    /// Of any length from log2 S on, right behind one another or with pauses.
    #[test]
    fn it_gives_the_sums_of_any_coefficients(
        (side, all) in (0..5u32).prop_flat_map(|level| {
            let levels = level + 1;
            let bits = prop_oneof![levels..levels + 3, levels..65];
            let coefficient = prop_oneof![3 => any::<u64>(), 1 => Just(0)];
            let sent = (prop::array::uniform6(coefficient), bits, prop_oneof![Just(0), 0..9u32])
                .prop_map(|(coefficients, bits, pause)| Sent { coefficients, bits, pause });
            (Just(1 << levels), prop::collection::vec(sent, 1..8))
        }),
    ) {
        expect_sums(side, &all);
    }

    /// Without a curve it is the linear tree, 2 log2 S clocks later.
    #[test]
    fn without_a_curve_it_is_the_linear_tree(level in 1..5u32, sent in prop::collection::vec((any::<[u64; 3]>(), 5..41u32), 1..5)) {
        let side = 1 << level;
        let mut linear = Simulation::of(&LinearTree { side }).unwrap();
        let mut quadratic = Simulation::of(&QuadraticTree { side }).unwrap();
        linear.reset();
        quadratic.reset();
        let clocks = sent.iter().flat_map(|(coefficients, bits)| (0..*bits).map(move |bit| (*coefficients, bit)));
        let clocks: Vec<_> = clocks.collect();
        let lag = 2 * level as usize;
        let mut values = Vec::new();
        for (time, (coefficients, bit)) in clocks.iter().enumerate() {
            let [a, b, c] = coefficients.map(|number| number >> bit & 1);
            linear.drive(LinearTreeIn { coefficients: Coefficients { a, b, c }, first: u64::from(*bit == 0) });
            quadratic.drive(inputs([a, b, c, 0, 0, 0], *bit == 0));
            values.push(linear.lanes(linear.o.value));
            if time >= 2 * lag {
                prop_assert_eq!(quadratic.lanes(quadratic.o.value), &values[time - lag][..], "clock {}", time);
            }
            linear.step();
            quadratic.step();
        }
    }
}
