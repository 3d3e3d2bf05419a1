//! Spheres by their contract, against an oracle that uses only rays.

use glam::{DVec3, dvec3};
use proptest::prelude::*;
use tilewright_scenes::deferred::{Samples, project_deferred};
use tilewright_scenes::golden::{Rule, fragments_of, render_polygons};
use tilewright_scenes::packet::{FARTHEST_VERTEX, NEAREST_VERTEX};
use tilewright_scenes::sphere::{Sphere, SpherePacket, VALUE_BITS};
use tilewright_scenes::{
    Camera, Counts, Light, Lighting, Mesh, MeshTriangle, Polygons, Scene, Size, golden, project, project_polygons,
};

/// The eye at the origin, looking along x: right is -y, down is -z.
fn scene(spheres: Vec<Sphere>, fov: f64, size: [u32; 2]) -> Scene {
    Scene {
        name: "test".into(),
        mesh: Mesh::none(),
        spheres,
        camera: Camera { eye: DVec3::ZERO, target: DVec3::X, up: DVec3::Z, fov },
        lighting: Lighting { ambient: 0.25, lights: Vec::new() },
        background: [0; 3],
        size: Size::new(size[0], size[1]).unwrap(),
        files: Vec::new(),
        warnings: Vec::new(),
    }
}

fn sphere(centre: DVec3, radius: f64) -> Sphere {
    Sphere { centre, radius, colour: [255, 128, 0] }
}

fn polygons(scene: &Scene) -> Polygons {
    project_polygons(scene, scene.size).unwrap()
}

/// The width and height of the screen, and the size of a pixel at distance 1.
fn screen(scene: &Scene) -> [f64; 3] {
    let [width, height] = [scene.size.width(), scene.size.height()].map(f64::from);
    [width, height, (scene.camera.fov / 2.0).to_radians().tan() / (height / 2.0)]
}

/// A ray through a place on the screen, in pixels; its first component is 1.
fn ray(scene: &Scene, [x, y]: [f64; 2]) -> DVec3 {
    let [width, height, pixel] = screen(scene);
    dvec3(1.0, -(x - width / 2.0) * pixel, -(y - height / 2.0) * pixel)
}

/// The place of a point, in pixels, which may be beside the screen.
fn place(scene: &Scene, point: DVec3) -> [f64; 2] {
    let [width, height, pixel] = screen(scene);
    [width / 2.0 - point.y / point.x / pixel, height / 2.0 - point.z / point.x / pixel]
}

/// The distances along the line of sight at which a ray meets a sphere.
fn meets(ray: DVec3, sphere: &Sphere) -> Option<[f64; 2]> {
    let b = ray.dot(sphere.centre) / ray.dot(ray);
    let aside = sphere.centre - ray * b;
    let half = (sphere.radius * sphere.radius - aside.dot(aside)) / ray.dot(ray);
    (half >= 0.0).then(|| [b - half.sqrt(), b + half.sqrt()])
}

/// The unrounded depth, in units, of a point at that distance, in a scene from `near` to `far`.
fn depth(distance: f64, near: f64, far: f64) -> f64 {
    let range = f64::from(FARTHEST_VERTEX - NEAREST_VERTEX);
    f64::from(NEAREST_VERTEX) + range * (1.0 - near / distance) * far / (far - near)
}

fn covered(packet: &SpherePacket) -> impl Iterator<Item = (u32, u32)> {
    let b = packet.bounds;
    (b.top..=b.bottom).flat_map(move |y| (b.left..=b.right).map(move |x| (x, y))).filter(|&(x, y)| packet.covers(x, y))
}

/// The largest error, in units, of a number with 16 fraction bits whose coefficients are each rounded. It grows with the
/// distance from the middle, which may be beside the screen.
fn rounding(scene: &Scene, packet: &SpherePacket) -> f64 {
    let b = packet.bounds;
    let [x, y] = place(scene, scene.spheres[packet.polygon as usize].centre);
    let beside = |middle: f64, edges: [u32; 2]| {
        edges.map(|edge| (f64::from(edge) - middle).abs()).into_iter().fold(0.0, f64::max)
    };
    let reach = 2.0 * f64::max(beside(x, [b.left, b.right]), beside(y, [b.top, b.bottom])) + 4.0;
    1.0 + 1.5 * reach * reach / 65536.0
}

/// A sphere in front of the eye: its middle up to 50 degrees off the line of sight, and its radius up to a third of its
/// distance.
fn spheres() -> impl Strategy<Value = Sphere> {
    let radius = prop_oneof![3 => 0.01..0.35f64, 1 => 0.0005..0.01f64];
    (1.0..60.0f64, -0.9..0.9f64, -0.7..0.7f64, radius, any::<[u8; 3]>()).prop_map(|(w, y, z, radius, colour)| Sphere {
        centre: dvec3(w, y * w, z * w),
        radius: radius * w,
        colour,
    })
}

fn lights() -> impl Strategy<Value = Lighting> {
    let direction = (-1.0..1.0f64, -1.0..1.0f64, -1.0..1.0f64).prop_map(|(x, y, z)| dvec3(x, y, z) + DVec3::Y * 1e-3);
    let light = (direction, 0.0..2.0f64).prop_map(|(toward, intensity)| Light { toward, intensity });
    (0.0..1.0f64, proptest::collection::vec(light, 0..4)).prop_map(|(ambient, lights)| Lighting { ambient, lights })
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(300) })]

    /// A pixel is inside where its ray meets the sphere, to 1/16 pixel; and there is no pixel outside the bounds.
    #[test]
    fn the_silhouette_is_that_of_rays(sphere in spheres(), fov in 30.0..100.0f64) {
        let scene = scene(vec![sphere], fov, [96, 72]);
        let Ok(made) = project_polygons(&scene, scene.size) else { return Ok(()) };
        for y in 0..72 {
            for x in 0..96 {
                let hits = |by: f64| {
                    let around = [[0.0, 0.0], [by, 0.0], [-by, 0.0], [0.0, by], [0.0, -by]];
                    around.map(|[dx, dy]| meets(ray(&scene, [f64::from(x) + 0.5 + dx, f64::from(y) + 0.5 + dy]), &sphere).is_some())
                };
                let around = hits(1.0 / 16.0);
                let inside = made.spheres.first().is_some_and(|packet| packet.covers(x, y));
                if around.iter().all(|hit| *hit == around[0]) {
                    // A sphere that is not drawn is less than an eighth of a pixel wide, and has no pixel all around.
                    prop_assert_eq!(inside, around[0], "pixel ({}, {}) of {:?}", x, y, sphere);
                }
                if inside {
                    prop_assert!(made.spheres[0].bounds.contains(x, y));
                }
            }
        }
    }

    /// Depth is that of the paraboloid through the silhouette and the nearest point: behind the sphere, by at most a
    /// quarter of its half.
    #[test]
    fn depth_is_that_of_a_paraboloid(subject in spheres(), fov in 30.0..100.0f64) {
        // A nearer and a farther primitive, so that the sphere needs no margin.
        let others = [sphere(dvec3(0.4, 2.0, 0.0), 0.1), sphere(dvec3(200.0, 900.0, 0.0), 1.0)];
        let scene = scene(vec![subject, others[0], others[1]], fov, [96, 72]);
        let Ok(made) = project_polygons(&scene, scene.size) else { return Ok(()) };
        let Some(packet) = made.spheres.first().filter(|packet| packet.polygon == 0) else { return Ok(()) };
        let (near, far) = (0.4 - 0.1, 200.0 + 1.0);
        let exact = |x: f64, y: f64| meets(ray(&scene, [x, y]), &subject).map(|both| both.map(|w| depth(w, near, far)));
        // Where the front is the farthest before the middle of front and back.
        let (centre, radius) = (subject.centre, subject.radius);
        let most = radius / ((centre.x * centre.x - radius * radius) * (centre.length_squared() - radius * radius)).sqrt();
        let most = most * near * far / (far - near) * f64::from(FARTHEST_VERTEX - NEAREST_VERTEX);
        for (x, y) in covered(packet) {
            let Some([front, back]) = exact(f64::from(x) + 0.5, f64::from(y) + 0.5) else { continue };
            let (middle, half) = ((front + back) / 2.0, (back - front) / 2.0);
            let found = f64::from(packet.depth(x, y));
            let expected = middle - half * half / most;
            let error = rounding(&scene, packet);
            prop_assert!((found - expected).abs() <= error, "{} for {} at ({}, {})", found, expected, x, y);
            prop_assert!(found >= front - error && found - front <= most / 4.0 + error);
        }
    }

    /// For every sphere, depth and channels stay in their ranges, and the silhouette's values in their bits.
    #[test]
    fn all_numbers_stay_in_range(
        all in proptest::collection::vec(spheres(), 1..4),
        fov in 10.0..120.0f64,
        lighting in lights(),
        size in prop_oneof![Just([96, 72]), Just([2048, 2048]), Just([640, 480])],
    ) {
        let scene = Scene { lighting, ..scene(all, fov, size) };
        let Ok(made) = project_polygons(&scene, scene.size) else { return Ok(()) };
        for packet in &made.spheres {
            let colour = scene.spheres[packet.polygon as usize].colour;
            let b = packet.bounds;
            let [left, top, right, bottom] = [b.left, b.top, b.right, b.bottom].map(i64::from);
            for (x, y) in [(left - 255, top - 255), (left - 255, bottom + 255), (right + 255, top - 255), (right + 255, bottom + 255)] {
                prop_assert!(packet.inside.at(x, y).abs() < 1 << VALUE_BITS);
            }
            let most = rounding(&scene, packet);
            let mut last = None;
            for (x, y) in covered(packet) {
                prop_assert!((NEAREST_VERTEX..=FARTHEST_VERTEX).contains(&packet.depth(x, y)));
                prop_assert!(packet.inside.at(x.into(), y.into()) < 1 << VALUE_BITS);
                let rgb = packet.rgb(x, y);
                // Beyond 255 comes 0, and the other way round.
                prop_assert!((0..3).all(|i| f64::from(rgb[i]) <= f64::from(colour[i]) + most), "{:?} of {:?}", rgb, colour);
                if let Some((before, was)) = last.replace(((x, y), rgb)) && before == (x.wrapping_sub(1), y) && right - left > 16 {
                    let jump = (0..3).map(|i| rgb[i].abs_diff(was[i])).max();
                    prop_assert!(jump <= Some(100), "{:?} beside {:?}", was, rgb);
                }
            }
        }
    }

    /// In the middle of the screen the rule's normal is that of the position in the circle.
    #[test]
    fn light_falls_by_the_rule(lighting in lights(), w in 3.0..20.0f64, part in 0.05..0.3f64) {
        let ball = Sphere { centre: DVec3::X * w, radius: part * w, colour: [255, 100, 1] };
        let scene = Scene { lighting, ..scene(vec![ball], 60.0, [101, 75]) };
        let made = polygons(&scene);
        let Lighting { ambient, lights } = &scene.lighting;
        let sum: f64 = lights.iter().map(|light| light.intensity).sum();
        let light: DVec3 = lights.iter().map(|light| light.toward.normalize() * light.intensity).sum();
        let most = (ambient + (sum + light.length()) / 2.0).max(1.0);
        let packet = &made.spheres[0];
        // Half of the circle's width, by the sine of its angle.
        let radius = 37.5 / 30f64.to_radians().tan() * (part / (1.0 - part * part).sqrt());
        for (x, y) in covered(packet) {
            let [across, down] = [f64::from(x) + 0.5 - 50.5, f64::from(y) + 0.5 - 37.5].map(|at| at / radius);
            let normal = dvec3(-(1.0 - across * across - down * down), -across, -down);
            let brightness = (ambient + (sum + normal.dot(light)) / 2.0) / most;
            for (found, full) in packet.rgb(x, y).into_iter().zip(ball.colour) {
                let expected = f64::from(full) * brightness;
                prop_assert!((f64::from(found) - expected).abs() <= rounding(&scene, packet), "{} for {}", found, expected);
            }
        }
    }

    /// The frame is that of all fragments, in any sequence: the least word or, in strict mode, the first of the
    /// nearest.
    #[test]
    fn a_frame_keeps_what_its_rule_says(mut all in proptest::collection::vec(spheres(), 1..5), turned in 0..4usize) {
        all.push(Sphere { colour: [1, 2, 3], ..all[0] });
        let first = scene(all.clone(), 70.0, [48, 36]);
        all.rotate_left(turned % first.spheres.len());
        let turned = scene(all, 70.0, [48, 36]);
        let Ok(made) = project_polygons(&first, first.size) else { return Ok(()) };
        let least = render_polygons(&made, Rule::Least, [9; 3]);
        prop_assert_eq!(&least, &render_polygons(&polygons(&turned), Rule::Least, [9; 3]));
        let strict = render_polygons(&made, Rule::Strict, [9; 3]);
        for (i, (least, strict)) in least.words.iter().zip(&strict.words).enumerate() {
            let (x, y) = (i as u32 % 48, i as u32 / 48);
            let words: Vec<u64> = made.spheres.iter().filter(|it| it.covers(x, y)).map(|it| it.word(x, y)).collect();
            let nearest = words.iter().min_by_key(|word| *word >> 24);
            let blank = tilewright_scenes::frame::blank([9; 3]);
            prop_assert_eq!((*least, *strict), (words.iter().min().copied().unwrap_or(blank), nearest.copied().unwrap_or(blank)));
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(24) })]

    /// Rounding is worst at the border of a large sphere, where a light from the side has its maximum and minimum:
    /// there is a margin for it.
    #[test]
    fn the_border_of_a_large_sphere_does_not_wrap(
        radius in 0.8..0.894f64,
        [y, z] in [-0.01..0.01f64, -0.01..0.01f64],
        side in 0..4usize,
    ) {
        let [lit, up] = [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]][side];
        let lights = vec![Light { toward: dvec3(0.0, lit, up), intensity: 1.0 }];
        let ball = Sphere { centre: dvec3(2.0, y, z), radius, colour: [255; 3] };
        let scene = Scene { lighting: Lighting { ambient: 0.0, lights }, ..scene(vec![ball], 90.0, [2048, 2048]) };
        let packet = &polygons(&scene).spheres[0];
        let b = packet.bounds;
        let middle = [b.left + b.right, b.top + b.bottom].map(|sum| f64::from(sum) / 2.0);
        let mut seen = [0; 2];
        for (x, y) in covered(packet) {
            // Left is where y is more, and up where z is.
            let from_light = lit * (f64::from(x) - middle[0]) + up * (f64::from(y) - middle[1]);
            let sine = -from_light / (f64::from(b.right - b.left) / 2.0);
            if sine.abs() > 0.99 {
                prop_assert_eq!(packet.rgb(x, y)[0] > 127, sine > 0.0, "pixel ({}, {})", x, y);
                seen[usize::from(sine > 0.0)] += 1;
            }
        }
        prop_assert!(seen.iter().all(|count| *count > 100), "{:?}", seen);
    }
}

/// All of the depth range, at the greatest size, with the brightest and the darkest pixel there can be.
#[test]
fn the_largest_sphere_is_in_range() {
    let ball = Sphere { centre: dvec3(2.0, 0.001, 0.0), radius: 0.8943, colour: [255, 255, 0] };
    let lights = vec![Light { toward: DVec3::NEG_X, intensity: 3.0 }];
    let scene = Scene { lighting: Lighting { ambient: 0.0, lights }, ..scene(vec![ball], 90.0, [2048, 2048]) };
    let made = polygons(&scene);
    let packet = &made.spheres[0];
    let width = packet.bounds.right - packet.bounds.left + 1;
    assert!((1020..=1024).contains(&width), "{width}");
    let depths: Vec<u32> = covered(packet).map(|(x, y)| packet.depth(x, y)).collect();
    assert!(depths.iter().all(|depth| (NEAREST_VERTEX..=FARTHEST_VERTEX).contains(depth)));
    assert!(depths.iter().min() < Some(&10_000) && depths.iter().max() > Some(&(FARTHEST_VERTEX / 2)));
    let [dark, bright] = [packet.rgb(1024 - 511, 1024), packet.rgb(1024, 1024)];
    assert!(bright[0] > 240 && (100..150).contains(&dark[0]) && bright[2] < 8, "{dark:?} {bright:?}");
    assert_eq!(fragments_of(&made), depths.len() as u64);
    // Area of the circle.
    assert!((depths.len() as f64 / (std::f64::consts::PI * 512.0 * 512.0) - 1.0).abs() < 0.01);
}

#[test]
fn each_sphere_is_counted_once() {
    let at = |x: f64, y: f64, radius: f64| sphere(dvec3(x, y, 0.0), radius);
    let all = vec![at(-9.0, 0.0, 1.0), at(9.0, 90.0, 1.0), at(9.0, 0.0, 1.0), at(9.0, 0.03, 1e-4), at(9.0, 0.0, 0.2)];
    let made = polygons(&scene(all, 60.0, [64, 48]));
    let counts =
        Counts { polygons: 5, spheres: 5, drawn: 2, behind: 1, off_screen: 1, between_centres: 1, ..Counts::default() };
    assert_eq!(made.counts, counts);
    assert_eq!(made.counts.of_each_kind(), "5 spheres");
    assert_eq!(made.spheres.iter().map(|packet| packet.polygon).collect::<Vec<_>>(), [2, 4]);
    let unseen = polygons(&scene(vec![at(9.0, 90.0, 1.0)], 60.0, [64, 48]));
    assert_eq!(
        unseen.warning().as_deref(),
        Some(
            "nothing is drawn: of 1 sphere, 1 is outside the picture: correct the eye, the target or the fov of the camera"
        )
    );
}

#[test]
fn what_cannot_be_drawn_is_said() {
    let at = |x: f64, y: f64, radius: f64| sphere(dvec3(x, y, 0.0), radius);
    let far = at(9000.0, 0.0, 1.0);
    let error = |scene: &Scene| project_polygons(scene, scene.size).unwrap_err().to_string();
    let of = |spheres: Vec<Sphere>, fov: f64, size: [u32; 2]| error(&scene(spheres, fov, size));
    let near = "sphere 2 reaches nearer to the eye than 1/4096 of the farthest distance: move the eye away, or make the sphere smaller";
    assert_eq!(of(vec![far, at(3.0, 0.0, 1.0)], 60.0, [64, 48]), near);
    // Round the eye.
    assert_eq!(of(vec![far, at(0.5, 0.0, 1.0)], 60.0, [64, 48]), near);
    assert_eq!(
        of(vec![at(2.0, 0.0, 1.5)], 90.0, [2048, 2048]),
        "sphere 1 is 2323 pixels wide on the screen, and the most is 1024: move the eye away, or take a smaller size"
    );
    assert_eq!(
        of(vec![at(1.0, 6.0, 0.5)], 165.0, [64, 48]),
        "sphere 1 is 7 times as long as wide on the screen, and the most is 4: look more straight at it, or give a smaller fov"
    );
    let scene = scene(vec![far], 60.0, [64, 48]);
    let triangles =
        "the scene has spheres, 1 of them, and no sphere is made of triangles: remove them, or project polygons";
    assert_eq!(project(&scene, scene.size).unwrap_err().to_string(), triangles);
    assert_eq!(project_deferred(&scene, scene.size, Samples::One).unwrap_err().to_string(), triangles);
    let wrong = Scene { spheres: vec![at(f64::NAN, 0.0, 1.0)], ..scene };
    assert_eq!(error(&wrong), "the centre of sphere 1 is [NaN, 0, 0]: give three finite numbers below 1e100");
}

/// A triangle through the middle of a sphere: the nearer part of each is visible.
#[test]
fn spheres_and_triangles_cut_each_other() {
    let corners = vec![dvec3(4.0, 3.0, -2.0), dvec3(4.0, -3.0, -2.0), dvec3(4.0, 0.0, 4.0)];
    let triangle = MeshTriangle { positions: [0, 1, 2], normals: [0; 3], diffuse: [0.0, 0.0, 1.0] };
    let mesh = Mesh::new(corners, vec![DVec3::NEG_X], vec![triangle]).unwrap();
    let ball = sphere(dvec3(4.0, 0.0, 0.0), 1.0);
    let scene = Scene { mesh, ..scene(vec![ball], 60.0, [64, 64]) };
    let made = polygons(&scene);
    assert_eq!((made.polygons.len(), made.spheres[0].polygon), (1, 1));
    for rule in [Rule::Least, Rule::Strict] {
        let frame = render_polygons(&made, rule, [0; 3]);
        // The front of the sphere is all in front of the plane of its middle, but for its border, which is a little nearer than that.
        let (inside, outside) = (frame.rgb(32, 32), frame.rgb(32, 58));
        assert!(inside[0] > 0 && inside[2] == 0 && outside[0] == 0 && outside[2] > 0, "{inside:?} {outside:?}");
    }
    let mut spheres_alone = made.clone();
    spheres_alone.polygons.clear();
    let both = golden::fragments(made.size, &made.polygons) + fragments_of(&spheres_alone);
    assert_eq!(fragments_of(&made), both);
}
