//! Lines in the front end: clipped at the near plane and in the guard band, snapped, counted, and drawn the same by
//! every path.

use glam::{DVec3, dvec3};
use proptest::prelude::*;
use tilewright_scenes::packet::{FARTHEST_VERTEX, NEAREST_VERTEX};
use tilewright_scenes::{
    Camera, Counts, Lighting, Mesh, MeshLine, MeshTriangle, Polygons, Scene, Size, golden, project_polygons,
    set_up_line, set_up_polygon,
};

const WIDTH: u32 = 64;
const HEIGHT: u32 = 48;

fn line(positions: [u32; 2]) -> MeshLine {
    MeshLine { positions, colour: [0.5, 1.0, 0.25] }
}

/// Lines from each position of even number to the next.
fn lines(positions: &[DVec3]) -> Mesh {
    let lines = (0..positions.len() as u32 / 2).map(|i| line([2 * i, 2 * i + 1]));
    Mesh::of_lines(positions.to_vec(), lines.collect()).unwrap()
}

/// Looking down the negative z axis from `distance`, y up, in the dark.
fn scene(mesh: Mesh, distance: f64) -> Scene {
    Scene {
        name: "test".into(),
        mesh,
        spheres: Vec::new(),
        camera: Camera { eye: dvec3(0.0, 0.0, distance), target: DVec3::ZERO, up: DVec3::Y, fov: 90.0 },
        lighting: Lighting { ambient: 0.0, lights: Vec::new() },
        background: [0; 3],
        size: Size::new(WIDTH, HEIGHT).unwrap(),
        files: Vec::new(),
        warnings: Vec::new(),
    }
}

fn polygons(scene: &Scene) -> Polygons {
    project_polygons(scene, scene.size).unwrap()
}

/// The pixels that are drawn, with depth and colour.
fn drawn(scene: &Scene) -> Vec<(u32, u32, u32, [u8; 3])> {
    let Polygons { size, polygons, .. } = polygons(scene);
    let frame = golden::render(size, &polygons, scene.background);
    let of_triangles = golden::render(size, &scene.project().unwrap().triangles, scene.background);
    assert_eq!(frame, of_triangles, "as polygons and as triangles");
    let all = (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |x| (x, y)));
    let pixels = all.map(|(x, y)| (x, y, frame.depth(x, y), frame.rgb(x, y)));
    pixels.filter(|pixel| pixel.3 != scene.background).collect()
}

/// From the middle of the picture to its right border, half of the distance nearer; colours are the line's own, without light.
#[test]
fn a_line_lands_where_perspective_puts_it() {
    // At distance 4 and 2; 32 pixels from the middle are 8/3 units at distance 2.
    let ends = [dvec3(0.0, 0.0, 0.0), dvec3(8.0 / 3.0, 0.0, 2.0)];
    let scene = scene(lines(&ends), 4.0);
    let vertices = &polygons(&scene).vertices[0];
    let places: Vec<_> = vertices.iter().map(|v| (v.x, v.y, v.z)).collect();
    assert_eq!(places, [(32 * 16, 24 * 16, FARTHEST_VERTEX), (64 * 16, 24 * 16, NEAREST_VERTEX)]);
    let pixels = drawn(&scene);
    // On the border of two rows the upper one has the pixel.
    assert_eq!(
        pixels.iter().map(|&(x, y, ..)| (x, y)).collect::<Vec<_>>(),
        (32..64).map(|x| (x, 23)).collect::<Vec<_>>()
    );
    assert!(
        pixels.is_sorted_by(|left, right| left.2 > right.2) && pixels.iter().all(|pixel| pixel.3 == [128, 255, 64])
    );
}

#[test]
fn each_fate_is_counted() {
    let ends = [
        // On the screen; through the eye; behind it.
        [dvec3(-1.0, -1.0, 0.0), dvec3(1.0, 1.0, 0.0)],
        [dvec3(1.0, 1.0, 0.0), dvec3(0.1, 0.1, 5.0)],
        [dvec3(0.0, 0.0, 9.0), dvec3(1.0, 0.0, 4.0)],
        // To the right of the screen, and beyond the guard band.
        [dvec3(50.0, 0.0, 0.0), dvec3(51.0, 1.0, 0.0)],
        [dvec3(5e5, 0.0, 0.0), dvec3(6e5, 1.0, 0.0)],
        // Snapped to a point; and between the centres 31.5 and 32.5.
        [dvec3(0.001, 0.0, 0.0), dvec3(0.002, 0.0, 0.0)],
        [dvec3(0.02, 0.01, 0.0), dvec3(0.06, 0.01, 0.0)],
    ];
    let scene = scene(lines(ends.as_flattened()), 4.0);
    let expected = Counts {
        polygons: 7,
        spheres: 0,
        lines: 7,
        drawn: 2,
        behind: 1,
        off_screen: 2,
        degenerate: 1,
        between_centres: 1,
        split: 0,
    };
    assert_eq!(scene.project().unwrap().counts, expected);
    assert_eq!(polygons(&scene).counts, expected);
    assert_eq!(polygons(&scene).polygons.iter().map(|packet| packet.polygon).collect::<Vec<_>>(), [0, 1]);
}

/// A triangle before a line hides it where it is nearer; lines are numbered after all faces.
#[test]
fn lines_and_triangles_hide_one_another() {
    let corners = vec![
        dvec3(-1.0, -1.0, 0.0),
        dvec3(1.0, -1.0, 0.0),
        dvec3(0.0, 1.0, 0.0),
        dvec3(0.0, 0.0, -1.0),
        dvec3(0.0, 0.0, 1.0),
        dvec3(0.9, 0.3, -1.0),
        dvec3(-0.9, 0.3, 1.0),
    ];
    let face = MeshTriangle { positions: [0, 1, 2], normals: [0; 3], diffuse: [1.0, 0.0, 0.0] };
    let mesh = Mesh::new(corners, vec![DVec3::Z], vec![face]).unwrap();
    let mut scene = scene(mesh.with_lines(vec![line([5, 6]), line([3, 4])]).unwrap(), 3.0);
    scene.lighting.ambient = 1.0;
    let all = polygons(&scene);
    assert_eq!(all.polygons.iter().map(|packet| packet.polygon).collect::<Vec<_>>(), [0, 1]);
    assert_eq!((all.counts.polygons, all.counts.lines, all.counts.degenerate), (3, 2, 1), "one is seen as a point");
    let row: Vec<_> = drawn(&scene).into_iter().filter(|&(_, y, _, rgb)| y < 24 && rgb == [128, 255, 64]).collect();
    assert!(!row.is_empty());
    // It comes out of the triangle in the middle, on the left.
    let inside = |x: u32, y: u32| all.polygons[0].covers(x, y);
    assert!(row.iter().all(|&(x, y, ..)| !inside(x, y) || x <= 32), "{row:?}");
    assert!(row.iter().any(|&(x, y, ..)| inside(x, y)) && row.iter().any(|&(x, y, ..)| x > 32 && !inside(x, y)));
}

/// Lines through the last row and column, and a diagonal through two corners, which reach far beyond the guard band.
#[test]
fn the_largest_screen_has_lines_to_its_last_pixel() {
    // Half the picture is 1024 pixels and a unit; the middle of the last pixel, and a little more or less.
    for offset in [1023.5, 1023.1, 1023.9] {
        let (far, last) = (1e4, offset / 1024.0);
        let ends = [
            [dvec3(-far, -last, 0.0), dvec3(far, -last, 0.0)],
            [dvec3(last, far, 0.0), dvec3(last, -far, 0.0)],
            [dvec3(-far, far, 0.0), dvec3(far, -far, 0.0)],
        ];
        let scene = scene(lines(ends.as_flattened()), 1.0);
        let packets = project_polygons(&scene, Size::new(2048, 2048).unwrap()).unwrap().polygons;
        let count = |number: usize, x: u32, y: u32| {
            usize::from(packets[number].covers(x, y) && packets[number].bounds.contains(x, y))
        };
        for i in 0..2048 {
            assert_eq!((count(0, i, 2047), count(1, 2047, i), count(2, i, i)), (1, 1, 1), "{i} of {offset}");
        }
    }
}

#[test]
fn packets_are_of_their_vertices() {
    let mut scene = scene(Scene::builtin("teapot").unwrap().mesh, 9.0);
    let sides = scene.mesh.wireframe().lines().to_vec();
    scene.mesh = scene.mesh.with_lines(sides).unwrap();
    let all = polygons(&scene);
    assert_eq!(all.polygons.len(), all.vertices.len());
    let mut lines = 0;
    for (packet, vertices) in all.polygons.iter().zip(&all.vertices) {
        let again = match vertices[..] {
            [p, q] => set_up_line([p, q], all.size),
            _ => set_up_polygon(vertices, all.size).pop(),
        };
        lines += usize::from(vertices.len() == 2);
        assert_eq!(
            again.map(|again| (again.edges, again.z, again.rgb)),
            Some((packet.edges.clone(), packet.z, packet.rgb))
        );
    }
    assert!(lines > 100 && lines < all.polygons.len(), "{lines}");
}

#[test]
fn a_picture_without_a_line_in_it_is_a_warning() {
    let far = scene(lines(&[dvec3(50.0, 0.0, 0.0), dvec3(51.0, 0.0, 0.0)]), 4.0);
    let sentence =
        "nothing is drawn: of 1 line, 1 is outside the picture: correct the eye, the target or the fov of the camera";
    assert_eq!(polygons(&far).warning().as_deref(), Some(sentence));
    assert_eq!(far.project().unwrap().warning().as_deref(), Some(sentence));
}

fn point() -> impl Strategy<Value = DVec3> {
    (-9.0..9.0f64, -9.0..9.0f64, -9.0..9.0f64).prop_map(|(x, y, z)| dvec3(x, y, z))
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(300) })]

    /// However far a line extends beyond screen, guard band and eye, its visible part is in the correct perspective.
    /// The tolerance is half a pixel and the snapping error: 1/32 at an end in front of the eye, and 1/16 where a
    /// diagonal becomes steep or flat.
    #[test]
    fn clipping_moves_no_pixel(p in point(), q in point(), stretch in prop_oneof![Just(1.0), Just(30.0), Just(3000.0)]) {
        // The middle stays, so that the line passes near the eye.
        let middle = (p + q) / 2.0;
        let ends = [middle + (p - middle) * stretch, middle + (q - middle) * stretch];
        let scene = scene(lines(&ends), 10.0);
        let Ok(_) = scene.project() else { return Ok(()) };
        let near = {
            let distances = ends.map(|end| 10.0 - end.z);
            let far = distances[0].max(distances[1]);
            distances[0].min(distances[1]).max(far / 4096.0)
        };
        // The line on the screen: a point of it, and its direction, both in front of the eye.
        let seen = |p: DVec3| (32.0 + 24.0 * p.x / (10.0 - p.z), 24.0 - 24.0 * p.y / (10.0 - p.z));
        let at = |part: f64| ends[0] + (ends[1] - ends[0]) * part;
        let limit = |d: f64, e: f64| if d < near { (near - d) / (e - d) } else { 0.0 };
        let (d, e) = (10.0 - ends[0].z, 10.0 - ends[1].z);
        let (from, to) = (seen(at(limit(d, e))), seen(at(1.0 - limit(e, d))));
        let (dx, dy) = (to.0 - from.0, to.1 - from.1);
        let longest = dx.abs().max(dy.abs());
        prop_assume!(longest > 1.0);
        for (x, y, ..) in drawn(&scene) {
            let (px, py) = (f64::from(x) + 0.5 - from.0, f64::from(y) + 0.5 - from.1);
            let beside = (py * dx - px * dy).abs() / longest;
            prop_assert!(beside < 0.5 + 0.07, "({}, {}) is {} beside the line", x, y, beside);
        }
        // A line that crosses a large part of the screen is visible.
        let steps = (0..=1000).map(|i| (from.0 + dx * f64::from(i) / 1000.0, from.1 + dy * f64::from(i) / 1000.0));
        let on_screen = |(x, y): (f64, f64)| (1.0..63.0).contains(&x) && (1.0..47.0).contains(&y);
        let seen_steps = steps.filter(|&step| on_screen(step)).count();
        if seen_steps as f64 / 1000.0 * longest > 2.0 {
            prop_assert!(!drawn(&scene).is_empty());
        }
    }

    /// Every line is counted once, every vertex is in range, and nothing panics.
    #[test]
    fn every_line_is_accounted_for(
        points in proptest::collection::vec(point(), 2..12),
        eye in point(),
        stretch in prop_oneof![Just(1.0), Just(1e-30), Just(1e30), Just(1e99)],
        fov in prop_oneof![10.0..120.0f64, Just(1e-6), Just(179.999)],
    ) {
        let positions: Vec<_> = points.iter().map(|&p| p * stretch).collect();
        let mesh = Mesh::of_lines(positions, (1..points.len() as u32).map(|i| line([i - 1, i])).collect()).unwrap();
        let mut scene = scene(mesh, 1.0);
        (scene.camera.eye, scene.camera.fov) = (eye, fov);
        if let Ok(all) = project_polygons(&scene, scene.size) {
            let c = all.counts;
            prop_assert_eq!((c.polygons as usize, c.lines), (points.len() - 1, c.polygons));
            prop_assert_eq!(c.drawn + c.behind + c.off_screen + c.degenerate + c.between_centres, c.polygons);
            for v in all.vertices.iter().flatten() {
                prop_assert!(i16::try_from(v.x).is_ok() && i16::try_from(v.y).is_ok());
                prop_assert!((NEAREST_VERTEX..=FARTHEST_VERTEX).contains(&v.z));
            }
            drawn(&scene);
        }
    }
}
