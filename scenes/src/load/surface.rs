//! The materials of an OBJ mesh for deferred shading: its textures, each read once, and where they lie on its faces.
//!
//! A texture that cannot be read is no error here, since only deferred shading looks at it: the error waits in its place.

use super::lines::At;
use super::material::{Look, TextureName};
use super::obj_scan::{Face, Scan};
use crate::error::SceneError;
use crate::material::{MOST_MATERIALS, Mapping, Material, Materials};
use crate::quote::{quote, shown};
use crate::texture::{Texture, file};
use glam::DVec2;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The materials under construction.
pub(super) struct Surfaces<'a> {
    scan: &'a Scan,
    /// By index in [`Scan::materials`]: with its texture, and without for a face that has no texture coordinates.
    of_look: Vec<[u32; 2]>,
    materials: Vec<Material>,
    textures: Vec<Result<Arc<Texture>, SceneError>>,
    mappings: Vec<Mapping>,
}

impl<'a> Surfaces<'a> {
    /// Of a mesh whose materials look so; `None` if none says anything that deferred shading alone would show. The paths of
    /// textures go to `files`, what is odd to `warnings`.
    pub(super) fn new(
        path: &Path,
        scan: &'a Scan,
        looks: &[Look],
        files: &mut Vec<PathBuf>,
        warnings: &mut Vec<String>,
    ) -> Option<Surfaces<'a>> {
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
        let mut materials = vec![Material::default()];
        let mut index = |material: Material| {
            materials.iter().position(|&other| other == material).unwrap_or_else(|| {
                materials.push(material);
                materials.len() - 1
            }) as u32
        };
        let of_look = looks
            .iter()
            .map(|look| {
                let plain = material(look);
                let textured = Material { texture: look.texture.as_ref().map(&mut texture), ..plain };
                [textured, plain].map(&mut index)
            })
            .collect();
        if materials.len() > MOST_MATERIALS {
            warnings.push(format!(
                "{}: more than {MOST_MATERIALS} materials differ in texture or highlights, so deferred shading shows neither: use fewer",
                shown(path)
            ));
            return None;
        }
        Some(Surfaces { scan, of_look, materials, textures, mappings: Vec::new() })
    }

    /// Adds a triangle of a face, which has these of its corners.
    pub(super) fn add(&mut self, face: &Face, triangle: [usize; 3]) {
        let corners = triangle.map(|i| face.corners[i].texture);
        let is_mapped = corners.iter().all(Option::is_some);
        let material = face.material.map_or(0, |look| self.of_look[look][usize::from(!is_mapped)]);
        // Behind those of the file stands one for corners that have none.
        let none = self.scan.coordinates.len() as u32;
        self.mappings.push(Mapping { material, coordinates: corners.map(|corner| corner.unwrap_or(none)) });
    }

    pub(super) fn materials(self) -> Materials {
        let Surfaces { scan, materials, textures, mappings, .. } = self;
        let coordinates = scan.coordinates.iter().copied().chain([DVec2::ZERO]).collect();
        Materials { textures, materials, coordinates, mappings }
    }
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

    fn read(&self) -> Result<Arc<Texture>, SceneError> {
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
