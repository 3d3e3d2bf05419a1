//! The textured scene: a marble teapot and two balls on planks, under three lights. It demonstrates deferred shading.

use super::teapot;
use crate::angle::sin_cos;
use crate::light::{Light, Lighting};
use crate::material::{Mapping, Material, Materials};
use crate::mesh::{Mesh, MeshTriangle};
use crate::texture::{GENERATED, Texture};
use glam::{DVec2, DVec3, dvec2, dvec3};
use std::sync::Arc;

/// Cuts of a patch of the teapot, along each side.
const CUTS: u32 = 8;
/// Cuts of a ball, from pole to pole; twice as many round it.
const RINGS: u32 = 16;
/// Half the side of the floor, in the unit of the teapot, whose body has a diameter of 4.
const FLOOR: f64 = 40.0;
/// How often the planks repeat from the middle of the floor to its edge.
const FLOOR_REPEATS: f64 = 16.0;

/// The indices of the materials.
const CHECKER: u32 = 0;
const PLANKS: u32 = 1;
const MARBLE: u32 = 2;
const LACQUER: u32 = 3;

/// 4096 triangles of the teapot, 960 of each ball, and two of the floor.
///
/// ```
/// let mesh = tilewright_scenes::builtin::textured::mesh();
/// assert_eq!((mesh.triangles().len(), mesh.materials().unwrap().textures.len()), (4096 + 2 * 960 + 2, 3));
/// ```
pub fn mesh() -> Mesh {
    let mut parts = Parts::default();
    parts.floor();
    parts.teapot();
    parts.ball(dvec3(2.75, -2.75, 1.05), 1.05, CHECKER, [1.0; 3], dvec2(4.0, 2.0));
    parts.ball(dvec3(-2.35, -2.9, 0.72), 0.72, LACQUER, [0.75, 0.09, 0.07], DVec2::ONE);
    parts.mesh()
}

/// A key light from the left, a warm one from the right, and one from behind.
pub(super) fn lighting() -> Lighting {
    let light = |toward: DVec3, intensity: f64| Light { toward, intensity };
    Lighting {
        ambient: 0.16,
        lights: vec![
            light(dvec3(-0.7, -0.6, 0.9), 0.62),
            light(dvec3(0.9, -0.5, 0.6), 0.3),
            light(dvec3(0.1, 0.9, 0.5), 0.28),
        ],
    }
}

fn materials() -> Vec<Material> {
    let material = |texture, specular, shininess| Material { texture, specular, shininess };
    vec![
        material(Some(CHECKER), 0.5, 64),
        material(Some(PLANKS), 0.12, 16),
        material(Some(MARBLE), 0.55, 64),
        material(None, 0.7, 128),
    ]
}

/// The mesh under construction; a normal and a texture coordinate for each position.
#[derive(Default)]
struct Parts {
    positions: Vec<DVec3>,
    normals: Vec<DVec3>,
    coordinates: Vec<DVec2>,
    triangles: Vec<MeshTriangle>,
    mappings: Vec<Mapping>,
}

impl Parts {
    fn floor(&mut self) {
        let first = self.positions.len() as u32;
        for (x, y) in [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)] {
            self.vertex(dvec3(x * FLOOR, y * FLOOR, 0.0), DVec3::Z, dvec2(x, y) * FLOOR_REPEATS);
        }
        for corners in [[0, 1, 2], [0, 2, 3]] {
            self.triangle(corners.map(|i| first + i), PLANKS, [1.0; 3]);
        }
    }

    fn teapot(&mut self) {
        let first = self.positions.len() as u32;
        let teapot = teapot::mesh(CUTS);
        let coordinates = &teapot.materials().expect("the teapot has texture coordinates").coordinates;
        for ((&position, &normal), &uv) in teapot.positions().iter().zip(teapot.normals()).zip(coordinates) {
            self.vertex(position, normal, uv);
        }
        for triangle in teapot.triangles() {
            self.triangle(triangle.positions.map(|i| first + i), MARBLE, [0.98, 0.97, 0.94]);
        }
    }

    /// A ball, round which its texture repeats this many times along u and v.
    fn ball(&mut self, centre: DVec3, radius: f64, material: u32, colour: [f64; 3], repeats: DVec2) {
        let first = self.positions.len() as u32;
        let row = 2 * RINGS + 1;
        for ring in 0..=RINGS {
            let up = f64::from(ring) / f64::from(RINGS);
            let (z, width) = sin_cos(180.0 * up - 90.0);
            for step in 0..row {
                let round = f64::from(step) / f64::from(2 * RINGS);
                let (y, x) = sin_cos(360.0 * round);
                let normal = dvec3(width * x, width * y, z);
                self.vertex(centre + normal * radius, normal, dvec2(round, up) * repeats);
            }
        }
        for (ring, step) in (0..RINGS).flat_map(|ring| (0..2 * RINGS).map(move |step| (ring, step))) {
            let corner = |up: u32, along: u32| first + (ring + up) * row + step + along;
            // At the poles one of the two has no area.
            if ring > 0 {
                self.triangle([corner(0, 0), corner(0, 1), corner(1, 1)], material, colour);
            }
            if ring < RINGS - 1 {
                self.triangle([corner(0, 0), corner(1, 1), corner(1, 0)], material, colour);
            }
        }
    }

    fn vertex(&mut self, position: DVec3, normal: DVec3, uv: DVec2) {
        self.positions.push(position);
        self.normals.push(normal);
        self.coordinates.push(uv);
    }

    fn triangle(&mut self, corners: [u32; 3], material: u32, diffuse: [f64; 3]) {
        self.triangles.push(MeshTriangle { positions: corners, normals: corners, diffuse });
        self.mappings.push(Mapping { material, coordinates: corners });
    }

    fn mesh(self) -> Mesh {
        let Parts { positions, normals, coordinates, triangles, mappings } = self;
        let generated = |name| Texture::generated(name).map(|texture| Ok(Arc::new(texture)));
        let textures = GENERATED.into_iter().filter_map(generated).collect();
        let materials = Materials { textures, materials: materials(), coordinates, mappings };
        let mesh = Mesh::new(positions, normals, triangles).and_then(|mesh| mesh.with_materials(materials));
        mesh.expect("the built-in data is sound")
    }
}
