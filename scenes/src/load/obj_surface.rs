//! The materials of an OBJ mesh for deferred shading: highlights, and textures, each read once.
//!
//! A texture that cannot be read is no error here, since only deferred shading looks at it: the error waits in its place.

use super::lines::At;
use super::material::{Look, TextureName};
use super::surfaces::{Surfaces, nearest_power};
use crate::error::SceneError;
use crate::material::Material;
use crate::quote::quote;
use crate::texture::file::{self, Found};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// The materials of a mesh whose materials look so; `None` if none says anything that deferred shading alone would show. The paths of
/// textures go to `files`, what is odd to `warnings`.
pub(super) fn surfaces(
    path: &Path,
    looks: &[Look],
    files: &mut Vec<PathBuf>,
    warnings: &mut Vec<String>,
) -> Option<Surfaces> {
    let says = |look: &Look| look.texture.is_some() || look.specular.is_some() || look.shininess.is_some();
    if !looks.iter().any(says) {
        return None;
    }
    let (mut textures, mut index_of) = (Vec::new(), BTreeMap::new());
    let mut texture = |name: &TextureName| {
        let path = name.path();
        *index_of.entry(path.clone()).or_insert_with(|| {
            if path.exists() {
                files.push(path);
            }
            let found = name.read();
            if let Ok(found) = &found {
                let at = At { path: &name.library, line: name.line };
                warnings.extend(found.notes.iter().map(|note| at.warning(note)));
            }
            textures.push(found.map(|found| found.texture));
            textures.len() as u32 - 1
        })
    };
    let textured = |look: &Look| Material { texture: look.texture.as_ref().map(&mut texture), ..material(look) };
    let materials: Vec<Material> = looks.iter().map(textured).collect();
    Surfaces::new(path, &materials, textures, warnings)
}

/// The material of a look, without its texture.
fn material(look: &Look) -> Material {
    let default = Material::default();
    Material {
        texture: None,
        specular: look.specular.unwrap_or(default.specular),
        shininess: look.shininess.map_or(default.shininess, nearest_power),
    }
}

impl TextureName {
    fn path(&self) -> PathBuf {
        self.library.parent().unwrap_or(Path::new("")).join(&self.name)
    }

    fn read(&self) -> Result<Found, SceneError> {
        let at = At { path: &self.library, line: self.line };
        if self.name.starts_with('-') {
            let option = self.name.split_whitespace().next().unwrap_or_default();
            let problem = format!("`map_Kd` with the option {}", quote(option));
            return Err(at.error(problem, "give the name of the file alone, and move the texture coordinates instead"));
        }
        file::read(&self.path()).map_err(|(problem, remedy)| at.error(problem, remedy))
    }
}
