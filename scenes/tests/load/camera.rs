//! The automatic camera, and pictures in which nothing is drawn.

use crate::load::{TRIANGLE, folder, load};
use glam::{DVec3, dvec3};
use std::fs;
use tilewright_scenes::{BoundingBox, Camera, Counts, Projection, Scene, ScreenVertex, Size, golden, set_up};

/// A box away from the origin: 12 triangles.
const BOX: &str = "v 3 0 0\nv 9 0 0\nv 9 5 0\nv 3 5 0\nv 3 0 7\nv 9 0 7\nv 9 5 7\nv 3 5 7\n\
                   f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

#[test]
fn a_framed_mesh_is_wholly_on_the_screen() {
    let over_the_shoulder = dvec3(0.45, 0.35, 1.0).normalize();
    for (name, up, direction) in [
        ("y up", "[0, 1, 0]", over_the_shoulder),
        ("z up", "[0, 0, 1]", dvec3(0.45, -1.0, 0.35).normalize()),
        ("x up", "[1, 0, 0]", over_the_shoulder),
    ] {
        for size in ["[640, 480]", "[100, 400]"] {
            let text = format!("mesh = 'mesh.obj'\nsize = {size}\ncamera.up = {up}\n");
            let folder = folder("framed", &[("mesh.obj", BOX), ("scene.toml", &text)]);
            let scene = load(&folder.join("scene.toml")).unwrap();
            let arm = scene.camera.eye - scene.camera.target;
            assert!((arm.normalize() - direction).length() < 1e-12, "{name}: seen along {arm}");
            let p = scene.project().unwrap();
            assert_eq!((p.counts.polygons, p.counts.drawn), (12, 12), "{name}");
            let (width, height) = (scene.size.width() as i32 * 16, scene.size.height() as i32 * 16);
            let inside = |x: i32, side: i32| x >= 0 && x <= side;
            assert!(p.vertices.iter().flatten().all(|v| inside(v.x, width) && inside(v.y, height)), "{name}");
            let ties = golden::ties(p.size, &p.triangles);
            assert!(ties.covered * 12 > p.size.pixels() as u64, "{name}: the mesh is tiny");
        }
    }
}

/// Half the field of view is 45 degrees from top to bottom. The sphere round the box has radius 3 and touches the nearer edges.
#[test]
fn the_sphere_round_a_framed_box_touches_the_edges_of_the_picture() {
    let bounds = BoundingBox { min: dvec3(4.0, 0.0, -2.0), max: dvec3(6.0, 4.0, 2.0) };
    // The sine of 45 degrees, and that of an angle whose tangent is 3/4.
    for (width, height, sine) in [(400, 300, 0.5_f64.sqrt()), (300, 400, 0.6)] {
        let size = Size::new(width, height).unwrap();
        let camera = Camera::framing(bounds, dvec3(0.0, 0.0, 7.0), DVec3::Y, 90.0, size);
        let distance = (camera.eye - dvec3(5.0, 2.0, 0.0)).length();
        assert!((distance - 3.0 / sine).abs() < 1e-9, "{size}: {distance}");
    }
}

#[test]
fn a_mesh_is_framed_for_the_size_that_is_asked_for() {
    let tall = Size::new(100, 400).unwrap();
    let folder = folder(
        "tall",
        &[
            ("mesh.obj", BOX),
            ("scene.toml", "mesh = 'mesh.obj'\nsize = [320, 200]\n"),
            ("teapot.toml", "mesh = 'teapot'"),
        ],
    );
    for name in ["mesh.obj", "scene.toml"] {
        let path = folder.join(name);
        let scene = Scene::load_sized(path.to_str().unwrap(), Some(tall)).unwrap();
        assert_eq!(scene.size, tall);
        let p = scene.project().unwrap();
        assert_eq!(p.counts.drawn, 12);
        let inside = |x: i32, side: u32| (0..=16 * side as i32).contains(&x);
        assert!(p.vertices.iter().flatten().all(|v| inside(v.x, 100) && inside(v.y, 400)), "{name} is cropped");
    }
    assert_eq!(Scene::load_sized("teapot", Some(tall)).unwrap().size, tall);
    let path = folder.join("scene.toml");
    assert_eq!(Scene::load_sized(path.to_str().unwrap(), None).unwrap().size, Size::new(320, 200).unwrap());
}

#[test]
fn a_tiny_mesh_is_framed_like_any_other() {
    let folder = folder("tiny", &[]);
    let path = folder.join("mesh.obj");
    let covered = |scale: &str| {
        let text = format!("v 0 0 0\nv 1e{scale} 0 0\nv 0 1e{scale} 0\nf 1 2 3\n");
        fs::write(&path, text).unwrap();
        let p = load(&path).unwrap().project().unwrap();
        golden::ties(p.size, &p.triangles).covered
    };
    let usual = covered("0");
    assert!(usual > 10_000);
    for scale in ["-12", "-100", "20"] {
        assert!(covered(scale).abs_diff(usual) < 200, "1e{scale}: {} and {usual}", covered(scale));
    }
}

/// The scene of that text, and its message about a picture in which nothing is drawn.
fn blank(test: &str, text: &str) -> Option<String> {
    let folder = folder(test, &[("mesh.obj", TRIANGLE), ("scene.toml", text)]);
    load(&folder.join("scene.toml")).unwrap().project().unwrap().warning()
}

#[test]
fn a_picture_without_anything_in_it_is_a_warning() {
    let remedy = "correct the eye, the target or the fov of the camera";
    let off = "mesh = 'mesh.obj'\ncamera = { eye = [0, 0, 5], target = [90, 0, 0] }\n";
    assert_eq!(
        blank("off_screen", off),
        Some(format!("nothing is drawn: of 1 polygon, 1 is outside the picture: {remedy}"))
    );
    let far = "mesh = 'mesh.obj'\ncamera = { eye = [0, 0, 1e9], target = [0, 0, 0] }\n";
    assert_eq!(
        blank("far", far),
        Some(format!("nothing is drawn: of 1 polygon, 1 is too small for a pixel: {remedy}"))
    );
    let narrow = "mesh = 'teapot'\ncamera = { target = [0, 0, 9], fov = 1e-6 }\n";
    assert_eq!(
        blank("narrow", narrow),
        Some(format!("nothing is drawn: of 4096 polygons, 4096 are outside the picture: {remedy}"))
    );
    assert_eq!(blank("sound", "mesh = 'mesh.obj'\n"), None);
    assert_eq!(blank("teapot", "mesh = 'teapot'\n"), None);
}

/// Half a pixel wide and between the centres of pixels, but with a box that reaches over many of them: a packet that covers nothing.
#[test]
fn a_sliver_that_misses_every_centre_is_a_warning_too() {
    let size = Size::new(64, 64).unwrap();
    let at = |x: i32, y: i32| ScreenVertex { x, y, z: 9, rgb: [0; 3] };
    let vertices = [at(4, 0), at(5, 0), at(996, 990)];
    let packet = set_up(&vertices, size).unwrap();
    let counts = Counts { polygons: 1, drawn: 1, ..Counts::default() };
    let projection =
        Projection { size, triangles: vec![packet], vertices: vec![vertices], corners: Vec::new(), counts };
    assert_eq!(golden::ties(size, &projection.triangles).covered, 0, "the sliver is not one");
    assert!(projection.warning().unwrap().contains("1 is too small for a pixel"));
}

#[test]
fn a_warning_counts_every_fate() {
    let counts = Counts {
        polygons: 31,
        spheres: 0,
        lines: 0,
        behind: 1,
        off_screen: 2,
        degenerate: 4,
        between_centres: 8,
        drawn: 16,
        split: 0,
    };
    let size = Size::new(64, 64).unwrap();
    let projection = Projection { size, triangles: Vec::new(), vertices: Vec::new(), corners: Vec::new(), counts };
    assert_eq!(
        projection.warning().unwrap(),
        "nothing is drawn: of 31 polygons, 1 is behind the camera, 2 are outside the picture, 28 are too small for a pixel: \
         correct the eye, the target or the fov of the camera"
    );
}
