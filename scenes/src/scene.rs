//! A scene: mesh, spheres, camera, light, background and size.

use crate::camera::Camera;
use crate::light::Lighting;
use crate::mesh::Mesh;
use crate::size::Size;
use crate::sphere::Sphere;
use std::path::PathBuf;

/// Everything a frame is made from.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// A built-in scene's name, or a file's without its folder and extension.
    pub name: String,
    /// The triangles and lines.
    pub mesh: Mesh,
    /// The spheres, in the sequence of submission, after the whole mesh.
    pub spheres: Vec<Sphere>,
    /// Where they are seen from.
    pub camera: Camera,
    /// How they are lit.
    pub lighting: Lighting,
    /// Red, green and blue of a pixel that nothing covers.
    pub background: [u8; 3],
    /// The screen that the scene asks for; [`crate::project`] takes any other.
    pub size: Size,
    /// The files that it was read from, in sequence: none for a built-in one.
    pub files: Vec<PathBuf>,
    /// Harmless problems in the files, a sentence each.
    pub warnings: Vec<String>,
}
