//! The planes of an appearance packet against an exact oracle, on random triangles.

use crate::oracle;
use proptest::prelude::*;
use std::sync::{Arc, LazyLock};
use tilewright_scenes::deferred::{
    AppearanceVertex, Samples, Shading, coordinate, project_deferred, set_up_appearance,
};
use tilewright_scenes::packet::{FARTHEST_VERTEX, NEAREST_VERTEX};
use tilewright_scenes::{
    Camera, Lighting, Mapping, Material, Materials, Mesh, MeshTriangle, Scene, ScreenVertex, Size, Texture, golden,
    set_up,
};

static CHECKER: LazyLock<Arc<Texture>> = LazyLock::new(|| Arc::new(Texture::generated("checker").unwrap()));

const SIDE: u32 = 40;

fn screen() -> Size {
    Size::new(SIDE, SIDE).unwrap()
}

fn position() -> impl Strategy<Value = i32> {
    prop_oneof![
        4 => -64..16 * SIDE as i32 + 64,
        1 => (0..6).prop_map(|i| 128 * i),
        1 => i32::from(i16::MIN)..=i32::from(i16::MAX),
    ]
}

fn vertex() -> impl Strategy<Value = AppearanceVertex> {
    let component = || prop_oneof![3 => -32767..=32767_i16, 1 => Just(32767), 1 => Just(-32767), 1 => -2..=2_i16];
    let part = || prop_oneof![3 => any::<u16>(), 1 => Just(0), 1 => Just(u16::MAX)];
    let at = (position(), position(), NEAREST_VERTEX..=FARTHEST_VERTEX, any::<[u8; 3]>());
    (at, [component(), component(), component()], [part(), part()], part()).prop_map(
        |((x, y, z, rgb), normal, uv, scale)| AppearanceVertex { at: ScreenVertex { x, y, z, rgb }, normal, uv, scale },
    )
}

fn pixels() -> impl Iterator<Item = (u32, u32)> {
    (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y)))
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(300) })]

    /// As for depth (DES-Z): within half a unit and 0.13 of the exact plane, and never beyond the vertices' own values.
    #[test]
    fn parameters_are_exact_to_a_rounding(v in [vertex(), vertex(), vertex()], material in any::<u8>(), level in any::<u8>()) {
        let packet = set_up_appearance(&v, material, level, screen());
        let corners = v.map(|v| v.at);
        prop_assert_eq!(packet.as_ref().map(|packet| packet.triangle.clone()), set_up(&corners, screen()));
        let Some(packet) = packet else { return Ok(()) };
        for (x, y) in pixels().filter(|&(x, y)| oracle::covers(&corners, x, y)) {
            prop_assert!(packet.triangle.covers(x, y));
            let found = packet.word(x, y).parameters();
            let values = |of: &dyn Fn(&AppearanceVertex) -> i128| [of(&v[0]), of(&v[1]), of(&v[2])];
            let all = [
                (i128::from(found.z), values(&|v| v.at.z.into())),
                (found.normal[0].into(), values(&|v| v.normal[0].into())),
                (found.normal[1].into(), values(&|v| v.normal[1].into())),
                (found.normal[2].into(), values(&|v| v.normal[2].into())),
                (found.rgb[1].into(), values(&|v| v.at.rgb[1].into())),
                (found.uv[0].into(), values(&|v| v.uv[0].into())),
                (found.uv[1].into(), values(&|v| v.uv[1].into())),
                (found.scale.into(), values(&|v| v.scale.into())),
            ];
            for (found, values) in all {
                let exact = oracle::plane(&corners, values, x, y);
                prop_assert!(exact.is_within(found, 32 + 9), "({}, {}): {} for {:?}", x, y, found, exact);
                prop_assert!(values.iter().min() <= Some(&found) && Some(&found) <= values.iter().max());
            }
            prop_assert_eq!((found.material, found.level), (material, level));
        }
    }

    /// The modular planes need no more than their bits: a plane computed in full integers gives the same.
    #[test]
    fn planes_are_sums_modulo_their_width(v in [vertex(), vertex(), vertex()], step in any::<[u32; 2]>()) {
        let Some(packet) = set_up_appearance(&v, 0, 0, screen()) else { return Ok(()) };
        for plane in packet.normal.iter().chain(&packet.uv).chain([&packet.scale]) {
            prop_assert!(plane.x >> 32 == 0 && plane.y >> 32 == 0 && plane.origin >> 32 == 0);
        }
        // Incrementally, as the tree and the registers of a machine do it, from pixel (0, 0) on.
        let (x, y) = (step[0] % SIDE, step[1] % SIDE);
        let mut value = packet.normal[2].origin as u32;
        (0..x).for_each(|_| value = value.wrapping_add(packet.normal[2].x as u32));
        (0..y).for_each(|_| value = value.wrapping_add(packet.normal[2].y as u32));
        prop_assert_eq!(packet.parameters(x, y).normal[2], (value >> 16) as u16 as i16);
    }

    /// Whatever texture coordinates and distances a triangle has, at each pixel u/w and v/w are in the range of the division.
    #[test]
    fn every_quotient_is_in_range(
        corners in proptest::collection::vec((-30.0..30.0_f64, -1.0..1.0_f64, -30.0..30.0_f64, -200.0..200.0_f64, -2.0..2.0_f64), 3..12),
        once in any::<bool>(),
    ) {
        let scene = scene(&corners);
        let samples = if once { Samples::Eight(Shading::OncePerPixel) } else { Samples::One };
        let Ok(deferred) = project_deferred(&scene, screen(), samples) else { return Ok(()) };
        for pass in &deferred.passes {
            for word in golden::visible(pass.size, &pass.packets).iter().filter(|word| !word.is_empty()) {
                let p = word.parameters();
                prop_assert!(p.scale >= 7 && p.uv.iter().all(|&part| u32::from(part) < 256 * u32::from(p.scale)), "{:?}", p);
            }
        }
        golden::render_deferred(&deferred);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(300) })]

    /// The texture coordinates at a pixel are those of the point seen through its middle, found by a ray from the eye.
    /// The tolerance is a quarter of a pixel, as vertices are snapped, and the rounding of both planes.
    #[test]
    fn texture_coordinates_are_those_of_the_point_that_is_seen(
        corners in proptest::collection::vec((-8.0..8.0_f64, -6.0..6.0_f64, -14.0..-2.0_f64, -3.0..3.0_f64, -3.0..3.0_f64), 3),
    ) {
        let deferred = project_deferred(&scene(&corners), screen(), Samples::One).unwrap();
        for packet in &deferred.passes[0].packets {
            // Not edge-on, where a small distance on the screen is a large one on the surface.
            if packet.triangle.area() < 60.0 {
                continue;
            }
            for (x, y) in pixels().filter(|&(x, y)| packet.triangle.covers(x, y)) {
                let found = packet.parameters(x, y);
                let around = [(0.0, 0.0), (-0.25, 0.0), (0.25, 0.0), (0.0, -0.25), (0.0, 0.25)];
                let exact = around.map(|(dx, dy)| seen_through(&corners, f64::from(x) + 0.5 + dx, f64::from(y) + 0.5 + dy));
                for axis in 0..2 {
                    let middle = exact[0][axis];
                    let reach = exact.iter().map(|uv| (uv[axis] - middle).abs()).fold(0.0, f64::max);
                    let rounding = 8.0 / f64::from(found.scale);
                    let part = f64::from(coordinate(found.uv[axis], found.scale)) / 65536.0;
                    let away = (part - middle + 0.5).rem_euclid(1.0) - 0.5;
                    prop_assert!(away.abs() <= 2.0 * reach + rounding, "({}, {}): {} for {}, {}", x, y, part, middle, reach);
                }
            }
        }
    }
}

/// The texture coordinates of the plane through three corners, where the ray through a place on the screen meets it.
fn seen_through(corners: &[(f64, f64, f64, f64, f64)], x: f64, y: f64) -> [f64; 2] {
    let tangent = 35_f64.to_radians().tan();
    let half = f64::from(SIDE) / 2.0;
    let ray = [(x - half) / half * tangent, (half - y) / half * tangent, -1.0];
    let corner = |i: usize| [corners[i].0, corners[i].1, corners[i].2];
    let cross =
        |p: [f64; 3], q: [f64; 3]| [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];
    // The ray is inside the three sides of a pyramid from the eye in proportion to these volumes.
    let volume = |i: usize, j: usize| cross(corner(i), corner(j)).iter().zip(ray).map(|(p, q)| p * q).sum::<f64>();
    let weights = [volume(1, 2), volume(2, 0), volume(0, 1)];
    let sum: f64 = weights.iter().sum();
    let mean = |of: &dyn Fn(usize) -> f64| (0..3).map(|i| weights[i] / sum * of(i)).sum();
    [mean(&|i| corners[i].3), mean(&|i| corners[i].4)]
}

/// Triangles of these corners and texture coordinates, seen from among them.
fn scene(corners: &[(f64, f64, f64, f64, f64)]) -> Scene {
    let count = corners.len() as u32 / 3;
    let corner = |i: u32| [3 * i, 3 * i + 1, 3 * i + 2];
    let positions = corners.iter().map(|&(x, y, z, _, _)| [x, y, z].into()).collect();
    let triangle = |i| MeshTriangle { positions: corner(i), normals: [0; 3], diffuse: [1.0; 3] };
    let mesh = Mesh::new(positions, vec![[0.0, 0.0, 1.0].into()], (0..count).map(triangle).collect()).unwrap();
    let materials = Materials {
        textures: vec![Ok(CHECKER.clone())],
        materials: vec![Material { texture: Some(0), ..Material::default() }],
        coordinates: corners.iter().map(|&(_, _, _, u, v)| [u, v].into()).collect(),
        mappings: (0..count).map(|i| Mapping { material: 0, coordinates: corner(i) }).collect(),
    };
    Scene {
        mesh: mesh.with_materials(materials).unwrap(),
        camera: Camera {
            eye: [0.0, 0.0, 0.0].into(),
            target: [0.0, 0.0, -1.0].into(),
            up: [0.0, 1.0, 0.0].into(),
            fov: 70.0,
        },
        lighting: Lighting { ambient: 1.0, lights: Vec::new() },
        ..Scene::builtin("star").unwrap()
    }
}
