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

/// T_m of a screen of 64x64, in picoseconds.
fn merge_time(processors: u64) -> u64 {
    (84 * 64 + 4 * processors) * 80_000
}

/// A square in the upper left region: its two polygons take their geometry, their set-ups and their pixels.
#[test]
fn one_region_is_drawn_and_all_are_merged_one_after_another() {
    let frame = drawn(PLAIN, 1, &square([0, 8], [0, 8]));
    let [clocks] = frame.processors[..] else { panic!("one") };
    assert_eq!(
        (clocks.geometry, clocks.rasterization, clocks.sync),
        (2000, 200_064, frame.drawn / PE_PERIOD - 202_064)
    );
    // The last two regions wait for the buffers of the first two, of which the second one is merged half of T_m later.
    let first = 202_064 * PE_PERIOD;
    assert_eq!(frame.merged, first + merge_time(1) / 4 * 4);
    assert_eq!(frame.drawn, (first + merge_time(1) / 4 * 2).next_multiple_of(PE_PERIOD));
    let ample = drawn(Regions { buffers: 4, ..PLAIN }, 1, &square([0, 8], [0, 8]));
    assert_eq!((ample.drawn, ample.merged), (first, frame.merged));
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

/// Two of them draw a triangle each, in the first region and in the second: with one buffer the second waits until the first is merged.
#[test]
fn a_region_waits_for_its_buffer_and_is_merged_when_all_have_drawn_it() {
    let [a, _] = square([0, 8], [0, 8]);
    let [b, _] = square([40, 48], [0, 8]);
    let one = drawn(Regions { buffers: 1, ..PLAIN }, 2, &[a, b]);
    let pixels = one.processors.iter().map(|it| it.rasterization - 100_000).collect::<Vec<_>>();
    let up = |time: u64| time.next_multiple_of(PE_PERIOD);
    let part = merge_time(2) / 4;
    // Region 0 is drawn and merged, then region 1, then the two empty ones.
    let first = (1000 + 100_000 + pixels[0]) * PE_PERIOD + part;
    let second = up(first) + (100_000 + pixels[1]) * PE_PERIOD + part;
    let third = up(second) + part;
    assert_eq!((one.drawn, one.merged), (up(third), up(third) + part));
}

/// The constants that Table 1 asks for, of either kind alone, on our ter1k: 785 and 24,800 clocks for 29.1 ms with 2x2 regions (VC1-T1).
#[test]
fn the_constants_of_either_kind_give_the_rasterization_of_table_1() {
    let mut scene = Scene::builtin("ter1k").expect("a built-in scene");
    let camera = scene.camera;
    let model = Model::new(Config::new(scene.size)).unwrap();
    // Every sixth view.
    let views: Vec<Dealt> = (0..48)
        .step_by(6)
        .map(|view| {
            scene.camera = camera.orbited(7.5 * f64::from(view));
            model.deal(&Arc::new(scene.project().unwrap()), None).unwrap()
        })
        .collect();
    let milliseconds = |edge, region, further| {
        let machine = Regions { columns: edge, rows: edge, region, further, ..PLAIN };
        let of =
            |view: &Dealt| model.by_regions(&machine, view).processors.iter().map(|it| it.rasterization).sum::<u64>();
        views.iter().map(of).sum::<u64>() as f64 / views.len() as f64 / 16.0 / 40_000.0
    };
    for (edge, region, further, expected) in [
        (2, 785, 0, 29.1),
        (2, 0, 24_800, 29.1),
        (4, 785, 0, 29.7),
        (4, 0, 24_800, 47.9),
        (2, 276, 16_350, 29.1),
        (4, 276, 16_350, 41.5),
    ] {
        let found = milliseconds(edge, region, further);
        assert!((found / expected - 1.0).abs() < 0.02, "{edge} {region} {further}: {found} for {expected}");
    }
}
