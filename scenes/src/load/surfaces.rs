//! The materials of a mesh for deferred shading, and the placement of textures on its faces, for every file format.

use crate::error::SceneError;
use crate::material::{MOST_MATERIALS, Mapping, Material, Materials};
use crate::quote::shown;
use crate::texture::Texture;
use glam::DVec2;
use std::path::Path;
use std::sync::Arc;

/// A texture, or the error for it; only drawing with it reports the error.
pub(super) type Read = Result<Arc<Texture>, SceneError>;

/// The materials under construction.
pub(super) struct Surfaces {
    /// By the file's index of a material: with its texture, and without it for a face that has no texture coordinates.
    of_look: Vec<[u32; 2]>,
    materials: Vec<Material>,
    textures: Vec<Read>,
    coordinates: Vec<DVec2>,
    mappings: Vec<Mapping>,
}

impl Surfaces {
    /// For a mesh with these materials and textures; `None` with a warning if there are too many.
    pub(super) fn new(
        path: &Path,
        looks: &[Material],
        textures: Vec<Read>,
        warnings: &mut Vec<String>,
    ) -> Option<Surfaces> {
        let mut materials = vec![Material::default()];
        let mut index = |material: Material| {
            materials.iter().position(|&other| other == material).unwrap_or_else(|| {
                materials.push(material);
                materials.len() - 1
            }) as u32
        };
        let of_look = looks.iter().map(|&look| [look, Material { texture: None, ..look }].map(&mut index)).collect();
        if materials.len() > MOST_MATERIALS {
            warnings.push(format!(
                "{}: more than {MOST_MATERIALS} materials differ in texture or highlights, so deferred shading shows neither: use fewer",
                shown(path)
            ));
            return None;
        }
        Some(Surfaces { of_look, materials, textures, coordinates: vec![DVec2::ZERO], mappings: Vec::new() })
    }

    /// Adds a triangle of that material, whose corners have these texture coordinates.
    pub(super) fn add(&mut self, look: Option<usize>, corners: [Option<u32>; 3]) {
        let is_mapped = corners.iter().all(Option::is_some);
        let material = look.map_or(0, |look| self.of_look[look][usize::from(!is_mapped)]);
        // Before those of the file is one for corners that have none.
        self.mappings.push(Mapping { material, coordinates: corners.map(|corner| corner.map_or(0, |i| i + 1)) });
    }

    /// The texture coordinates of the corners.
    pub(super) fn set_coordinates(&mut self, coordinates: Vec<DVec2>) {
        self.coordinates.extend(coordinates);
    }

    pub(super) fn materials(self) -> Materials {
        let Surfaces { materials, textures, coordinates, mappings, .. } = self;
        Materials { textures, materials, coordinates, mappings }
    }
}

/// The power of two from 1 to 128 that is nearest to a number by ratio.
pub(super) fn nearest_power(number: f64) -> u32 {
    1 << (1..8).filter(|&k| number > 0.0 && number * number >= f64::from(1_u32 << (2 * k - 1))).count()
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
