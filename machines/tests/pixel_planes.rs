//! Scenes in regions: whatever is drawn of each region's bin alone is the golden frame, and the bins balance.

use tilewright_machines::pixel_planes::{
    Binner, Regions, Vectors, allocate, greatest_load_of_whole_regions, least_load,
};
use tilewright_scenes::{Frame, Polygon, Polygons, Scene, Size, golden, project_polygons};

fn project(name: &str, width: u32, height: u32) -> Polygons {
    let scene = Scene::builtin(name).expect("a built-in scene");
    project_polygons(&scene, Size::new(width, height).expect("in range")).expect("the scene is in sight")
}

/// Each region with what is in its bin, and nothing else.
fn draw_by_regions(scene: &Polygons, regions: &Regions, binner: Binner) -> Frame {
    let mut frame = Frame::blank(scene.size, [9; 3]);
    for (region, bin) in regions.bins(&scene.vertices, binner).iter().enumerate() {
        let packets: Vec<Polygon> = bin.iter().map(|&number| scene.polygons[number as usize].clone()).collect();
        let drawn = golden::render(scene.size, &packets, [9; 3]);
        let pixels = regions.pixels(region);
        for (y, x) in (pixels.top..=pixels.bottom).flat_map(|y| (pixels.left..=pixels.right).map(move |x| (y, x))) {
            let pixel = (y * scene.size.width() + x) as usize;
            frame.words[pixel] = drawn.words[pixel];
        }
    }
    frame
}

#[test]
fn regions_with_their_bins_alone_are_the_golden_frame() {
    for (name, side) in [("teapot", 32), ("wireframe", 16), ("star", 8), ("star", 64)] {
        let scene = project(name, 150, 100);
        let expected = golden::render(scene.size, &scene.polygons, [9; 3]);
        let regions = Regions::new(scene.size, side).expect("in range");
        for binner in Binner::ALL {
            let frame = draw_by_regions(&scene, &regions, binner);
            assert!(frame == expected, "{name} in regions of {side} by {binner:?}");
        }
    }
}

/// Where whole columns have fewer in all, the worst renderer may still have more: vectors that begin near the middle are continued into it.
#[test]
fn a_better_binner_leaves_less_to_do() {
    let scene = project("star", 1280, 1024);
    let regions = Regions::new(scene.size, 128).expect("in range");
    let [by_box, by_columns, tight] = Binner::ALL.map(|binner| {
        let bins: Vec<u64> = regions.bins(&scene.vertices, binner).iter().map(|bin| bin.len() as u64).collect();
        let allocation = allocate(&bins, 16, |size| 94 * size);
        let (primitives, worst) = (scene.vertices.len() as u64, allocation.worst_load());
        assert!(worst as f64 >= least_load(primitives as f64, 16));
        assert!(worst <= greatest_load_of_whole_regions(primitives, regions.count(), 16));
        assert_eq!(allocation.time(), 94 * worst);
        (bins.iter().sum::<u64>(), worst)
    });
    // Many vectors are longer than a region.
    assert!(tight.0 < by_columns.0 && by_columns.0 < by_box.0, "{tight:?}, {by_columns:?}, {by_box:?}");
    assert!(tight.1 <= by_columns.1.min(by_box.1), "{tight:?}, {by_columns:?}, {by_box:?}");
}

#[test]
fn the_least_screen_of_vectors() {
    let points = |width| {
        let regions = Regions::new(Size::new(width, 384).expect("in range"), 128).expect("in range");
        Vectors::new(regions, 0.0, Some(0.0), 1).is_ok()
    };
    // A region around them, and one to move in.
    assert_eq!([383, 384].map(points), [false, true]);
}
