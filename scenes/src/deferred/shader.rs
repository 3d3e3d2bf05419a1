//! The shader: computes a colour from an appearance word, by the steps of [`super::arithmetic`].
//!
//! Its constants are broadcast to all pixels, as part of the instructions; pixels differ only in their words. A
//! material's values are loaded into the pixels that name it, one material after another.

use super::appearance::{Appearance, Parameters};
use super::arithmetic::*;
use crate::texture::Texture;
use std::sync::Arc;

/// A light far away, in the shader's form. Directions are 2^8 times a unit vector (right, down, forward of the eye),
/// rounded to whole numbers: a sign and 8 bits each.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ShaderLight {
    /// The direction towards the light; -255 to 255 each.
    pub direction: [i16; 3],
    /// The direction half-way between the light and the eye; the line of sight is the same for all pixels. It is zero
    /// if they are opposite.
    pub half: [i16; 3],
    /// 255 for the brightness 1.
    pub brightness: u8,
}

/// A material, in the shader's form.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ShaderMaterial {
    /// Whether light falls on it; lines show their own colour.
    pub is_lit: bool,
    /// Index into [`Shader::textures`].
    pub texture: Option<u32>,
    /// The brightness of highlights, 255 for 1.
    pub specular: u8,
    /// How often the cosine of a highlight is squared, at most [`MOST_SQUARINGS`].
    pub squarings: u8,
}

/// Everything that shading needs besides appearance words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Shader {
    /// Red, green and blue of a pixel that nothing covers.
    pub background: [u8; 3],
    /// Light from everywhere, 255 for 1.
    pub ambient: u8,
    /// At most [`MOST_LIGHTS`], so that their sum has 16 bits.
    pub lights: Vec<ShaderLight>,
    /// The materials; [`Parameters::material`] is an index into them.
    pub materials: Vec<ShaderMaterial>,
    /// The textures; materials refer to them.
    pub textures: Vec<Arc<Texture>>,
}

/// The most lights of a shader.
pub const MOST_LIGHTS: usize = 256;

/// How much light a surface sends to the eye.
struct Reflected {
    /// The factor of the surface's own colour; 255 for 1.
    diffuse: u8,
    /// The summand.
    specular: u8,
}

impl Shader {
    /// The colour of a pixel.
    ///
    /// `n` is [`unit_normal`] of the word's normal, `c` is [`cosine`] of n and a light's direction, and `h` is that of
    /// n and its half vector:
    ///
    /// ```text
    /// diffuse  = saturated(ambient + sum of brightness_at(brightness, c))
    /// specular = product(saturated(sum of brightness_at(brightness, power(h, squarings)), over lights where c > 0), the material's)
    /// base     = product(texel, rgb), where the material has a texture, or rgb
    /// colour   = saturated(product(base, diffuse) + specular)
    /// ```
    ///
    /// # Panics
    /// If the word names a material that is not in the table.
    pub fn shade(&self, word: Appearance) -> [u8; 3] {
        if word.is_empty() {
            return self.background;
        }
        let parameters = word.parameters();
        let material = self.materials[usize::from(parameters.material)];
        let base = self.base(&parameters, material);
        if !material.is_lit {
            return base;
        }
        let Reflected { diffuse, specular } = self.reflected(parameters.normal, material);
        base.map(|channel| saturated(u16::from(product(channel, diffuse)) + u16::from(specular)))
    }

    /// The colour of a pixel of eight samples, shaded once, with the least word's material.
    ///
    /// A sample with another material counts as the least word. m is the number of covered samples, and sums are over
    /// these. The normal is `floor(sum / 8)` and the colour `floor((sum + 4) / 8)`, so the colour is darkened by the
    /// uncovered share. So are highlights: `floor(specular m / 8)`. Everything else is the least word's. The uncovered
    /// samples add `floor((background (8 - m) + 4) / 8)`. So edges against the background are smooth, but those between
    /// materials are not.
    ///
    /// # Panics
    /// As [`Shader::shade`].
    pub fn shade_once(&self, samples: &[Appearance; 8]) -> [u8; 3] {
        let Some(nearest) = samples.iter().min().filter(|word| !word.is_empty()).map(Appearance::parameters) else {
            return self.background;
        };
        let covered = || {
            let all = samples.iter().filter(|word| !word.is_empty()).map(Appearance::parameters);
            all.map(|own| if own.material == nearest.material { own } else { nearest })
        };
        let sum = |of: &dyn Fn(Parameters) -> i32| covered().map(of).sum::<i32>();
        let parameters = Parameters {
            normal: [0, 1, 2].map(|i| (sum(&|p| p.normal[i].into()) >> 3) as i16),
            rgb: [0, 1, 2].map(|i| ((sum(&|p| p.rgb[i].into()) + 4) >> 3) as u8),
            ..nearest
        };
        let material = self.materials[usize::from(parameters.material)];
        let base = self.base(&parameters, material);
        let count = covered().count() as u16;
        let behind = self.background.map(|channel| (u16::from(channel) * (8 - count) + 4) >> 3);
        let Reflected { diffuse, specular } = match material.is_lit {
            true => self.reflected(parameters.normal, material),
            false => Reflected { diffuse: 255, specular: 0 },
        };
        let highlight = (u16::from(specular) * count) >> 3;
        [0, 1, 2].map(|i| saturated(u16::from(product(base[i], diffuse)) + highlight + behind[i]))
    }

    /// The surface's own colour.
    fn base(&self, parameters: &Parameters, material: ShaderMaterial) -> [u8; 3] {
        let Some(texture) = material.texture else {
            return parameters.rgb;
        };
        let uv = parameters.uv.map(|part| coordinate(part, parameters.scale));
        let texel = self.textures[texture as usize].trilinear(uv, level_at(parameters.level, parameters.scale));
        [0, 1, 2].map(|i| product(texel[i], parameters.rgb[i]))
    }

    /// The effect of the lights on a surface with this normal.
    fn reflected(&self, normal: [i16; 3], material: ShaderMaterial) -> Reflected {
        let unit = unit_normal(normal);
        let (mut diffuse, mut specular) = (u16::from(self.ambient), 0);
        for light in &self.lights {
            let lit = cosine(unit, light.direction);
            if lit > 0 {
                let highlight = power(cosine(unit, light.half), material.squarings);
                diffuse += u16::from(brightness_at(light.brightness, lit));
                specular += u16::from(brightness_at(light.brightness, highlight));
            }
        }
        Reflected { diffuse: saturated(diffuse), specular: product(saturated(specular), material.specular) }
    }
}
