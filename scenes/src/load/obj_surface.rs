//! The materials of an OBJ mesh for deferred shading: highlights, and textures, each read once.
//!
//! A texture that cannot be read is no error here, since only deferred shading looks at it: the error waits in its place.

use super::lines::At;
use super::material::{Look, TextureName};
use super::surfaces::{Read, Surfaces};
use crate::material::Material;
use crate::quote::quote;
use crate::texture::file;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

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
            textures.push(name.read());
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

/// The power of two from 1 to 128 that a number is nearest to by ratio.
fn nearest_power(number: f64) -> u32 {
    1 << (1..8).filter(|&k| number > 0.0 && number * number >= f64::from(1_u32 << (2 * k - 1))).count()
}

impl TextureName {
    fn path(&self) -> PathBuf {
        self.library.parent().unwrap_or(Path::new("")).join(&self.name)
    }

    fn read(&self) -> Read {
        let at = At { path: &self.library, line: self.line };
        if self.name.starts_with('-') {
            let option = self.name.split_whitespace().next().unwrap_or_default();
            let problem = format!("`map_Kd` with the option {}", quote(option));
            return Err(at.error(problem, "give the name of the file alone, and move the texture coordinates instead"));
        }
        file::read(&self.path()).map(Arc::new).map_err(|(problem, remedy)| at.error(problem, remedy))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shininess_is_rounded_by_ratio() {
        let cases =
            [(-9.0, 1), (0.0, 1), (1.0, 1), (1.41, 1), (1.42, 2), (10.0, 8), (12.0, 16), (90.0, 64), (91.0, 128)];
        for (given, power) in cases {
            assert_eq!(nearest_power(given), power, "{given}");
        }
        assert_eq!(nearest_power(1000.0), 128);
    }
}
