//! The backing store clock by clock, and with random regions and a receiver that pauses.

use proptest::prelude::*;
use tilewright_sim::{Pauses, Simulation, monitor};

use super::*;

type Store = Simulation<BackingStoreIn, BackingStoreOut>;

fn started(side: u32, seed: u64) -> Store {
    let mut sim = Simulation::of(&BackingStore { side }).unwrap().seeded(seed);
    sim.reset();
    sim
}

#[test]
fn the_first_plane_goes_2_clocks_after_the_last_came_and_one_that_waits_stays() {
    let mut sim = started(2, 0);
    let (i, o) = (sim.i, sim.o);
    sim.set(i.save.claim, 1);
    sim.set(i.save.region, 5);
    sim.step();
    sim.set(i.save.claim, 0);
    sim.set(i.save.plane, 1);
    for number in 0..48 {
        sim.set(i.number, number);
        sim.set_lanes(i.word, [1, number % 2, 0, 1]);
        if number == 47 {
            break;
        }
        sim.step();
    }
    let signals = [
        "save_plane",
        "free",
        "planes_valid",
        "planes_ready",
        "planes_region",
        "planes_line",
        "planes_plane",
        "planes_bits[0]",
        "planes_bits[1]",
    ];
    let wave = sim.record(signals);
    for clock in 0..7 {
        sim.set(o.planes.ready, clock != 2);
        sim.step();
        sim.set(i.save.plane, 0);
    }
    wave.expect(
        r"
        clk            |~\_/~\_/~\_/~\_/~\_/~\_/~\_/
        save_plane     |~~~\________________________
        free           |____________________________
        planes_valid   |_______/~~~~~~~~~~~~~~~~~~~~
        planes_ready   |~~~~~~~\___/~~~~~~~~~~~~~~~~
        planes_region  | 5                         |
        planes_line    |____________________________
        planes_plane   | 0             | 1 | 2 | 3 |
        planes_bits[0] |_______/~~~~~~~~~~~~~~~~~~~~
        planes_bits[1] |_______________/~~~\___/~~~~
        ",
    );
    sim.run(89);
    let wave = sim.record(["free", "planes_valid", "planes_line", "planes_plane", "planes_bits[0]", "planes_bits[1]"]);
    sim.run(6);
    wave.expect(
        r"
        clk            |~~\_/~~\_/~~\_/~~\_/~~\_/~~\_/
        free           |______________/~~~~~~~~~~~~~~~
        planes_valid   |~~~~~~~~~~~~~~\_______________
        planes_line    |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
        planes_plane   | 2d | 2e | 2f                |
        planes_bits[0] |______________________________
        planes_bits[1] |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
        ",
    );
}

#[test]
#[should_panic(expected = "a region is claimed only when the previous one has left")]
fn a_region_that_comes_too_early_is_an_error() {
    let mut sim = started(8, 0);
    sim.set(sim.i.save.claim, 1);
    sim.run(2);
}

#[test]
#[should_panic(expected = "a plane arrives only for a region that was claimed")]
fn a_plane_without_a_region_is_an_error() {
    let mut sim = started(8, 0);
    sim.set(sim.i.save.plane, 1);
    sim.run(2);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 8, failure_persistence: None, ..ProptestConfig::default() })]

    /// Each region leaves as it arrived, line by line, plane by plane, however long the receiver waits.
    #[test]
    fn regions_go_as_they_came(
        regions in prop::collection::vec(prop::collection::vec(0..1u64 << 48, 64), 1..3),
        (percent, seed) in (0..60u64, any::<u64>()),
    ) {
        const SIDE: usize = 8;
        let mut sim = started(SIDE as u32, seed);
        let (i, o) = (sim.i, sim.o);
        let t = sim.testbench();
        t.limit(10_000);
        let come = async {
            for (region, words) in (0u64..).zip(&regions) {
                t.until(o.free).await;
                t.set(i.save.claim, 1);
                t.set(i.save.region, 1000 + region);
                t.step().await;
                t.set(i.save.claim, 0);
                t.set(i.save.region, 0);
                for number in 0..48u32 {
                    t.wait((seed >> number) & 1).await;
                    t.set(i.save.plane, 1);
                    t.set(i.number, number);
                    let bits: Vec<Bits> = words.iter().map(|word| Bits::new(1, word >> number & 1)).collect();
                    t.set(i.word, Bits::join(&bits));
                    t.step().await;
                    t.set(i.save.plane, 0);
                }
            }
        };
        let go = async {
            let mut pauses = Pauses::percent(percent, seed);
            let mut planes = Vec::new();
            for _ in 0..regions.len() * SIDE * 48 {
                t.wait(pauses.next_length().into()).await;
                planes.push(t.receive(o.planes).await);
            }
            t.expect_silence(o.planes, 20).await;
            planes
        };
        let ((), planes, ()) = t.run((come, go, monitor(t.holds(o.planes))));
        let mut expected = Vec::new();
        for (region, words) in (1000..).zip(&regions) {
            for (line, words) in (0..).zip(words.chunks(SIDE)) {
                for plane in 0..48 {
                    let bits = (0..).zip(words).map(|(at, word)| (word >> plane & 1) << at).sum();
                    expected.push(BitPlane { region, line, plane, bits });
                }
            }
        }
        prop_assert_eq!(planes, expected);
    }
}
