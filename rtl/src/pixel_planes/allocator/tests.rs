//! The allocator clock by clock, and against a queue of free renderers.

use proptest::prelude::*;
use tilewright_sim::Simulation;

use super::*;

#[test]
fn of_those_free_in_a_clock_the_lowest_is_served_first() {
    let mut sim = Simulation::of(&RegionAllocator { renderers: 3 }).unwrap();
    sim.reset();
    let i = sim.i;
    let wave = sim.record([
        "regions_valid",
        "regions_ready",
        "region",
        "free[0]",
        "free[1]",
        "free[2]",
        "given[0]",
        "given[1]",
        "given[2]",
    ]);
    let clocks = [(1, 5, [0, 0, 0]), (1, 5, [0, 1, 1]), (1, 9, [0, 0, 1]), (0, 9, [1, 0, 0]), (1, 7, [1, 0, 0])];
    for (valid, region, free) in clocks {
        sim.set(i.regions.valid, valid);
        sim.set(i.regions.payload, region);
        sim.set_lanes(i.free, free);
        sim.step();
    }
    wave.expect(
        r"
        clk           |~\_/~\_/~\_/~\_/~\_/
        regions_valid |~~~~~~~~~~~\___/~~~~
        regions_ready |___/~~~~~~~~~~~~~~~~
        region        | 5     | 9     | 7 |
        free[0]       |___________/~~~~~~~~
        free[1]       |___/~~~\____________
        free[2]       |___/~~~~~~~\________
        given[0]      |_______________/~~~~
        given[1]      |___/~~~\____________
        given[2]      |_______/~~~\________
        ",
    );
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    /// Renderers that are busy for as long as their region takes. Each region goes to the renderer that has been free
    /// longest; ties go to the lowest.
    #[test]
    fn each_region_goes_to_the_first_that_is_free(
        (renderers, loads) in (1..9u32, prop::collection::vec(1..40u64, 1..30)),
    ) {
        let mut sim = Simulation::of(&RegionAllocator { renderers }).unwrap();
        sim.reset();
        let i = sim.i;
        let mut busy_until = vec![0; renderers as usize];
        let mut last_clock = None;
        for clock in 0..2000 {
            let free: Vec<u64> = busy_until.iter().map(|until| u64::from(*until <= clock)).collect();
            let next = last_clock.map_or(0, |(number, _)| number + 1);
            sim.set(i.regions.valid, u64::from(next < loads.len()));
            sim.set(i.regions.payload, next as u64);
            sim.set_lanes(i.free, free);
            let given = sim.lanes(sim.o.given);
            if let Some(renderer) = given.iter().position(|given| *given == 1) {
                prop_assert_eq!(given.iter().sum::<u64>(), 1);
                prop_assert_eq!(sim.get_u64(sim.o.region), next as u64);
                let first = (0..busy_until.len()).min_by_key(|renderer| (busy_until[*renderer].max(
                    last_clock.map_or(0, |(_, clock)| clock + 1)), *renderer)).unwrap();
                prop_assert_eq!(renderer, first);
                // No renderer waited while a region was available.
                prop_assert_eq!(clock, busy_until[first].max(last_clock.map_or(0, |(_, clock)| clock + 1)));
                busy_until[renderer] = clock + 1 + loads[next];
                last_clock = Some((next, clock));
            }
            sim.step();
        }
        prop_assert_eq!(last_clock.map(|(number, _)| number + 1), Some(loads.len()));
    }
}
