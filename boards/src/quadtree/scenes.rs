//! The turning scenes of the boards.

use tilewright_scenes::builtin::teapot;
use tilewright_scenes::{Mesh, MeshTriangle, Scene};

use super::turning::Turning;

/// The teapot of 256 triangles, in 13 steps of a whole turn.
pub fn teapot() -> Turning {
    let scene = Scene::builtin("teapot").expect("a built-in scene");
    Turning { scene: Scene { mesh: teapot::mesh(2), ..scene }, steps: 13, is_closed: false, degrees: 360.0 }
}

/// A cube that stands on a corner's edge line, in steps of a quarter turn: it then looks the same.
pub fn cube(steps: u32) -> Turning {
    let scene = Scene::builtin("teapot").expect("a built-in scene");
    Turning { scene: Scene { mesh: cube_mesh(), ..scene }, steps, is_closed: true, degrees: 90.0 }
}

/// Two triangles for each face, where the teapot would be.
fn cube_mesh() -> Mesh {
    let (low, high) = ([-1.4, -1.4, 0.2], [1.4, 1.4, 2.9]);
    let corner = |number: usize| [0, 1, 2].map(|axis| if number >> axis & 1 == 1 { high[axis] } else { low[axis] });
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let normals = [[0, 0, -1], [0, 0, 1], [0, -1, 0], [0, 1, 0], [-1, 0, 0], [1, 0, 0]];
    let positions = (0..8).map(|number| corner(number).into()).collect();
    let normals = normals.map(|normal| normal.map(f64::from).into()).to_vec();
    let triangles = (0..6).flat_map(|face: usize| {
        let corners: [u32; 4] = faces[face];
        [[0, 1, 2], [0, 2, 3]].map(|of| MeshTriangle {
            positions: of.map(|at: usize| corners[at]),
            normals: [face as u32; 3],
            diffuse: [0.9, 0.75, 0.35],
        })
    });
    Mesh::new(positions, normals, triangles.collect()).expect("the mesh is sound")
}
