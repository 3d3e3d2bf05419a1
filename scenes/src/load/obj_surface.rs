//! The materials of an OBJ mesh for deferred shading: highlights, and textures, each read once.
//!
//! A texture that cannot be read is no error here, since only deferred shading looks at it: the error is stored in its
//! place.

use super::lines::At;
use super::material::{Look, Picture};
use super::parts::Geometry;
use super::placing::Textures;
use super::surfaces::{Read, Surfaces, nearest_power};
use crate::error::SceneError;
use crate::material::Material;
use crate::texture::file::{self, Found};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// The materials of a mesh with these looks; `None` if none has anything that only deferred shading would show. Adds
/// the paths of textures to `files`, and problems to `warnings`; moves coordinates to fit the textures' placement.
pub(super) fn surfaces(
    path: &Path,
    looks: &[Look],
    geometry: &mut Geometry,
    files: &mut Vec<PathBuf>,
    warnings: &mut Vec<String>,
) -> Option<Surfaces> {
    let says = |look: &Look| look.picture.is_some() || look.specular.is_some() || look.shininess.is_some();
    if !looks.iter().any(says) {
        return None;
    }
    let mut textures: Vec<Read> = Vec::new();
    let mut index_of = BTreeMap::new();
    let mut texture = |picture: &Picture| {
        let path = &picture.path;
        // One that appears only once may become another.
        let key = |is_clamped| (path.clone(), picture.wrong.clone(), is_clamped);
        let is_clamped = picture.placement.is_clamped;
        let same = index_of.get(&key(!is_clamped)).copied();
        *index_of.entry(key(is_clamped)).or_insert_with(|| {
            textures.push(match same {
                Some(same) => textures[same as usize].clone(),
                None => picture.read_with(files, warnings),
            });
            textures.len() as u32 - 1
        })
    };
    let of_look: Vec<Option<u32>> = looks.iter().map(|look| look.picture.as_ref().map(&mut texture)).collect();
    Textures { looks, of_look: &of_look, textures: &mut textures }.place(path, geometry, warnings);
    let textured = |(look, &texture)| Material { texture, ..material(look) };
    let materials: Vec<Material> = looks.iter().zip(&of_look).map(textured).collect();
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

impl Picture {
    /// Reads it; adds its path and its problems to the caller's lists.
    fn read_with(&self, files: &mut Vec<PathBuf>, warnings: &mut Vec<String>) -> Read {
        if self.path.is_file() && !files.contains(&self.path) {
            files.push(self.path.clone());
        }
        let found = self.read()?;
        let at = At { path: &self.library, line: self.line };
        warnings.extend(found.notes.iter().map(|note| at.warning(note)));
        Ok(found.texture)
    }

    fn read(&self) -> Result<Found, SceneError> {
        let at = At { path: &self.library, line: self.line };
        if let Some((problem, remedy)) = &self.wrong {
            return Err(at.error(problem, *remedy));
        }
        file::read(&self.path).map_err(|(problem, remedy)| at.error(problem, remedy))
    }
}
