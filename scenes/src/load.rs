//! Scenes by name: a built-in one, an OBJ file, or a scene file in TOML.

mod faces;
mod framing;
mod lines;
mod material;
mod names;
mod obj;
mod obj_scan;
mod obj_surface;
mod parts;
mod surfaces;
mod toml_file;
mod toml_values;

use crate::builtin::{self, with_defaults};
use crate::error::SceneError;
use crate::input::{self, open};
use crate::scene::Scene;
use crate::size::Size;
use framing::{FRAMING_FOV, OBJ_UP, framing_camera};
use names::{stem, unknown_name};
use std::path::Path;

impl Scene {
    /// Loads a scene: the name of a built-in one ([`builtin::NAMES`]), or the path of an `.obj` or a `.toml` file.
    ///
    /// What was odd but harmless, such as a missing material file, is in [`Scene::warnings`].
    ///
    /// # Errors
    /// [`SceneError`], one sentence that names file, line and remedy.
    pub fn load(name_or_path: impl AsRef<Path>) -> Result<Scene, SceneError> {
        Scene::load_sized(name_or_path, None)
    }

    /// As [`Scene::load`], for a screen of `size` pixels instead of what the scene asks for: a camera that frames a mesh by itself
    /// frames it for that screen.
    ///
    /// # Errors
    /// As [`Scene::load`].
    pub fn load_sized(name_or_path: impl AsRef<Path>, size: Option<Size>) -> Result<Scene, SceneError> {
        let path = name_or_path.as_ref();
        if let Some(scene) = path.to_str().and_then(builtin::scene) {
            return Ok(Scene { size: size.unwrap_or(scene.size), ..scene });
        }
        let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase());
        match extension.as_deref() {
            Some("obj") => obj_scene(path, size.unwrap_or(Size::VGA)),
            Some("toml") => toml_file::load(path, size),
            None if !path.exists() && path.components().count() <= 1 => Err(unknown_name(&path.to_string_lossy())),
            _ => {
                open(path, &input::SCENE)?;
                Err(SceneError::File {
                    path: path.to_owned(),
                    problem: "is neither a scene file nor a mesh, going by its name".to_owned(),
                    remedy: "name a .toml or an .obj file".to_owned(),
                })
            }
        }
    }
}

fn obj_scene(path: &Path, size: Size) -> Result<Scene, SceneError> {
    let loaded = obj::load(path, false)?;
    let camera = framing_camera(loaded.mesh.bounding_box(), OBJ_UP, FRAMING_FOV, size);
    let scene = with_defaults(&stem(path), loaded.mesh, camera);
    Ok(Scene { size, files: loaded.files, warnings: loaded.warnings, ..scene })
}
