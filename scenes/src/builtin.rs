//! The built-in scenes: those of the VC-1 paper with exactly its polygon counts (facts D, VC1-SCENE), two of lines, one
//! with textures, and one of spheres.
//!
//! Cameras are those of facts D; light and background are our choice.

pub mod molecule;
mod shape;
pub mod star;
pub mod table;
pub mod teapot;
pub mod teapot16;
pub mod terrain;
pub mod textured;

use crate::camera::Camera;
use crate::light::{Light, Lighting};
use crate::mesh::Mesh;
use crate::scene::Scene;
use crate::size::Size;
use glam::{DVec3, dvec3};

/// The built-in scenes' names.
pub const NAMES: [&str; 9] =
    ["teapot", "teapot16", "table", "ter1k", "ter250", "wireframe", "star", "textured", "molecule"];

/// The built-in scene with that name, or `None`.
pub fn scene(name: &str) -> Option<Scene> {
    let (mesh, camera) = match name {
        "teapot" => (teapot::mesh(8), teapot_camera()),
        "teapot16" => (teapot16::mesh(), teapot16_camera()),
        "table" => (table::mesh(), table_camera()),
        "ter1k" => (terrain::mesh(4), terrain_camera()),
        "ter250" => (terrain::mesh(1), terrain_camera()),
        "wireframe" => (teapot::faces(4).wireframe(), teapot_camera()),
        "star" => (star::mesh(), star_camera()),
        "textured" => (textured::mesh(), textured_camera()),
        "molecule" => (molecule::mesh(), molecule_camera()),
        _ => return None,
    };
    let scene = with_defaults(name, mesh, camera);
    Some(match name {
        "textured" => Scene { lighting: textured::lighting(), ..scene },
        "molecule" => Scene { spheres: molecule::spheres(), lighting: molecule::lighting(), ..scene },
        _ => scene,
    })
}

impl Scene {
    /// The built-in scene with that name, one of [`NAMES`], or `None`.
    pub fn builtin(name: &str) -> Option<Scene> {
        scene(name)
    }
}

/// A scene with the default light, background and size.
pub(crate) fn with_defaults(name: &str, mesh: Mesh, camera: Camera) -> Scene {
    Scene {
        name: name.to_owned(),
        mesh,
        spheres: Vec::new(),
        lighting: default_lighting(&camera),
        camera,
        background: BACKGROUND,
        size: Size::VGA,
        files: Vec::new(),
        warnings: Vec::new(),
    }
}

/// Night blue: visible against a black border, dark behind every scene.
pub(crate) const BACKGROUND: [u8; 3] = [24, 28, 44];

/// A key light from behind the eye's left shoulder and a weak one from the right, for every camera.
pub(crate) fn default_lighting(camera: &Camera) -> Lighting {
    let back = camera.eye - camera.target;
    let right = camera.up.cross(back);
    let length = |v: DVec3| v.dot(v).sqrt();
    let (back, right, up) = (back / length(back), right / length(right), camera.up / length(camera.up));
    let light = |toward: DVec3, intensity: f64| Light { toward, intensity };
    Lighting {
        ambient: 0.2,
        lights: vec![light(back * 0.5 - right * 0.6 + up * 0.7, 0.75), light(back * 0.3 + right + up * 0.2, 0.2)],
    }
}

fn teapot_camera() -> Camera {
    Camera { eye: dvec3(0.0, -9.5, 5.2), target: dvec3(0.2, 0.0, 1.45), up: DVec3::Z, fov: 30.0 }
}

fn teapot16_camera() -> Camera {
    Camera { eye: dvec3(0.0, -31.0, 33.0), target: dvec3(0.0, -1.3, 0.8), up: DVec3::Z, fov: 34.0 }
}

fn table_camera() -> Camera {
    Camera { eye: dvec3(0.0, -17.0, 11.0), target: dvec3(0.0, -0.6, 0.2), up: DVec3::Z, fov: 48.0 }
}

fn star_camera() -> Camera {
    Camera { eye: dvec3(2.1, -3.4, 1.5), target: DVec3::ZERO, up: DVec3::Z, fov: 28.0 }
}

fn textured_camera() -> Camera {
    Camera { eye: dvec3(0.6, -11.0, 5.2), target: dvec3(0.2, 0.0, 1.0), up: DVec3::Z, fov: 36.0 }
}

fn molecule_camera() -> Camera {
    Camera { eye: molecule::MIDDLE + dvec3(1.6, -7.0, 11.0), target: molecule::MIDDLE, up: DVec3::Z, fov: 34.0 }
}

/// 62 km away and 38 km up from the middle of the map. The map is 79.75 km square and lies on the plane z = 0.
fn terrain_camera() -> Camera {
    let centre = dvec3(terrain::MIDDLE, terrain::MIDDLE, 0.0);
    Camera { eye: centre + dvec3(0.0, -62.0, 38.0), target: centre, up: DVec3::Z, fov: 50.0 }
}
