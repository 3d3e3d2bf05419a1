//! glTF 2.0 files, as text (`.gltf`) and in one binary file (`.glb`): the meshes of a scene's nodes, with base colours,
//! textures and vertex colours. The format is the Khronos Group's (ISO/IEC 12113).
//!
//! `gltf-json` reads and checks the JSON. Buffers, accessors, nodes and pictures are read here. The crate `gltf`, built
//! on `gltf-json`, panics on some malformed files. It also refuses quantised meshes that declare it.
//!
//! Factors and vertex colours of glTF are linear, but a mesh has colours as screens show them, like OBJ files. So
//! factors and vertex colours are encoded ([`colour::encoded`]), and products are of encoded colours. Both sides of a
//! face are drawn.

mod buffers;
mod colour;
mod container;
mod looks;
mod nodes;
mod primitive;

use super::mesh_file::Loaded;
use super::parts::Geometry;
use super::surfaces::Surfaces;
use crate::error::SceneError;
use crate::quote::shown;
use buffers::Buffers;
use container::File;
use glam::DVec3;
use looks::Looks;
use primitive::Primitives;
use std::path::Path;

pub(super) fn load(path: &Path, wireframe: bool) -> Result<Loaded, SceneError> {
    let file = File::read(path)?;
    let mut oddities = Oddities { path, sentences: file.oddities() };
    let mut files = vec![path.to_owned()];
    let mut buffers = Buffers::new(&file);
    let looks = Looks::new(&file, &mut oddities);
    let mut primitives = Primitives::default();
    for placed in nodes::meshes(&file, &mut oddities)? {
        primitives.add(&file, &mut buffers, &looks, &placed, &mut oddities)?;
    }
    files.extend(buffers.files());
    let geometry: Geometry = primitives.geometry;
    if geometry.faces.is_empty() && geometry.lines.is_empty() {
        return Err(file.wrong("holds no face and no line in the scene that is drawn", "export a mesh"));
    }
    let colours = looks.colours();
    if wireframe {
        let mesh = geometry.wireframe(path, &colours)?;
        return Ok(Loaded { mesh, up: DVec3::Y, files, warnings: oddities.sentences });
    }
    let textures = looks.textures(&file, &mut buffers, &mut files, &mut oddities);
    let surfaces = Surfaces::new(path, &looks.materials(), textures, &mut oddities.sentences);
    let mesh = geometry.mesh(path, &colours, surfaces)?.mesh;
    Ok(Loaded { mesh, up: DVec3::Y, files, warnings: oddities.sentences })
}

/// Sentences for features that are drawn differently from what the file says, each once.
struct Oddities<'a> {
    path: &'a Path,
    sentences: Vec<String>,
}

impl Oddities<'_> {
    fn add(&mut self, sentence: &str) {
        let sentence = format!("{}: {sentence}", shown(self.path));
        if !self.sentences.contains(&sentence) {
            self.sentences.push(sentence);
        }
    }
}
