//! The tree clock by clock, for all small coefficients, and for random ones.

use proptest::prelude::*;
use tilewright_sim::Simulation;

use super::super::testing::{self, Sent};
use super::*;

fn inputs([a, b, c]: [u64; 3], first: bool) -> LinearTreeIn<u64> {
    LinearTreeIn { coefficients: Coefficients { a, b, c }, first: first.into() }
}

fn expect_sums(side: u32, all: &[Sent<3>]) {
    let tree = LinearTree { side };
    testing::expect_sums((&tree, side, tree.latency()), inputs, all);
}

#[test]
fn each_level_takes_a_clock() {
    let mut sim = Simulation::of(&LinearTree { side: 2 }).unwrap();
    sim.reset();
    let wave = sim.record(["first", "coefficients_a", "coefficients_c", "value[0][0]", "value[0][1]"]);
    // 3 x + 5, and immediately after it -x - 1, 4 bits each.
    for (a, c) in [(3, 5), (15, 15), (0, 0)] {
        for clock in 0..4 {
            sim.drive(inputs([a >> clock & 1, 0, c >> clock & 1], clock == 0));
            sim.step();
        }
    }
    wave.expect(
        r"
        clk            |~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/
        first          |~~~\___________/~~~\___________/~~~\____________
        coefficients_a |~~~~~~~\_______/~~~~~~~~~~~~~~~\________________
        coefficients_c |~~~\___/~~~\___/~~~~~~~~~~~~~~~\________________
        value[0][0]    |_______/~~~\___/~~~\___/~~~~~~~~~~~~~~~\________
        value[0][1]    |___________________/~~~\___/~~~~~~~~~~~\________
        ",
    );
}

#[test]
fn it_gives_all_sums_of_small_coefficients_on_2x2_and_4x4_pixels() {
    for (side, widths) in [(2, 1..5), (4, 2..5)] {
        for bits in widths {
            let numbers = 0..1u64 << (3 * bits);
            let sent = |all: u64| {
                let part = |place: u32| all >> (place * bits) & ((1 << bits) - 1);
                Sent { coefficients: [part(0), part(1), part(2)], bits, pause: 0 }
            };
            expect_sums(side, &numbers.map(sent).collect::<Vec<_>>());
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 12, failure_persistence: None, ..ProptestConfig::default() })]

    /// Expressions of log2 S bits or more, without a gap or with pauses.
    #[test]
    fn it_gives_the_sums_of_any_coefficients(
        (side, all) in (0..5u32).prop_flat_map(|level| {
            let levels = level + 1;
            let sent = (any::<[u64; 3]>(), levels..65, prop_oneof![Just(0), 0..9u32])
                .prop_map(|(coefficients, bits, pause)| Sent { coefficients, bits, pause });
            (Just(1 << levels), prop::collection::vec(sent, 1..8))
        }),
    ) {
        expect_sums(side, &all);
    }
}
