//! Frames of small machines.

use tilewright_scenes::deferred::{Samples, project_deferred};
use tilewright_scenes::{Scene, Size, compare, golden, project_polygons};

use super::*;

fn config(size: Size, nodes: u32, shaders: u32) -> Config {
    Config { nodes, shaders, array: [16, 8], ..Config::new(size) }
}

#[test]
fn a_resident_frame_is_the_golden_image() {
    let size = Size::new(44, 30).unwrap();
    let scene = Scene::builtin("star").unwrap();
    let polygons = project_polygons(&scene, size).unwrap();
    let golden = golden::render(size, &polygons.polygons, scene.background);
    for nodes in [2, 3, 5] {
        let machine = Machine::new(config(size, nodes, 0)).unwrap();
        let (frame, report) = machine.render_resident(&polygons, scene.background, &mut Watch::default()).unwrap();
        assert_eq!(compare(&frame, &golden).differing, 0, "{nodes} nodes");
        assert_eq!(report.turns.len(), 12);
    }
}

#[test]
fn a_deferred_frame_is_the_golden_image() {
    let size = Size::new(44, 30).unwrap();
    let scene = Scene::builtin("star").unwrap();
    let deferred = project_deferred(&scene, size, Samples::One).unwrap();
    let golden = golden::render_deferred(&deferred);
    for (nodes, shaders) in [(3, 1), (4, 2), (7, 3)] {
        let machine = Machine::new(config(size, nodes, shaders)).unwrap();
        let (frame, report) = machine.render(&deferred, &mut Watch::default()).unwrap();
        assert_eq!(compare(&frame, &golden).differing, 0, "{nodes} nodes");
        assert_eq!(report.turns.len(), 12);
    }
}
