//! The tree clock by clock, for all small coefficients, and for random ones.

use proptest::prelude::*;
use tilewright_sim::Simulation;

use super::super::linear_tree::{LinearTree, LinearTreeIn};
use super::super::testing::{self, Sent};
use super::*;

fn inputs([a, b, c, d, e, f]: [u64; 6], first: bool) -> QuadraticTreeIn<u64> {
    QuadraticTreeIn { coefficients: Coefficients { a, b, c }, curve: Curve { d, e, f }, first: first.into() }
}

fn expect_sums(side: u32, all: &[Sent<6>]) {
    let tree = QuadraticTree { side };
    testing::expect_sums((&tree, side, tree.latency()), inputs, all);
}

#[test]
fn each_level_takes_two_clocks() {
    let mut sim = Simulation::of(&QuadraticTree { side: 2 }).unwrap();
    sim.reset();
    let wave = sim.record(["first", "coefficients_a", "coefficients_c", "curve_d", "value[0][0]", "value[0][1]"]);
    // 3 x + 5 + x², and immediately after it -x - 1 + 6 x², 4 bits each.
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

    /// Expressions of log2 S bits or more, without a gap or with pauses.
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

    /// Without a curve it equals the linear tree, 2 log2 S clocks later.
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
