//! Scenes by name: a built-in one, an OBJ file, or a scene file in TOML.

mod material;
mod obj;
mod obj_scan;
mod toml_file;
mod toml_values;

use crate::builtin::{self, with_defaults};
use crate::camera::Camera;
use crate::mesh::Mesh;
use crate::scene::Scene;
use crate::size::Size;
use crate::{SceneError, input::read_bytes};
use glam::{DVec3, dvec3};
use std::path::Path;

impl Scene {
    /// Loads a scene: the name of a built-in one ([`builtin::NAMES`]), or the path of an `.obj` or a `.toml` file.
    ///
    /// What was odd but harmless, such as a missing material file, is in [`Scene::warnings`].
    ///
    /// # Errors
    /// [`SceneError`], one sentence that names file, line and remedy.
    pub fn load(name_or_path: &str) -> Result<Scene, SceneError> {
        if let Some(scene) = builtin::scene(name_or_path) {
            return Ok(scene);
        }
        let path = Path::new(name_or_path);
        let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase());
        match extension.as_deref() {
            Some("obj") => obj_scene(path),
            Some("toml") => toml_file::load(path),
            None if !path.exists() && path.components().count() <= 1 => Err(unknown_name(name_or_path)),
            _ => {
                read_bytes(path, READ_REMEDY)?;
                Err(SceneError::File {
                    path: path.to_owned(),
                    problem: "is neither a scene file nor a mesh, going by its name".to_owned(),
                    remedy: "name a .toml or an .obj file".to_owned(),
                })
            }
        }
    }
}

/// What to do about a scene or mesh file that cannot be read.
const READ_REMEDY: &str = "name an .obj or a .toml file that you may read, or a built-in scene";

/// Field of view of the camera that frames a mesh by itself, in degrees.
const FRAMING_FOV: f64 = 35.0;

/// Which way is up in an OBJ file, by custom, and from where such a mesh is seen: a little from the right and from above.
const OBJ_UP: DVec3 = DVec3::Y;
const OBJ_DIRECTION: DVec3 = dvec3(0.45, 0.35, 1.0);

fn obj_scene(path: &Path) -> Result<Scene, SceneError> {
    let loaded = obj::load(path)?;
    let camera = framing_camera(&loaded.mesh, OBJ_UP, FRAMING_FOV, Size::VGA);
    let mut scene = with_defaults(&stem(path), loaded.mesh, camera);
    scene.warnings = loaded.warnings;
    Ok(scene)
}

/// A camera that shows the whole of an OBJ file's mesh.
fn framing_camera(mesh: &Mesh, up: DVec3, fov: f64, size: Size) -> Camera {
    // If up is turned, the direction turns with it: over the same shoulder, wherever the shoulder is.
    let direction =
        if up.z.abs() > up.y.abs() { dvec3(OBJ_DIRECTION.x, -OBJ_DIRECTION.z, OBJ_DIRECTION.y) } else { OBJ_DIRECTION };
    Camera::framing(mesh.bounding_box(), direction, up, fov, size)
}

/// A file's name without folder and extension.
fn stem(path: &Path) -> String {
    path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned())
}

fn unknown_name(name: &str) -> SceneError {
    let all = builtin::NAMES.join(", ");
    let files = "or name an .obj or a .toml file";
    SceneError::UnknownScene {
        name: name.to_owned(),
        remedy: match nearest(name) {
            Some(known) => format!("did you mean `{known}`? The built-in scenes are {all}; {files}"),
            None => format!("the built-in scenes are {all}; {files}"),
        },
    }
}

/// The built-in scene that a misspelt name may mean.
fn nearest(name: &str) -> Option<&'static str> {
    let lower = name.to_lowercase();
    let (edits, known) = builtin::NAMES.into_iter().map(|known| (distance(&lower, known), known)).min()?;
    (edits <= 1 + known.len() / 4).then_some(known)
}

/// Levenshtein's distance: how many characters to insert, remove or change.
fn distance(left: &str, right: &str) -> usize {
    let right: Vec<char> = right.chars().collect();
    let mut row: Vec<usize> = (0..=right.len()).collect();
    for (i, l) in left.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, r) in right.iter().enumerate() {
            let changed = diagonal + usize::from(l != *r);
            diagonal = row[j + 1];
            row[j + 1] = changed.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[right.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_are_counted() {
        let cases = [("teapot", "teapot", 0), ("tepot", "teapot", 1), ("", "abc", 3), ("ter1", "ter250", 3)];
        for (left, right, edits) in cases {
            assert_eq!(distance(left, right), edits, "{left} {right}");
        }
    }
}
