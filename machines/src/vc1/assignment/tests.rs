//! How polygons are dealt, and what is known of them.

use super::*;
use tilewright_scenes::{Scene, Size, project};

fn small() -> Size {
    Size::new(160, 120).expect("in range")
}

/// The scene, turned by so many degrees.
fn turned(scene: &str, degrees: f64) -> Projection {
    let mut scene = Scene::builtin(scene).expect("a built-in scene");
    scene.camera = scene.camera.orbited(degrees);
    project(&scene, small()).expect("in sight")
}

fn teapot() -> Projection {
    turned("teapot", 0.0)
}

/// The numbers of each processing element's polygons.
fn numbers(assignment: &Assignment) -> Vec<Vec<u32>> {
    assignment.polygons.iter().map(|polygons| polygons.iter().map(|polygon| polygon.number).collect()).collect()
}

/// Costs of nothing but polygons.
const ONE_EACH: CostTable =
    CostTable { vertex: 0, polygon: 1, area: 0, clip: 0, set_up: 0, row: 0, pixel: 0, clear: 1, send: 1, receive: 1 };

#[test]
fn every_polygon_is_dealt_once_in_whole_clusters() {
    let of = [Assignment::new, Assignment::by_count];
    for assignment in of.map(|of| of(&teapot(), 5, 32, &CostTable::default())) {
        let mut clusters: Vec<Vec<u32>> = Vec::new();
        for numbers in numbers(&assignment) {
            clusters.extend(numbers.chunks(32).map(<[u32]>::to_vec));
        }
        clusters.sort();
        assert_eq!(clusters.concat(), (0..4096).collect::<Vec<_>>());
    }
}

#[test]
fn no_processor_is_ahead_by_more_than_a_cluster() {
    let projection = teapot();
    let costs = CostTable::default();
    let assignment = Assignment::new(&projection, 7, 16, &costs);
    let clusters = clusters(&projection, 16);
    let heaviest = clusters.iter().map(|cluster| cluster.iter().map(|it| load(&projection, it, &costs)).sum::<u64>());
    let (least, most) = (assignment.loads.iter().min(), assignment.loads.iter().max());
    assert!(most.unwrap() - least.unwrap() <= heaviest.max().unwrap(), "{:?}", assignment.loads);
}

#[test]
fn of_equally_loaded_processors_the_lowest_is_taken() {
    let assignment = Assignment::new(&teapot(), 3, 1000, &ONE_EACH);
    let firsts: Vec<u32> = assignment.polygons.iter().map(|polygons| polygons[0].number).collect();
    assert_eq!(firsts, [0, 1000, 2000]);
    assert_eq!(assignment.loads, [2000, 1096, 1000]);
}

#[test]
fn by_count_costs_are_of_no_account() {
    let (projection, costs) = (teapot(), CostTable::default());
    let by_count = Assignment::by_count(&projection, 7, 16, &costs);
    assert_eq!(numbers(&by_count), numbers(&Assignment::new(&projection, 7, 16, &ONE_EACH)));
    assert_ne!(numbers(&by_count), numbers(&Assignment::new(&projection, 7, 16, &costs)));
    // The loads are clocks all the same.
    let polygon = |polygon| load(&projection, polygon, &costs);
    let loads: Vec<u64> = by_count.polygons.iter().map(|polygons| polygons.iter().map(polygon).sum()).collect();
    assert_eq!(by_count.loads, loads);
}

/// In a later view polygons stay, but what is drawn of them is of that view; dealt anew they move.
#[test]
fn polygons_stay_where_the_first_view_brought_them() {
    let views = [turned("ter1k", 0.0), turned("ter1k", 40.0)];
    let config = |assign| Config { assign, ..Config::new(small()) };
    let frames = |assign| {
        let first = config(assign).assignment(&views[0], None).expect("the first");
        let second = config(assign).assignment(&views[1], Some(&first)).expect("of the same scene");
        [first, second]
    };
    let alone = |assign, view: usize| config(assign).assignment(&views[view], None).expect("alone");
    let [once, each, count] = [Assign::Once, Assign::Each, Assign::Count].map(frames);
    assert_eq!(once[0], each[0], "one frame is the same");
    assert_eq!(numbers(&once[0]), numbers(&once[1]));
    assert_eq!(each[1], alone(Assign::Each, 1));
    assert_ne!(numbers(&each[0]), numbers(&each[1]));
    assert_eq!(count[1], alone(Assign::Count, 1), "of views a count knows nothing");
    // All that the second view has is drawn, by the packets of that view.
    for assignment in [&once[1], &each[1], &count[1]] {
        let mut drawn: Vec<usize> = assignment.polygons.iter().flatten().flat_map(|it| it.packets.clone()).collect();
        drawn.sort_unstable();
        assert_eq!(drawn, (0..views[1].triangles.len()).collect::<Vec<_>>());
        let mut polygons: Vec<Polygon> = assignment.polygons.concat();
        polygons.sort_by_key(|polygon| polygon.number);
        assert_eq!(polygons, clusters(&views[1], 32).concat());
    }
    let error = once[0].in_view(&teapot(), &CostTable::default()).expect_err("another scene").to_string();
    assert_eq!(error, "an assignment of 12482 polygons for a scene of 4096: assign the scene anew");
}

/// A row of ter1k has 79 squares of two triangles.
#[test]
fn a_vertex_counts_once_in_a_cluster() {
    let projection = turned("ter1k", 0.0);
    let vertices = |size| {
        let of = |cluster: Vec<Polygon>| cluster.iter().map(|polygon| polygon.vertices).collect::<Vec<_>>();
        clusters(&projection, size).into_iter().map(of).collect::<Vec<_>>()
    };
    assert!(vertices(1).iter().all(|cluster| cluster[..] == [3]), "alone each has three");
    assert_eq!(vertices(4)[0], [3, 1, 2, 0], "two squares have six");
    let all: u32 = vertices(12482)[0].iter().sum();
    assert_eq!(all, 80 * 80);
}

/// A terrain seen from nearer by crosses the border on all sides; one in sight as a whole on none.
#[test]
fn packets_that_cross_the_border_are_clipped() {
    let clipped = |projection: &Projection| clusters(projection, 32).concat().iter().map(|it| it.clipped).sum::<u32>();
    assert_eq!(clipped(&teapot()), 0);
    let crossing = turned("ter1k", 0.0);
    let within = |v: &ScreenVertex| (0..=160 * 16).contains(&v.x) && (0..=120 * 16).contains(&v.y);
    let crosses = |vertices: &&[ScreenVertex; 3]| !vertices.iter().all(within);
    let expected = crossing.vertices.iter().filter(crosses).count();
    assert!(expected > 50, "{expected}");
    assert_eq!(clipped(&crossing), expected as u32);
}
