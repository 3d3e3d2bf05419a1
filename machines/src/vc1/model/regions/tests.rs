use std::sync::Arc;

use super::*;
use crate::vc1::{Config, CostTable};
use tilewright_scenes::{Counts, MeshVertex, Projection, Scene, ScreenVertex, Size, set_up};

const COSTS: CostTable = CostTable {
    vertex: 0,
    polygon: 1000,
    area: 0,
    clip: 0,
    set_up: 100_000,
    row: 0,
    pixel: 1,
    clear: 1,
    send: 1,
    receive: 1,
};
const PLAIN: Regions = Regions { columns: 2, rows: 2, buffers: 2, classify: 0, region: 0, further: 0 };

/// A square of two triangles on a screen of 64x64, each a polygon, between these pixels.
fn square(x: [i32; 2], y: [i32; 2]) -> [[ScreenVertex; 3]; 2] {
    let at = |x: i32, y: i32| ScreenVertex { x: 16 * x, y: 16 * y, z: 1, rgb: [9; 3] };
    let [a, b, c, d] = [at(x[0], y[0]), at(x[1], y[0]), at(x[1], y[1]), at(x[0], y[1])];
    [[a, b, c], [a, c, d]]
}

fn projection(size: Size, triangles: &[[ScreenVertex; 3]]) -> Arc<Projection> {
    let corner = MeshVertex { position: 0, normal: None };
    let packet = |(number, vertices): (u32, &[ScreenVertex; 3])| {
        let mut packet = set_up(vertices, size).expect("covers pixels");
        packet.polygon = number;
        packet
    };
    Arc::new(Projection {
        size,
        triangles: (0..).zip(triangles).map(packet).collect(),
        vertices: triangles.to_vec(),
        corners: vec![[corner; 3]; triangles.len()],
        counts: Counts { polygons: triangles.len() as u32, ..Counts::default() },
    })
}

fn drawn(machine: Regions, processors: u32, triangles: &[[ScreenVertex; 3]]) -> RegionFrame {
    let size = Size::new(64, 64).unwrap();
    let config = Config { processors, cluster: 1, costs: COSTS, refresh: 1000.0, ..Config::new(size) };
    let model = Model::new(config).unwrap();
    model.by_regions(&machine, &model.deal(&projection(size, triangles), None).unwrap())
}

/// A quarter of T_m of a screen of 64x64 with one processing element, in its clocks: (84 * 64 + 4) * 80 / 25 / 4.
const QUARTER: u64 = 4304;

/// A square in the upper left region: its two polygons take their geometry, their set-ups and their pixels.
#[test]
fn a_frame_takes_its_work_and_with_few_buffers_its_merging() {
    let square = square([0, 8], [0, 8]);
    let frame = |buffers| {
        let frame = drawn(Regions { buffers, ..PLAIN }, 1, &square);
        let [clocks] = frame.processors[..] else { panic!("one") };
        assert_eq!((clocks.geometry, clocks.rasterization), (2000, 200_064));
        (frame.interval / PE_PERIOD, clocks.sync)
    };
    // All are merged while the next frame is drawn.
    assert_eq!(frame(8), (202_064, 0));
    // Region 0 waits until that of the frame before is merged.
    assert_eq!(frame(4), (200_064 + QUARTER, QUARTER - 2000));
    // Each region waits until the one before is merged, and the geometry is done meanwhile.
    assert_eq!(frame(1), (200_064 + 4 * QUARTER, 4 * QUARTER - 2000));
    // The regions 0 and 1 are drawn at once, 2 and 3 when those are merged, and the next 0 when 2 is.
    assert_eq!(frame(2), (200_064 + 3 * QUARTER, 3 * QUARTER - 2000));
}

/// Two of them have a polygon each, in the first region and in the second one.
#[test]
fn a_region_is_merged_when_all_have_drawn_it() {
    let [a, _] = square([0, 8], [0, 8]);
    let [b, _] = square([40, 48], [0, 8]);
    let interval = |buffers| {
        let frame = drawn(Regions { buffers, ..PLAIN }, 2, &[a, b]);
        let works: Vec<u64> = frame.processors.iter().map(|it| it.rasterization).collect();
        (frame.interval / PE_PERIOD, works)
    };
    // With buffers for two frames, the slower one works all the time.
    let (ample, works) = interval(8);
    assert_eq!(ample, 1000 + works.iter().max().unwrap());
    // With one, they work one after the other, and each region is merged before the next one.
    let (one, _) = interval(1);
    let merging = (84 * 64 + 8) * 80 / 25;
    assert!(one.abs_diff(works.iter().sum::<u64>() + merging) <= 4, "{one} {works:?} {merging}");
}

/// A square across all four: each region has its pixels, and the constants are charged for each and for each but the first.
#[test]
fn what_crosses_regions_is_charged_in_each() {
    let across = |region, further| {
        let frame = drawn(Regions { region, further, classify: 7, ..PLAIN }, 1, &square([28, 36], [28, 36]));
        (frame.processors[0].geometry, frame.processors[0].rasterization)
    };
    assert_eq!(across(0, 0), (2014, 200_064));
    assert_eq!(across(10, 0), (2014, 200_064 + 2 * 4 * 10));
    assert_eq!(across(0, 10), (2014, 200_064 + 2 * 3 * 10));
}

/// On our ter1k with 16 processing elements, as means over every sixth of the 48 views: the constants of either kind that give the
/// rasterization of Table 1 (VC1-T1), and waiting in the order of its columns.
#[test]
fn the_constants_give_the_rasterization_of_table_1() {
    let mut scene = Scene::builtin("ter1k").expect("a built-in scene");
    let camera = scene.camera;
    let model = Model::new(Config::new(scene.size)).unwrap();
    let mut first: Option<Dealt> = None;
    let mut deal = |view: u32| {
        scene.camera = camera.orbited(7.5 * f64::from(view));
        let dealt = model.deal(&Arc::new(scene.project().expect("in sight")), first.as_ref()).unwrap();
        first.get_or_insert_with(|| dealt.clone());
        dealt
    };
    let views: Vec<Dealt> = (0..48).step_by(6).map(&mut deal).collect();
    let milliseconds = |edge, buffers, region, further| {
        let machine = Regions { columns: edge, rows: edge, buffers, classify: 92, region, further };
        let mut sum = Clocks::default();
        for view in &views {
            model.by_regions(&machine, view).processors.into_iter().for_each(|it| sum += it);
        }
        [sum.geometry, sum.rasterization, sum.sync].map(|it| it as f64 / views.len() as f64 / 16.0 / 40_000.0)
    };
    let near = |found: f64, expected: f64| (found / expected - 1.0).abs() < 0.02;
    for (edge, region, further, expected) in
        [(2, 785, 0, 29.1), (2, 0, 24_800, 29.1), (4, 785, 0, 29.7), (4, 0, 24_800, 47.9)]
    {
        let [geometry, found, _] = milliseconds(edge, 4, region, further);
        assert!(near(found, expected) && near(geometry, 14.1), "{edge} {region} {further}: {found} for {expected}");
    }
    let waiting = [(2, 2, 29.1), (4, 4, 41.5), (4, 2, 41.5)].map(|(edge, buffers, rasterization)| {
        let [_, found, waiting] = milliseconds(edge, buffers, 276, 16_350);
        assert!(near(found, rasterization), "{edge}: {found} for {rasterization}");
        waiting
    });
    assert!(waiting.is_sorted(), "{waiting:?}");
}

/// A polygon off the screen is prepared before the first region, for which all others wait.
#[test]
fn what_is_off_the_screen_is_prepared_before_the_first_region() {
    let size = Size::new(64, 64).unwrap();
    let [seen, _] = square([40, 48], [0, 8]);
    let mut projection = Arc::unwrap_or_clone(projection(size, &[seen]));
    (projection.triangles[0].polygon, projection.counts.polygons) = (1, 2);
    projection.corners.push(projection.corners[0]);
    let projection = Arc::new(projection);
    let interval = |area| {
        let costs = CostTable { area, ..COSTS };
        let config = Config { processors: 2, cluster: 1, costs, refresh: 1000.0, ..Config::new(size) };
        let model = Model::new(config).unwrap();
        let dealt = model.deal(&projection, None).unwrap();
        model.by_regions(&Regions { buffers: 1, ..PLAIN }, &dealt).interval / PE_PERIOD
    };
    // One element prepares its polygon before the first region, and the other one in the second region.
    assert_eq!(interval(50_000) - interval(0), 2 * 50_000);
}
