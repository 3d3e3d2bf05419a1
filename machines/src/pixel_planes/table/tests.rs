//! N on the hardware, the worst that there is, and the table of the documentation.

use proptest::prelude::*;
use tilewright_rtl::pixel_planes::PERIOD;
use tilewright_rtl::pixel_planes::controller::ImageGenerationController;
use tilewright_scenes::{Scene, ScreenVertex, project_polygons, set_up, set_up_polygon};
use tilewright_sim::Simulation;

use super::worst::{LARGE, POLYGON};
use super::*;

/// The clocks from the first instruction of a primitive to that of the next, of the last of some equal ones, in the hardware.
fn simulated_clocks(instructions: &[Instruction<u64>], side_by_side: bool) -> u64 {
    const MANY: usize = 8;
    let mut sim =
        Simulation::at(&ImageGenerationController { side: 128, quadratic: false }, PERIOD).expect("it can be built");
    sim.set(sim.i.store_free, 1);
    sim.set(sim.i.side_by_side, u64::from(side_by_side));
    sim.reset();
    let (i, program) = (sim.i, [instructions; MANY].concat());
    let t = sim.testbench();
    let begun = t
        .run((async {
            let mut begun = Vec::new();
            for (number, instruction) in program.iter().enumerate() {
                t.send(i.instructions, *instruction).await;
                if number % instructions.len() == 0 {
                    begun.push(t.time() / PERIOD.picoseconds());
                }
            }
            begun
        },))
        .0;
    let [.., third, second, last] = begun[..] else { unreachable!("there are many") };
    assert_eq!(last - second, second - third, "it is the same again and again");
    last - second
}

/// Facts E3, of a model that ran: a vector strict 141 at most and side by side 93, a triangle side by side 157.
#[test]
fn worst_primitives_take_the_clocks_of_their_edges_and_planes() {
    // One at a time: the edges' bits and all words; side by side what the tree or the memory takes, and a clock for each instruction of the
    // memory that it waits for.
    let expected: [(&Program, Kind, [[u64; 2]; 3]); 10] = [
        (&FLAT, Kind::Vectors, [[124, 101], [88, 65], [70, 47]]),
        (&FLAT_STRICT, Kind::Vectors, [[188, 142], [152, 106], [134, 88]]),
        (&FLAT_LEAST, Kind::Vectors, [[212, 142], [176, 106], [158, 96]]),
        (&SMOOTH_STRICT, Kind::Triangles, [[211, 188], [210, 187], [181, 158]]),
        (&SMOOTH_LEAST, Kind::Triangles, [[235, 188], [234, 187], [205, 158]]),
        (&FLAT, Kind::Polygons, [[224, 201], [214, 191], [144, 121]]),
        (&FLAT_STRICT, Kind::Polygons, [[288, 242], [278, 232], [208, 162]]),
        (&FLAT_LEAST, Kind::Polygons, [[312, 242], [302, 232], [232, 162]]),
        (&SMOOTH_STRICT, Kind::Polygons, [[336, 313], [326, 303], [256, 233]]),
        (&SMOOTH_LEAST, Kind::Polygons, [[360, 313], [350, 303], [280, 233]]),
    ];
    for (program, kind, clocks) in expected {
        for (edges, clocks) in Edges::ALL.into_iter().zip(clocks) {
            let instructions = worst(program, kind, edges).expect("there is one");
            for (side_by_side, clocks) in [false, true].into_iter().zip(clocks) {
                let name = format!("{}, {}, {side_by_side}", program.name, edges.name());
                assert_eq!(simulated_clocks(&instructions, side_by_side), clocks, "{name}");
                assert_eq!(steady_clocks(program, &instructions, side_by_side), clocks, "{name}");
            }
        }
    }
}

/// The clocks of the edges of a primitive in the region about a place.
fn edge_clocks(polygon: &Polygon, (x, y): (u32, u32), edges: Edges) -> u64 {
    let config = Config { edges, ..Config::new(Size::new(2048, 2048).expect("the largest")) };
    let regions = config.regions().expect("it has some");
    let bin = Bin::new(regions.of_pixel(x, y), &regions, &config);
    // All but the colour, if there is anything.
    bin.draw(&FLAT, polygon).iter().rev().skip(1).map(|it| it.skip + it.length).sum()
}

/// Pixels of the regions that the worst polygons are of.
const PLACES: [(u32, u32); 2] = [(768, 768), (1408, 1408)];

/// Corners round an ellipse that meets one of those regions, long and thin, as only such polygons have all of their edges in it; or those of the worst
/// polygons, each moved a little.
fn eight_corners() -> impl Strategy<Value = [(i32, i32); 8]> {
    let guard = |at: f64| (at.round() as i32).clamp(-32_768, 32_767);
    let ellipse = (
        prop::sample::select(PLACES.to_vec()),
        prop::array::uniform2(-100..2100i32),
        (0.0..std::f64::consts::PI, 10.0..3000.0, 2000.0..46_000.0),
        prop::array::uniform8(0.0..std::f64::consts::TAU),
    );
    let on_ellipse = ellipse.prop_map(move |((x, y), [right, below], (angle, short, long), mut around)| {
        around.sort_by(f64::total_cmp);
        let (x, y) = (f64::from(16 * x as i32 + right), f64::from(16 * y as i32 + below));
        around.map(|at| {
            let (along, across) = (long * at.cos(), short * at.sin());
            (
                guard(x + along * angle.cos() - across * angle.sin()),
                guard(y + along * angle.sin() + across * angle.cos()),
            )
        })
    });
    let moved = (prop::sample::select(vec![LARGE, POLYGON]), prop::array::uniform8((-60..60i32, -60..60i32)));
    let near_worst = moved.prop_map(|(corners, by)| {
        std::array::from_fn(|i| (corners[i].0 + by[i].0, corners[i].1 + by[i].1))
            .map(|(x, y): (i32, i32)| (x.clamp(-32_768, 32_767), y.clamp(-32_768, 32_767)))
    });
    prop_oneof![on_ellipse, near_worst]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn no_edges_take_more_clocks_than_those_of_the_worst(
        vertices in prop::array::uniform3(prop_oneof![
            2 => (-300..2400i32, -300..2400i32).prop_map(|(x, y)| (16 * 768 + x, 16 * 768 + y)),
            1 => (-32_768..32_768i32, -32_768..32_768i32),
            1 => (prop::sample::select(vec![-32_768, 32_767]), -32_768..32_768i32),
        ]),
    ) {
        let size = Size::new(2048, 2048).expect("the largest");
        let vertices = vertices.map(|(x, y)| ScreenVertex { x, y, z: 1 << 20, rgb: [1, 2, 3] });
        let primitives = [
            (Kind::Vectors, set_up_line([vertices[0], vertices[1]], size)),
            (Kind::Triangles, set_up(&vertices, size).map(Polygon::from)),
        ];
        for (kind, polygon) in primitives {
            let Some(polygon) = polygon else { continue };
            for edges in Edges::ALL {
                let worst = worst(&FLAT, kind, edges).expect("there is one");
                let worst: u64 = worst.iter().rev().skip(1).map(|it| it.skip + it.length).sum();
                // One more, where there are no two edges to set the flag with.
                prop_assert!(edge_clocks(&polygon, (768, 768), edges) <= worst, "{:?}, {:?}", kind, edges);
            }
        }
    }

    #[test]
    fn no_polygon_of_eight_edges_takes_more_clocks_than_the_worst(corners in eight_corners()) {
        let size = Size::new(2048, 2048).expect("the largest");
        let polygons = set_up_polygon(&corners.map(|(x, y)| ScreenVertex { x, y, z: 1 << 20, rgb: [1, 2, 3] }), size);
        for (polygon, place) in polygons.iter().flat_map(|polygon| PLACES.map(|place| (polygon, place))) {
            for edges in Edges::ALL {
                let worst = worst(&FLAT, Kind::Polygons, edges).expect("there is one");
                let worst: u64 = worst.iter().rev().skip(1).map(|it| it.skip + it.length).sum();
                prop_assert!(edge_clocks(polygon, place, edges) <= worst, "{:?}, {:?}", place, edges);
            }
        }
    }
}

/// `cargo test --release -p tilewright-machines the_table_of -- --nocapture` prints the table of the documentation.
#[test]
fn the_table_of_the_documentation_is_what_is_counted() {
    let teapot = project_polygons(&Scene::builtin("teapot").expect("built in"), Size::VGA).expect("in sight");
    let table = Table::new(&teapot, 10_000, 1).expect("it fits");
    println!("{table}");
    let documentation = include_str!("../../../../rtl/src/pixel_planes/programs/mod.rs");
    let page = include_str!("../../../../docs/machines/pixel-planes-5.md");
    for line in table.markdown() {
        assert!(documentation.contains(&format!("//! {line}\n")), "the documentation lacks {line}");
        let is_short = line.contains("| least |") && !line.contains("polygons");
        assert!(!is_short || page.contains(&format!("\n{line}\n")), "the machine's page lacks {line}");
    }
}
