//! The front end: clipping, counting, lighting, and one picture however a scene is cut.

use glam::{DVec3, dvec3};
use proptest::prelude::*;
use tilewright_scenes::packet::{FARTHEST_VERTEX, NEAREST_VERTEX};
use tilewright_scenes::{
    Camera, Light, Lighting, Mesh, MeshTriangle, Polygon, Projection, Scene, Size, frame, golden, project,
    project_polygons, project_sample,
};

fn mesh(positions: Vec<DVec3>, triangles: &[[u32; 3]]) -> Mesh {
    let triangles =
        triangles.iter().map(|&positions| MeshTriangle { positions, normals: [0; 3], diffuse: [0.5, 1.0, 0.25] });
    Mesh::new(positions, vec![DVec3::Z], triangles.collect()).unwrap()
}

/// Looking down the negative z axis from `distance`, y up, ambient light alone.
fn scene(mesh: Mesh, distance: f64) -> Scene {
    Scene {
        name: "test".into(),
        mesh,
        spheres: Vec::new(),
        camera: Camera { eye: dvec3(0.0, 0.0, distance), target: DVec3::ZERO, up: DVec3::Y, fov: 90.0 },
        lighting: Lighting { ambient: 1.0, lights: Vec::new() },
        background: [0; 3],
        size: Size::new(64, 48).unwrap(),
        files: Vec::new(),
        warnings: Vec::new(),
    }
}

fn accounted(p: &Projection) -> u32 {
    let c = p.counts;
    c.drawn + c.behind + c.off_screen + c.degenerate + c.between_centres
}

#[test]
fn a_vertex_lands_where_perspective_puts_it() {
    // Field of view 90 degrees: at distance 2, two units are half the picture's height, 24 pixels.
    let corners = vec![dvec3(0.0, 0.0, 0.0), dvec3(2.0, 0.0, 0.0), dvec3(0.0, 2.0, 0.0)];
    let p = scene(mesh(corners, &[[0, 1, 2]]), 2.0).project().unwrap();
    let places = p.vertices[0].map(|v| (v.x, v.y));
    assert_eq!(places, [(32 * 16, 24 * 16), (56 * 16, 24 * 16), (32 * 16, 0)]);
    assert_eq!(p.vertices[0].map(|v| v.rgb), [[128, 255, 64]; 3]);
    // Everything at one distance is at the near plane.
    assert_eq!(p.vertices[0].map(|v| v.z), [NEAREST_VERTEX; 3]);
}

#[test]
fn depth_runs_from_the_nearest_to_the_farthest_vertex() {
    let corners = vec![dvec3(-1.0, 0.0, 1.0), dvec3(1.0, 0.0, -1.0), dvec3(0.0, 1.0, 0.0)];
    let p = scene(mesh(corners, &[[0, 1, 2]]), 3.0).project().unwrap();
    let [near, far, middle] = p.vertices[0].map(|v| v.z);
    assert_eq!((near, far), (NEAREST_VERTEX, FARTHEST_VERTEX));
    // Linear in 1/w: (1/2 - 1/3) / (1/2 - 1/4) = 2/3 of the range.
    assert_eq!(middle, NEAREST_VERTEX + (2 * (FARTHEST_VERTEX - NEAREST_VERTEX) + 1) / 3);
}

#[test]
fn each_fate_is_counted() {
    let corners = vec![
        dvec3(-1.0, -1.0, 0.0),
        dvec3(1.0, -1.0, 0.0),
        dvec3(0.0, 1.0, 0.0),
        // Behind the eye at z = 4.
        dvec3(0.0, 0.0, 9.0),
        dvec3(1.0, 0.0, 9.0),
        dvec3(0.0, 1.0, 9.0),
        // Far to the right: off the screen, and beyond the guard band.
        dvec3(50.0, 0.0, 0.0),
        dvec3(51.0, 0.0, 0.0),
        dvec3(50.0, 1.0, 0.0),
        dvec3(5e5, 0.0, 0.0),
        dvec3(5e5, 1.0, 0.0),
        dvec3(6e5, 0.0, 0.0),
        // Half a sixteenth of a pixel wide; and narrow but proper, between the centres 31.5 and 32.5.
        dvec3(0.001, 0.0, 0.0),
        dvec3(0.01, 0.0, 0.0),
        dvec3(0.05, 0.5, 0.0),
        dvec3(0.01, 0.5, 0.0),
    ];
    let triangles = [[0, 1, 2], [3, 4, 5], [6, 7, 8], [9, 10, 11], [0, 12, 12], [13, 14, 15], [0, 1, 3]];
    let p = scene(mesh(corners, &triangles), 4.0).project().unwrap();
    let c = p.counts;
    assert_eq!((c.polygons, c.drawn, c.behind), (7, 2, 1), "{c:?}");
    assert_eq!((c.off_screen, c.degenerate, c.between_centres), (2, 1, 1), "{c:?}");
    // The last one reaches behind the eye: two pieces.
    assert_eq!(c.split, 1);
    let polygons: Vec<_> = p.triangles.iter().map(|t| t.polygon).collect();
    assert_eq!(polygons[0], 0);
    assert!(polygons.len() >= 3 && polygons[1..].iter().all(|&i| i == 6), "{polygons:?}");
}

#[test]
fn a_floor_that_passes_under_the_eye_fills_the_lower_half() {
    let far = 1e3;
    let corners = vec![dvec3(-far, -1.0, -far), dvec3(far, -1.0, -far), dvec3(far, -1.0, far), dvec3(-far, -1.0, far)];
    for triangles in [[[0, 1, 2], [0, 2, 3]], [[1, 2, 3], [1, 3, 0]]] {
        let scene = scene(mesh(corners.clone(), &triangles), 4.0);
        let p = scene.project().unwrap();
        assert!(p.counts.split >= 1, "{:?}", p.counts);
        let frame = golden::render(p.size, &p.triangles, [0; 3]);
        for y in 0..48 {
            for x in 0..64 {
                let covered = p.triangles.iter().filter(|t| t.bounds.contains(x, y) && t.covers(x, y)).count();
                assert!(covered <= 1, "pixel ({x}, {y}) is covered {covered} times");
                if y < 24 {
                    assert_eq!(frame.word(x, y), frame::blank([0; 3]), "sky at ({x}, {y})");
                } else if y > 24 {
                    // Row 24 is the horizon, where the floor ends.
                    assert_eq!(covered, 1, "floor at ({x}, {y})");
                }
            }
        }
    }
}

#[test]
fn nothing_in_front_of_the_camera_is_an_error() {
    let corners = vec![dvec3(0.0, 0.0, 9.0), dvec3(1.0, 0.0, 9.0), dvec3(0.0, 1.0, 9.0)];
    let error = scene(mesh(corners, &[[0, 1, 2]]), 4.0).project().unwrap_err();
    assert_eq!(
        error.to_string(),
        "nothing of the mesh is in front of the camera at [0, 0, 4] looking towards [0, 0, 0]: move the eye or the target"
    );
}

#[test]
fn both_sides_are_lit_alike() {
    let corners = vec![dvec3(-1.0, -1.0, 0.0), dvec3(1.0, -1.0, 0.0), dvec3(0.0, 1.0, 0.0)];
    let lit = |triangle: [u32; 3], toward: DVec3| {
        let mut scene = scene(mesh(corners.clone(), &[triangle]), 2.0);
        scene.lighting = Lighting { ambient: 0.1, lights: vec![Light { toward, intensity: 0.5 }] };
        scene.project().unwrap().vertices[0][0].rgb
    };
    // Ambient and full light on the half-bright red: (0.1 + 0.5) * 0.5 * 255 = 76.5.
    for winding in [[0, 1, 2], [0, 2, 1]] {
        assert_eq!(lit(winding, dvec3(0.0, 0.0, 7.0)), [77, 153, 38]);
        // Light from behind the triangle leaves ambient light alone.
        assert_eq!(lit(winding, dvec3(0.0, 0.0, -1.0)), [13, 26, 6]);
    }
}

#[test]
fn a_sample_is_the_frame_moved() {
    let scene = Scene::builtin("teapot").unwrap();
    let size = Size::new(160, 120).unwrap();
    let (whole, moved) = (project(&scene, size).unwrap(), project_sample(&scene, size, [16, -16]).unwrap());
    let render = |p: &Projection| golden::render(size, &p.triangles, [0; 3]);
    let (whole, moved) = (render(&whole), render(&moved));
    for y in 1..120 {
        for x in 0..159 {
            assert_eq!(whole.word(x, y), moved.word(x + 1, y - 1), "pixel ({x}, {y})");
        }
    }
    assert!(project_sample(&scene, size, [17, 0]).is_err());
}

#[test]
fn orbiting_keeps_distance_and_height() {
    let camera = Scene::builtin("ter1k").unwrap().camera;
    for step in 0..48 {
        let turned = camera.orbited(7.5 * f64::from(step));
        let (arm, old) = (turned.eye - turned.target, camera.eye - camera.target);
        assert!((arm.length() - old.length()).abs() < 1e-9);
        assert!((arm.z - old.z).abs() < 1e-12);
    }
    let quarter = camera.orbited(90.0);
    assert_eq!(quarter.eye - quarter.target, dvec3(62.0, 0.0, 38.0));
}

#[test]
fn the_largest_screen_is_filled_to_its_last_pixel() {
    let far = 1e4;
    let corners = vec![dvec3(-far, -far, 0.0), dvec3(far, -far, 0.0), dvec3(far, far, 0.0), dvec3(-far, far, 0.0)];
    let scene = scene(mesh(corners, &[[0, 1, 2], [0, 2, 3]]), 1.0);
    let size = Size::new(2048, 2048).unwrap();
    for shift in [[0, 0], [8, 7], [-8, -7]] {
        let p = project_sample(&scene, size, shift).unwrap();
        for (x, y) in [(0, 0), (2047, 0), (0, 2047), (2047, 2047), (1024, 1023)] {
            let times = p.triangles.iter().filter(|t| t.covers(x, y)).count();
            assert_eq!(times, 1, "pixel ({x}, {y}) with shift {shift:?}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(200) })]

    /// A wall of triangles that reaches far beyond the screen, seen slantwise, covers every pixel exactly once: clipping opens no crack
    /// between neighbours and draws nothing twice.
    #[test]
    fn clipping_opens_no_cracks(
        jitter in proptest::collection::vec((-0.3..0.3f64, -0.3..0.3f64), 36),
        eye in (-0.5..0.5f64, -0.5..0.5f64, 0.8..3.0f64),
        target in (-0.8..0.8f64, -0.8..0.8f64),
        stretch in prop_oneof![Just(4.0), Just(40.0), Just(300.0)],
    ) {
        let positions: Vec<_> = (0..36)
            .map(|i| (f64::from(i % 6) - 2.5, f64::from(i / 6) - 2.5, jitter[i as usize]))
            .map(|(x, y, (dx, dy))| dvec3((x + dx) * stretch, (y + dy) * stretch, 0.0))
            .collect();
        let quads = (0..25u32).map(|i| i / 5 * 6 + i % 5);
        let triangles: Vec<_> = quads.flat_map(|i| [[i, i + 1, i + 7], [i, i + 7, i + 6]]).collect();
        let mut scene = scene(mesh(positions, &triangles), 1.0);
        scene.camera.eye = dvec3(eye.0, eye.1, eye.2);
        scene.camera.target = dvec3(target.0 + eye.0, target.1 + eye.1, 0.0);
        scene.camera.fov = 20.0;
        let p = scene.project().unwrap();
        for y in 0..48 {
            for x in 0..64 {
                let times = p.triangles.iter().filter(|t| t.covers(x, y)).count();
                prop_assert_eq!(times, 1, "pixel ({}, {}) of {:?}", x, y, p.counts);
            }
        }
    }

    /// Whatever the triangles and wherever the eye, every polygon is counted once, every vertex is in range, and nothing panics.
    #[test]
    fn every_polygon_is_accounted_for(
        corners in proptest::collection::vec((-9.0..9.0f64, -9.0..9.0f64, -9.0..9.0f64), 3..20),
        eye in (-9.0..9.0f64, -9.0..9.0f64, -9.0..9.0f64),
        stretch in prop_oneof![Just(1.0), Just(1e-30), Just(1e30), Just(1e99)],
        fov in prop_oneof![10.0..120.0f64, Just(1e-6), Just(179.999)],
    ) {
        let positions: Vec<_> = corners.iter().map(|&(x, y, z)| dvec3(x, y, z) * stretch).collect();
        let triangles: Vec<_> = (2..positions.len() as u32).map(|i| [i - 2, i - 1, i]).collect();
        let mut scene = scene(mesh(positions, &triangles), 1.0);
        scene.camera.eye = dvec3(eye.0, eye.1, eye.2);
        scene.camera.fov = fov;
        if let Ok(p) = scene.project() {
            prop_assert_eq!(p.counts.polygons as usize, triangles.len());
            prop_assert_eq!(accounted(&p), p.counts.polygons);
            prop_assert!(p.triangles.is_sorted_by_key(|t| t.polygon));
            for v in p.vertices.iter().flatten() {
                prop_assert!(i16::try_from(v.x).is_ok() && i16::try_from(v.y).is_ok());
                prop_assert!((NEAREST_VERTEX..=FARTHEST_VERTEX).contains(&v.z));
            }
            golden::render(p.size, &p.triangles, [0; 3]);
        }
    }
}

/// A square, one that is far wider than the guard band, and one that is bent.
fn squares() -> Scene {
    let square = |x: f64, width: f64, bent: f64| {
        [dvec3(x, -1.0, 0.0), dvec3(x + width, -1.0, 0.0), dvec3(x + width, 1.0, bent), dvec3(x, 1.0, 0.0)]
    };
    let corners = [square(-2.0, 1.5, 0.0), square(0.0, 1e6, 0.0), square(-1.0, 1.5, 0.5)];
    let fan = |first: u32| [[first, first + 1, first + 2], [first, first + 2, first + 3]];
    let mesh = mesh(corners.as_flattened().to_vec(), &[fan(0), fan(4), fan(8)].concat());
    scene(mesh.with_faces(vec![2, 2, 2]).unwrap(), 3.0)
}

#[test]
fn a_face_is_one_polygon_where_it_is_flat() {
    let scene = squares();
    let triangles = scene.project().unwrap();
    let polygons = project_polygons(&scene, scene.size).unwrap();
    let edges = polygons.polygons.iter().map(|packet| (packet.polygon, packet.edges.len()));
    assert_eq!(edges.collect::<Vec<_>>(), [(0, 4), (1, 4), (2, 3), (2, 3)]);
    let counts = polygons.counts;
    assert_eq!((counts.polygons, counts.drawn, counts.split), (3, 3, 1));
    assert_eq!(triangles.counts.split, 1, "the wide one's upper triangle has four corners in the guard band");
    let of_triangles = golden::render(scene.size, &triangles.triangles, [0; 3]);
    assert_eq!(golden::render(scene.size, &polygons.polygons, [0; 3]), of_triangles);
}

/// The depth of a tilted face changes by thousands of units a pixel, so that snapping takes its corners out of their plane.
#[test]
fn a_tilted_face_is_a_fan() {
    let corners =
        [(-1.0, -1.0), (1.07, -0.93), (0.91, 1.03), (-1.03, 0.97)].map(|(x, y)| dvec3(x, y, 0.1 * x + 0.3 * y));
    let mesh = mesh(corners.to_vec(), &[[0, 1, 2], [0, 2, 3]]).with_faces(vec![2]).unwrap();
    let scene = scene(mesh, 3.0);
    let polygons = project_polygons(&scene, scene.size).unwrap().polygons;
    let triangles = scene.project().unwrap().triangles;
    assert!(triangles.into_iter().map(|packet| Polygon { polygon: 0, ..packet.into() }).eq(polygons));
}

#[test]
fn triangles_stay_as_they_are_among_polygons() {
    let scene = Scene::builtin("teapot").unwrap();
    let triangles = scene.project().unwrap();
    let polygons = project_polygons(&scene, scene.size).unwrap();
    assert_eq!(polygons.counts, triangles.counts);
    assert!(polygons.polygons.into_iter().eq(triangles.triangles.into_iter().map(Polygon::from)));
}
