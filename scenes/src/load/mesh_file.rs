//! Mesh files: their format is chosen by the file name's extension.

use super::{gltf, obj, ply, stl};
use crate::error::SceneError;
use crate::mesh::Mesh;
use glam::DVec3;
use std::path::{Path, PathBuf};

/// The extensions, for messages.
pub(super) const ENDINGS: &str = ".obj, .gltf, .glb, .ply or .stl";

/// A mesh, its files, and the problems found.
pub(super) struct Loaded {
    pub(super) mesh: Mesh,
    /// The up axis, by the format's convention.
    pub(super) up: DVec3,
    pub(super) files: Vec<PathBuf>,
    pub(super) warnings: Vec<String>,
}

impl Loaded {
    pub(super) fn nothing() -> Loaded {
        Loaded { mesh: Mesh::none(), up: DVec3::Y, files: Vec::new(), warnings: Vec::new() }
    }
}

/// The reader for a file with that name; as a wireframe, its mesh has the outlines of faces as lines.
type Load = fn(&Path, bool) -> Result<Loaded, SceneError>;

/// The reader for such a file, if its name is a mesh's.
pub(super) fn loader(path: &Path) -> Option<Load> {
    match path.extension()?.to_string_lossy().to_lowercase().as_str() {
        "obj" => Some(obj::load),
        "gltf" | "glb" => Some(gltf::load),
        "ply" => Some(ply::load),
        "stl" => Some(stl::load),
        _ => None,
    }
}

/// The reader for a texture that replaces the mesh's own, and is placed by its coordinates.
pub(super) fn loader_for_texture(path: &Path) -> Option<Load> {
    match path.extension()?.eq_ignore_ascii_case("obj") {
        true => Some(obj::load_for_texture),
        false => loader(path),
    }
}
