//! The set-up clock by clock, and against a direct evaluation at the limits of the guard band.

use proptest::prelude::*;
use tilewright_sim::{Pauses, Simulation, monitor};

use super::super::model::{Convex, Raster};
use super::super::testing::{Stalls, first, formats, polygons, rasters, small, stalls, triangle};
use super::*;

/// The set-up's roots for polygons, and its counters.
fn set_up(raster: &Raster, polygons: &[Convex], stalls: Stalls) -> (Vec<Work<Bits>>, Tally<u64>) {
    let format = raster.format;
    let mut sim = Simulation::of(&SetUp { format }).unwrap().seeded(stalls.seed);
    sim.reset();
    let (i, o) = (sim.i, sim.o);
    let place = raster.place();
    for (port, value) in [(i.place.left, place.left), (i.place.top, place.top)] {
        sim.set(port, value);
    }
    for (port, value) in [(i.place.right, place.right), (i.place.bottom, place.bottom)] {
        sim.set(port, value);
    }
    let t = sim.testbench();
    t.limit(100_000);
    let send = async {
        let mut pauses = Pauses::percent(stalls.senders, stalls.seed);
        for polygon in polygons {
            t.wait(pauses.next_length().into()).await;
            t.send_bits(i.packets, polygon.packet(&format)).await;
        }
    };
    let receive = async {
        let mut pauses = Pauses::percent(stalls.receivers, !stalls.seed);
        let mut roots = Vec::new();
        for _ in polygons {
            t.wait(pauses.next_length().into()).await;
            roots.push(t.receive_bits(o.roots).await);
        }
        t.expect_silence(o.roots, 20).await;
        roots
    };
    let ((), roots, ()) = t.run((send, receive, monitor(t.holds_bits(o.roots))));
    drop(t);
    assert_eq!(sim.get_u64(o.idle), 1);
    (roots, o.tally.map(|port| sim.get_u64(*port)))
}

#[test]
fn a_triangle_takes_4_clocks_and_its_root_waits_for_the_receiver() {
    let mut sim = Simulation::of(&SetUp { format: small() }).unwrap();
    sim.reset();
    let wave = sim.record(["packets_valid", "packets_ready", "step", "roots_valid", "roots_ready", "idle"]);
    let shown = |valid: u64| SetUpIn {
        packets: Stream { valid: Bits::new(1, valid), ready: Bits::zero(1), payload: triangle().packet(&small()) },
        place: first(small()).place(),
    };
    // Two packets without a gap; the receiver pauses when the second root comes.
    for clock in 0..12 {
        sim.drive_bits(shown((clock < 10).into()));
        sim.set(sim.o.roots.ready, clock < 6 || clock == 9);
        sim.step();
    }
    wave.expect(
        r"
        clk           |~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/~\_/
        packets_valid |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~\________
        packets_ready |___________/~~~\___________________/~~~\________
        step          | 0 | 1 | 2 | 3 | 0 | 1 | 2 | 3         | 0     |
        roots_valid   |___________/~~~\___________/~~~~~~~~~~~\________
        roots_ready   |~~~~~~~~~~~~~~~~~~~~~~~\___________/~~~\________
        idle          |_______________________________________/~~~~~~~~
        ",
    );
    assert_eq!(sim.get_u64(sim.o.tally.stalled), 2);
}

#[test]
fn a_polygon_of_8_edges_takes_8_clocks() {
    let format = Format::new(Screen { width: 8, height: 8 }, Matrix::new(2, 2).unwrap(), 8).unwrap();
    let octagon = Convex { edges: vec![[1, 1, 0]; 8], ..triangle() };
    let stalls = Stalls { senders: 0, receivers: 0, seed: 1 };
    let (_, tally) = set_up(&first(format), &[octagon, triangle()], stalls);
    assert_eq!(tally, Tally { busy: 8 + 4, stalled: 0, results: 2 });
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    /// Compares all values of a root. Slopes reach 65535, pixels lie up to 2048 beyond the screen, and matrices have far more
    /// columns than rows. Polygons with 3 to 8 edges follow one another.
    #[test]
    fn roots_are_what_a_direct_evaluation_gives(
        (raster, polygons) in formats(2048).prop_flat_map(|format| {
            (rasters(format), prop::collection::vec(polygons(format), 1..6))
        }),
        stalls in stalls(),
    ) {
        let fits = |bits: u32, value: i64| (-(1 << (bits - 1))..1 << (bits - 1)).contains(&value);
        let (edge_bits, distance_bits) = (raster.format.edge_bits(), raster.format.distance_bits());
        for polygon in &polygons {
            prop_assert!(polygon.edges.iter().all(|edge| fits(edge_bits, raster.greatest(*edge, raster.root()))));
            prop_assert!(raster.reach(polygon, raster.root()).iter().all(|reach| fits(distance_bits, *reach)));
        }
        let (roots, tally) = set_up(&raster, &polygons, stalls);
        let expected: Vec<_> = polygons.iter().map(|polygon| raster.work(polygon, raster.root())).collect();
        prop_assert_eq!(roots, expected);
        let clocks: usize = polygons.iter().map(|polygon| polygon.edges.len().max(4)).sum();
        prop_assert_eq!((tally.busy, tally.results), (clocks as u64, polygons.len() as u64));
    }
}
