//! Mesh files: what they are goes by the ending of their name.

use super::{gltf, obj, ply, stl};
use crate::error::SceneError;
use crate::mesh::Mesh;
use glam::DVec3;
use std::path::{Path, PathBuf};

/// The endings, for messages.
pub(super) const ENDINGS: &str = ".obj, .gltf, .glb, .ply or .stl";

/// A mesh, the files that it is in, and what was odd about them.
pub(super) struct Loaded {
    pub(super) mesh: Mesh,
    /// Which way is up, by the custom of such files.
    pub(super) up: DVec3,
    pub(super) files: Vec<PathBuf>,
    pub(super) warnings: Vec<String>,
}

impl Loaded {
    pub(super) fn nothing() -> Loaded {
        Loaded { mesh: Mesh::none(), up: DVec3::Y, files: Vec::new(), warnings: Vec::new() }
    }
}

/// What a file of that name is read with; as a wireframe, its mesh has the outlines of faces for lines.
type Load = fn(&Path, bool) -> Result<Loaded, SceneError>;

/// What reads such a file, if its name is one of a mesh.
pub(super) fn loader(path: &Path) -> Option<Load> {
    match path.extension()?.to_string_lossy().to_lowercase().as_str() {
        "obj" => Some(obj::load),
        "gltf" | "glb" => Some(gltf::load),
        "ply" => Some(ply::load),
        "stl" => Some(stl::load),
        _ => None,
    }
}

/// What reads it for a texture that takes the place of its own, and lies as its coordinates say.
pub(super) fn loader_for_texture(path: &Path) -> Option<Load> {
    match path.extension()?.eq_ignore_ascii_case("obj") {
        true => Some(obj::load_for_texture),
        false => loader(path),
    }
}
