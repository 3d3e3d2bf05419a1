//! Materials of a glTF file: base colours, their textures, and how rough they are.
//!
//! Highlights follow from roughness r, as in the peak of a microfacet model. The power is 2/r^4 - 2 (Karis, 2013). The
//! brightness is 0.04 (power + 8)/8, at most 1, because glTF reflects 0.04 of light at normal incidence. Metals are
//! drawn like other materials.

use super::Oddities;
use super::buffers::{Buffers, Uri, resolved};
use super::colour::encoded;
use super::container::File;
use crate::angle::sin_cos;
use crate::error::SceneError;
use crate::load::parts::WHITE;
use crate::load::surfaces::{Read, nearest_power};
use crate::material::Material;
use crate::texture::file::{self, Found, Wrong};
use glam::{DVec2, dvec2};
use gltf_json::extensions::texture::TextureTransform;
use gltf_json::material::AlphaMode;
use gltf_json::texture::{Info, MagFilter, WrappingMode};
use gltf_json::validation::Checked;
use gltf_json::{Image, Index};
use std::path::PathBuf;

/// The look of one material.
struct Look {
    colour: [f64; 3],
    material: Material,
    mapping: Option<Mapping>,
}

/// The source of a texture's coordinates and its placement.
pub(super) struct Mapping {
    /// The set of texture coordinates.
    pub(super) set: u32,
    transform: Option<TextureTransform>,
    /// Whether the texture repeats on all sides.
    pub(super) repeats: bool,
}

/// The file's materials in sequence, then one for primitives that name none.
pub(super) struct Looks {
    all: Vec<Look>,
    /// The pictures that they name, without repetitions.
    images: Vec<Index<Image>>,
}

impl Looks {
    pub(super) fn new(file: &File, oddities: &mut Oddities) -> Looks {
        let mut looks = Looks { all: Vec::new(), images: Vec::new() };
        undrawn(file, oddities);
        for material in &file.root.materials {
            note(material, oddities);
            let look = looks.look(file, material, oddities);
            looks.all.push(look);
        }
        looks.all.push(Look { colour: WHITE, material: rough(1.0), mapping: None });
        looks
    }

    fn look(&mut self, file: &File, material: &gltf_json::Material, oddities: &mut Oddities) -> Look {
        let pbr = &material.pbr_metallic_roughness;
        let gloss = material.extensions.as_ref().and_then(|extensions| extensions.pbr_specular_glossiness.as_ref());
        let (factor, texture, roughness) = match gloss {
            Some(gloss) => (gloss.diffuse_factor.0, &gloss.diffuse_texture, 1.0 - gloss.glossiness_factor.0),
            None => (pbr.base_color_factor.0, &pbr.base_color_texture, pbr.roughness_factor.0),
        };
        let [r, g, b, _] = factor.map(f64::from);
        let (texture, mapping) = match texture {
            Some(info) => {
                let (texture, mapping) = self.texture(file, info, oddities);
                (Some(texture), Some(mapping))
            }
            None => (None, None),
        };
        Look { colour: [r, g, b].map(encoded), material: Material { texture, ..rough(f64::from(roughness)) }, mapping }
    }

    /// The index of a texture among [`Looks::images`], and its placement.
    fn texture(&mut self, file: &File, info: &Info, oddities: &mut Oddities) -> (u32, Mapping) {
        let texture = &file.root.textures[info.index.value()];
        let sampler = texture.sampler.map(|sampler| &file.root.samplers[sampler.value()]);
        if sampler.is_some_and(|sampler| sampler.mag_filter == Some(Checked::Valid(MagFilter::Nearest))) {
            oddities.add("its textures with the filter NEAREST are drawn with linear filters");
        }
        let is_repeat = |mode: &Checked<WrappingMode>| *mode == Checked::Valid(WrappingMode::Repeat);
        let repeats = sampler.is_none_or(|sampler| is_repeat(&sampler.wrap_s) && is_repeat(&sampler.wrap_t));
        let transform = info.extensions.as_ref().and_then(|extensions| extensions.texture_transform.clone());
        let set = transform.as_ref().and_then(|transform| transform.tex_coord).unwrap_or(info.tex_coord);
        let known = self.images.iter().position(|&image| image == texture.source);
        let index = known.unwrap_or_else(|| {
            self.images.push(texture.source);
            self.images.len() - 1
        });
        (index as u32, Mapping { set, transform, repeats })
    }

    /// The index of the material that a primitive names, or of the one for those that name none.
    pub(super) fn index(&self, material: Option<Index<gltf_json::Material>>) -> usize {
        material.map_or(self.all.len() - 1, |material| material.value())
    }

    /// The placement of a material's texture, if it has one.
    pub(super) fn mapping(&self, material: usize) -> Option<&Mapping> {
        self.all[material].mapping.as_ref()
    }

    pub(super) fn colours(&self) -> Vec<[f64; 3]> {
        self.all.iter().map(|look| look.colour).collect()
    }

    pub(super) fn materials(&self) -> Vec<Material> {
        self.all.iter().map(|look| look.material).collect()
    }

    /// The textures; adds their files to `files`, and problems to `oddities`.
    pub(super) fn textures(
        &self,
        of: &File,
        buffers: &mut Buffers,
        files: &mut Vec<PathBuf>,
        oddities: &mut Oddities,
    ) -> Vec<Read> {
        let mut read = |&index: &Index<Image>| {
            let found = found(of, index, buffers, files)?;
            let (problem, remedy) = match found {
                Ok(Found { texture, notes }) => {
                    notes.iter().for_each(|note| oddities.add(note));
                    return Ok(texture);
                }
                Err(wrong) => wrong,
            };
            Err(of.wrong(&problem, &remedy))
        };
        self.images.iter().map(&mut read).collect()
    }
}

/// A picture, wherever it is stored.
fn found(
    of: &File,
    index: Index<Image>,
    buffers: &mut Buffers,
    files: &mut Vec<PathBuf>,
) -> Result<Result<Found, Wrong>, SceneError> {
    let image = &of.root.images[index.value()];
    let name = format!("images[{}]", index.value());
    if let Some(view) = image.buffer_view {
        return Ok(file::made(&name, buffers.view(view)?));
    }
    let missing = || of.wrong(&format!("{name} has neither a file nor bytes"), "export it again");
    let uri = image.uri.as_ref().ok_or_else(missing)?;
    let remedy = "put it into a file beside this one";
    Ok(match resolved(&of.path, uri).map_err(|problem| of.wrong(&format!("{name} {problem}"), remedy))? {
        Uri::Bytes(bytes) => file::made(&name, &bytes),
        Uri::File(path) => {
            if path.exists() {
                files.push(path.clone());
            }
            file::read(&path)
        }
    })
}

/// The highlights of a roughness.
fn rough(roughness: f64) -> Material {
    let square = (roughness * roughness).clamp(0.0, 1.0);
    let power = nearest_power(2.0 / (square * square).max(1e-9) - 2.0);
    let specular = (0.04 * (f64::from(power) + 8.0) / 8.0).min(1.0);
    Material { texture: None, specular, shininess: power }
}

impl Mapping {
    /// A texture coordinate in this crate's convention: v upward.
    pub(super) fn of(&self, [u, v]: [f64; 2]) -> DVec2 {
        let Some(transform) = &self.transform else {
            return dvec2(u, 1.0 - v);
        };
        let [scale, offset] = [transform.scale.0, transform.offset.0].map(|pair| pair.map(f64::from));
        let (sin, cos) = sin_cos(f64::from(transform.rotation.0).to_degrees());
        let (u, v) = (u * scale[0], v * scale[1]);
        dvec2(cos * u + sin * v + offset[0], 1.0 - (cos * v - sin * u + offset[1]))
    }
}

/// Whether a material has something.
type Part = fn(&gltf_json::Material) -> bool;

/// One sentence for features of materials that are not drawn.
fn undrawn(file: &File, oddities: &mut Oddities) {
    let parts: [(Part, &str); 5] = [
        (is_metal, "metalness"),
        (
            |material| !is_glossy(material) && material.pbr_metallic_roughness.metallic_roughness_texture.is_some(),
            "textures of roughness",
        ),
        (|material| material.normal_texture.is_some(), "textures of normals"),
        (|material| material.occlusion_texture.is_some(), "textures of occlusion"),
        (|material| material.emissive_texture.is_some() || material.emissive_factor.0 != [0.0; 3], "emission"),
    ];
    let has = |part: &Part| file.root.materials.iter().any(part);
    let given: Vec<&str> = parts.iter().filter(|(part, _)| has(part)).map(|(_, what)| *what).collect();
    if !given.is_empty() {
        let given = given.join(", ");
        oddities
            .add(&format!("of its materials base colours, their textures and roughness are drawn, but not {given}"));
    }
}

fn is_glossy(material: &gltf_json::Material) -> bool {
    material.extensions.as_ref().is_some_and(|extensions| extensions.pbr_specular_glossiness.is_some())
}

fn is_unlit(material: &gltf_json::Material) -> bool {
    material.extensions.as_ref().is_some_and(|extensions| extensions.unlit.is_some())
}

fn is_metal(material: &gltf_json::Material) -> bool {
    !is_glossy(material) && !is_unlit(material) && material.pbr_metallic_roughness.metallic_factor.0 > 0.0
}

/// Features of a material that are drawn differently.
fn note(material: &gltf_json::Material, oddities: &mut Oddities) {
    if is_unlit(material) {
        oddities.add("its materials without light are lit as others are");
    }
    match material.alpha_mode {
        Checked::Valid(AlphaMode::Opaque) | Checked::Invalid => {}
        Checked::Valid(AlphaMode::Mask | AlphaMode::Blend) => {
            oddities.add(
                "its materials with an alpha mode are drawn as opaque ones: cut or remove what is to be seen through",
            );
        }
    }
}
