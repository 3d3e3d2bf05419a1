//! Scenes by name: a built-in one, a mesh file, or a scene file in TOML.

mod corner;
mod faces;
mod files;
mod framing;
mod gltf;
mod lines;
mod map;
mod material;
mod mesh_file;
mod mtl;
mod names;
mod notes;
mod numbers;
mod obj;
mod obj_scan;
mod obj_surface;
mod parts;
mod placing;
mod ply;
mod shading;
mod stl;
mod surfaces;
mod toml_file;
mod toml_values;

use crate::builtin::{self, with_defaults};
use crate::error::SceneError;
use crate::input::{self, open};
use crate::scene::Scene;
use crate::size::Size;
use framing::{FRAMING_FOV, framing_camera};
use mesh_file::{ENDINGS, Loaded};
use names::{stem, unknown_name};
use std::path::Path;

impl Scene {
    /// Loads a scene: the name of a built-in one ([`builtin::NAMES`]), or the path of a scene file (`.toml`) or a mesh
    /// (`.obj`, `.gltf`, `.glb`, `.ply` or `.stl`).
    ///
    /// Harmless problems, such as a missing material file, are in [`Scene::warnings`].
    ///
    /// # Errors
    /// [`SceneError`], one sentence that names file, line and remedy.
    pub fn load(name_or_path: impl AsRef<Path>) -> Result<Scene, SceneError> {
        Scene::load_sized(name_or_path, None)
    }

    /// As [`Scene::load`], for a screen of `size` pixels instead of the scene's own size. An automatic camera frames
    /// the mesh for that screen.
    ///
    /// # Errors
    /// As [`Scene::load`].
    pub fn load_sized(name_or_path: impl AsRef<Path>, size: Option<Size>) -> Result<Scene, SceneError> {
        let path = name_or_path.as_ref();
        if let Some(scene) = path.to_str().and_then(builtin::scene) {
            return Ok(Scene { size: size.unwrap_or(scene.size), ..scene });
        }
        let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase());
        if let Some(load) = mesh_file::loader(path) {
            return Ok(mesh_scene(path, load(path, false)?, size.unwrap_or(Size::VGA)));
        }
        match extension.as_deref() {
            Some("toml") => toml_file::load(path, size),
            None if !path.exists() && path.components().count() <= 1 => Err(unknown_name(&path.to_string_lossy())),
            _ => {
                open(path, &input::SCENE)?;
                Err(SceneError::File {
                    path: path.to_owned(),
                    problem: "is neither a scene file nor a mesh, going by its name".to_owned(),
                    remedy: format!("name a .toml, {ENDINGS} file"),
                })
            }
        }
    }
}

fn mesh_scene(path: &Path, loaded: Loaded, size: Size) -> Scene {
    let camera = framing_camera(loaded.mesh.bounding_box(), loaded.up, FRAMING_FOV, size);
    let scene = with_defaults(&stem(path), loaded.mesh, camera);
    Scene { size, files: loaded.files, warnings: loaded.warnings, ..scene }
}
