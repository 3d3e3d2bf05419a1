//! The pixel processor clock by clock, and against the polygon's own edge functions, with every aperture.

use proptest::prelude::*;
use tilewright_sim::Simulation;

use super::super::model::{Convex, Raster, Square};
use super::super::testing::{first, formats, polygons, rasters, small, triangle};
use super::*;

fn shown(valid: u64, leaf: Work<Bits>) -> PixelProcessorIn<Bits> {
    PixelProcessorIn { leaves: Stream { valid: Bits::new(1, valid), ready: Bits::zero(1), payload: leaf } }
}

#[test]
fn a_fragment_comes_a_clock_after_its_window() {
    let raster = first(small());
    let mut sim = Simulation::of(&PixelProcessor { format: small() }).unwrap();
    sim.reset();
    let o = sim.o.fragment;
    let wave = sim.record([sim.i.leaves.valid, o.valid, o.x, o.y, o.word, sim.o.fragments]);
    for (valid, x, y) in [(1, 0, 1), (1, 3, 0), (0, 0, 2), (1, 2, 1), (0, 0, 0), (0, 0, 0)] {
        sim.drive_bits(shown(valid, raster.work(&triangle(), Square { size: 0, x, y })));
        sim.step();
    }
    wave.expect(
        r"
        clk            |~~~~~\____/~~~~~\____/~~~~~\____/~~~~~\____/~~~~~\____/~~~~~\____/
        leaves_valid   |~~~~~~~~~~~~~~~~~~~~~\__________/~~~~~~~~~~\______________________
        fragment_valid |__________/~~~~~~~~~~~~~~~~~~~~~\__________/~~~~~~~~~~\___________
        fragment_x     | 0                   | 3                   | 2                   |
        fragment_y     | 0        | 1        | 0                   | 1                   |
        fragment_word  | 0        | a4800002 | c4800600            | e4800402            |
        fragments      | 0                   | 1        | 2                   | 3        |
        ",
    );
}

/// Whether the polygon covers the pixel of a sample: by definition.
fn covers(raster: &Raster, polygon: &Convex, x: u32, y: u32) -> bool {
    let matrix = raster.format.matrix();
    let [x, y] = [raster.column + matrix.columns() * x, raster.row + matrix.rows() * y].map(i64::from);
    let [left, top, right, bottom] = polygon.bounds.map(i64::from);
    polygon.edges.iter().all(|[a, b, c]| a * x + b * y + c >= 0)
        && (left..=right).contains(&x)
        && (top..=bottom).contains(&y)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    /// The pixel processor draws the windows of one sample that pass the coverage tests and whose pixel is covered. No
    /// pixel is lost on the way.
    #[test]
    fn what_is_drawn_is_what_the_polygon_covers(
        (raster, polygons) in formats(24).prop_flat_map(|format| {
            (rasters(format), prop::collection::vec(polygons(format), 1..4))
        }),
        seed in any::<u64>(),
    ) {
        let mut sim = Simulation::of(&PixelProcessor { format: raster.format }).unwrap().seeded(seed);
        // A leaf offered without `valid` is ignored.
        sim.drive_bits(shown(1, raster.work(&polygons[0], Square { size: 0, x: 0, y: 0 })));
        sim.reset();
        prop_assert_eq!(sim.get_u64(sim.o.fragment.valid), 0);
        let mut count = 0;
        for polygon in &polygons {
            let leaves = raster.divided(polygon, raster.root(), 0);
            let samples = (0..raster.format.rows()).flat_map(|y| (0..raster.format.columns()).map(move |x| (x, y)));
            let mut drawn = Vec::new();
            for leaf in leaves {
                let work = raster.work(polygon, leaf);
                sim.drive_bits(shown(1, work.clone()));
                sim.step();
                let fragment = sim.o.fragment;
                if sim.get_u64(fragment.valid) == 1 {
                    drawn.push((leaf.x, leaf.y));
                    let plane = |lane: u32| work.window.planes.slice(40 * lane..40 * lane + 40);
                    let depth = plane(0).slice(16..40);
                    let colours = (1..4).map(|lane| plane(lane).slice(16..24));
                    prop_assert_eq!(sim.get(fragment.word), colours.fold(depth, |word, colour| word.concat(&colour)));
                    let at = (sim.get_u64(fragment.x), sim.get_u64(fragment.y));
                    prop_assert_eq!(at, (leaf.x.into(), leaf.y.into()));
                }
            }
            drawn.sort_by_key(|&(x, y)| (y, x));
            let covered: Vec<_> = samples.filter(|&(x, y)| covers(&raster, polygon, x, y)).collect();
            prop_assert_eq!(&drawn, &covered);
            count += drawn.len();
        }
        sim.drive_bits(shown(0, raster.work(&polygons[0], Square { size: 0, x: 0, y: 0 })));
        sim.step();
        prop_assert_eq!(sim.get_u64(sim.o.fragments), count as u64);
    }
}
