//! Materials: a surface's properties for deferred shading besides its colour, and the placement of textures on
//! triangles.

use crate::error::SceneError;
use crate::quote::number;
use crate::texture::Texture;
use glam::DVec2;
use std::sync::Arc;

/// The most materials of a mesh: a pixel names one in 8 bits, and lines have one of their own.
pub const MOST_MATERIALS: usize = 255;

/// A surface's look besides its colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// Index of its texture, whose colours multiply its own; `None` for none.
    pub texture: Option<u32>,
    /// The brightness of its highlights, 0 to 1.
    pub specular: f64,
    /// The power of the cosine that makes a highlight: 1, 2, 4 and so on up to 128. The greater, the smaller the highlight.
    pub shininess: u32,
}

impl Default for Material {
    /// The default surface: no texture, and soft highlights.
    fn default() -> Material {
        Material { texture: None, specular: 0.25, shininess: 32 }
    }
}

impl Material {
    /// Checks its highlights.
    ///
    /// # Errors
    /// [`SceneError::Invalid`] if `specular` is not from 0 to 1, or `shininess` is not a power of two up to 128.
    pub fn check(&self) -> Result<(), SceneError> {
        if !(0.0..=1.0).contains(&self.specular) {
            return Err(SceneError::invalid(
                format!("the brightness of highlights is {}", number(self.specular)),
                "give a number from 0 to 1",
            ));
        }
        if !self.shininess.is_power_of_two() || self.shininess > 128 {
            return Err(SceneError::invalid(
                format!("the shininess is {}", self.shininess),
                "give 1, 2, 4, 8, 16, 32, 64 or 128",
            ));
        }
        Ok(())
    }
}

/// The material of a triangle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Mapping {
    /// Index of its material.
    pub material: u32,
    /// Three indices into the texture coordinates, one per corner.
    pub coordinates: [u32; 3],
}

/// The materials of a mesh, their textures, and the placement on its triangles.
#[derive(Clone, Debug, PartialEq)]
pub struct Materials {
    /// Textures; an unreadable one is replaced by its error, which is reported when something is drawn with it.
    pub textures: Vec<Result<Arc<Texture>, SceneError>>,
    /// 1 to [`MOST_MATERIALS`].
    pub materials: Vec<Material>,
    /// Texture coordinates u (rightward) and v (upward); a texture fills 0 to 1 and repeats beyond.
    pub coordinates: Vec<DVec2>,
    /// One entry for each triangle of the mesh.
    pub mappings: Vec<Mapping>,
}

impl Materials {
    /// Whether a triangle has a texture.
    pub fn are_textured(&self) -> bool {
        self.mappings.iter().any(|mapping| self.materials[mapping.material as usize].texture.is_some())
    }

    /// One material for `triangles` triangles, which have no texture coordinates.
    pub(crate) fn plain(material: Material, triangles: usize) -> Materials {
        let mappings = vec![Mapping::default(); triangles];
        Materials { textures: Vec::new(), materials: vec![material], coordinates: vec![DVec2::ZERO], mappings }
    }

    /// Whether any triangle has a texture coordinate other than zero.
    pub(crate) fn has_coordinates(&self) -> bool {
        let corners = self.mappings.iter().flat_map(|mapping| mapping.coordinates);
        corners.into_iter().any(|i| self.coordinates[i as usize] != DVec2::ZERO)
    }

    /// The texture coordinates of a triangle's corners.
    pub(crate) fn corners(&self, triangle: u32) -> [DVec2; 3] {
        self.mappings[triangle as usize].coordinates.map(|i| self.coordinates[i as usize])
    }

    /// Checks that they fit a mesh with this number of triangles.
    pub(crate) fn check(&self, triangles: usize) -> Result<(), SceneError> {
        let refuse = |problem: String, remedy: &str| Err(SceneError::invalid(problem, remedy));
        let (given, materials) = (self.mappings.len(), self.materials.len());
        if given != triangles {
            return refuse(
                format!("{given} triangles have a material, and the mesh has {triangles}"),
                "give one to each",
            );
        }
        if !(1..=MOST_MATERIALS).contains(&materials) {
            return refuse(format!("the mesh has {materials} materials"), "give 1 to 255");
        }
        for material in &self.materials {
            material.check()?;
            if material.texture.is_some_and(|texture| texture as usize >= self.textures.len()) {
                return refuse("a material names a texture that does not exist".to_owned(), "correct the index");
            }
        }
        if self.coordinates.iter().any(|uv| !(uv.x.abs() < 1e100 && uv.y.abs() < 1e100)) {
            return refuse("a texture coordinate is out of range".to_owned(), "give finite numbers below 1e100");
        }
        let unknown = |mapping: &Mapping| {
            mapping.material as usize >= materials
                || mapping.coordinates.iter().any(|&i| i as usize >= self.coordinates.len())
        };
        match self.mappings.iter().position(unknown) {
            Some(i) => refuse(
                format!("triangle {i} names a material or a texture coordinate that does not exist"),
                "correct the index",
            ),
            None => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn materials_that_make_no_sense_are_refused() {
        let plain = || Materials::plain(Material::default(), 2);
        let refused = |materials: Materials| materials.check(2).expect_err("unsound").to_string();
        let of = |material: Material| refused(Materials { materials: vec![material], ..plain() });
        let default = Material::default();
        let mapped = |mapping| refused(Materials { mappings: vec![Mapping::default(), mapping], ..plain() });
        let unknown = "triangle 1 names a material or a texture coordinate that does not exist: correct the index";
        let cases = [
            (
                refused(Materials::plain(default, 3)),
                "3 triangles have a material, and the mesh has 2: give one to each",
            ),
            (refused(Materials { materials: Vec::new(), ..plain() }), "the mesh has 0 materials: give 1 to 255"),
            (
                refused(Materials { materials: vec![default; 256], ..plain() }),
                "the mesh has 256 materials: give 1 to 255",
            ),
            (
                of(Material { specular: 1.5, ..default }),
                "the brightness of highlights is 1.5: give a number from 0 to 1",
            ),
            (of(Material { shininess: 48, ..default }), "the shininess is 48: give 1, 2, 4, 8, 16, 32, 64 or 128"),
            (of(Material { shininess: 256, ..default }), "the shininess is 256: give 1, 2, 4, 8, 16, 32, 64 or 128"),
            (
                of(Material { texture: Some(0), ..default }),
                "a material names a texture that does not exist: correct the index",
            ),
            (
                refused(Materials { coordinates: vec![DVec2::NAN], ..plain() }),
                "a texture coordinate is out of range: give finite numbers below 1e100",
            ),
            (mapped(Mapping { material: 1, ..Mapping::default() }), unknown),
            (mapped(Mapping { coordinates: [0, 0, 1], ..Mapping::default() }), unknown),
        ];
        for (sentence, expected) in cases {
            assert_eq!(sentence, expected);
        }
        assert_eq!(plain().check(2), Ok(()));
    }
}
