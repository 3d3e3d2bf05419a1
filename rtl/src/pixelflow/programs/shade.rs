//! Deferred shading of a region: makes a colour from each appearance word.
//!
//! ```text
//! materials ──> coordinates and level ──> [texture unit] ──────────────────────────> filter ──> base ──.
//!                                              '──> unit normal ──> lights ──> product with <──────────'──> colour
//! ```
//!
//! Lights and materials are constants of the instructions; pixels differ only by their words. The light is computed
//! while the texture unit looks up texels. Source: facts E4. All arithmetic is exact floors, so any way to compute them
//! gives the same bits.

use super::super::fields::shading::*;
use super::super::fields::{Field, appearance, texture};
use super::super::instruction::Instruction;
use super::super::pixel::{Begin, Condition, Function, Mask};
use super::arithmetic::Writer;
use super::assembler::{copy, set, with_accumulator, with_constant};
use super::filter;
use super::light::{Combinations, light};
use super::normalize::normalize;
use super::perspective;
use super::ports::{await_texture, start_texture};

/// A distant light. A direction is 2^8 times a unit vector (right, down, forward from the eye); each component has a
/// sign and 8 bits.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Light {
    /// The direction towards the light; each component is from -255 to 255.
    pub direction: [i16; 3],
    /// The direction halfway between the light and the eye.
    pub half: [i16; 3],
    /// The brightness, 255 for 1.
    pub brightness: u8,
}

/// A material.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Material {
    /// Whether light falls on the material.
    pub is_lit: bool,
    /// The texture, if there is one.
    pub texture: Option<Texture>,
    /// The brightness of highlights, 255 for 1.
    pub specular: u8,
    /// How often the cosine of a highlight is squared, at most 7.
    pub squarings: u8,
}

/// A texture, as a material refers to it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Texture {
    /// The number of the texture, below 255.
    pub number: u8,
    /// The finest level, with sides of 2^level texels; at most 10.
    pub finest: u8,
}

/// The inputs of shading besides words.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Shader {
    /// Red, green and blue of a pixel that nothing covers.
    pub background: [u8; 3],
    /// The ambient light, 255 for 1.
    pub ambient: u8,
    /// The lights.
    pub lights: Vec<Light>,
    /// The materials; a word has an index into them.
    pub materials: Vec<Material>,
}

/// The number that stands for no texture.
pub const NO_TEXTURE: i64 = 255;

/// The value of `squarings` if no light falls on the material.
const UNLIT: u8 = 0xff;

/// The programs that shade a region whose appearance words begin at an address.
#[derive(Debug, Clone, Copy)]
pub struct Shading<'a> {
    /// The lights, the materials and the background.
    pub shader: &'a Shader,
    /// The address of the words.
    pub word: u64,
    /// The address of the colour: blue, green, red, so that red is sent first.
    pub colour: u64,
}

impl Shading<'_> {
    /// All instructions.
    ///
    /// ```
    /// use tilewright_rtl::pixelflow::emulator::Pixel;
    /// use tilewright_rtl::pixelflow::fields::{appearance, bank};
    /// use tilewright_rtl::pixelflow::programs::{Light, Material, Shader, Shading};
    ///
    /// let overhead = Light { direction: [0, -128, -221], half: [0, -66, -247], brightness: 200 };
    /// let plain = Material { is_lit: true, texture: None, specular: 0, squarings: 0 };
    /// let shader = Shader { background: [0, 0, 90], ambient: 55, lights: vec![overhead], materials: vec![plain] };
    /// let program = Shading { shader: &shader, word: bank(0), colour: bank(1) }.program();
    ///
    /// // A white surface that faces the light.
    /// let mut pixel = Pixel::new();
    /// let mut put = |field: tilewright_rtl::pixelflow::fields::Field, value: i16| {
    ///     let at = field.of(bank(0)).address as usize;
    ///     pixel.memory[at..at + field.bytes as usize].copy_from_slice(&value.to_le_bytes()[..field.bytes as usize]);
    /// };
    /// appearance::RGB.map(|channel| put(channel, 255));
    /// put(appearance::NORMAL[1], -1280);
    /// put(appearance::NORMAL[2], -2210);
    /// pixel.run(&program, 0, 0);
    /// assert_eq!(pixel.memory[bank(1) as usize..][..3], [254, 254, 254]);
    /// ```
    pub fn program(self) -> Vec<Instruction<u64>> {
        [self.before_texture(), self.under_texture(), self.after_texture()].concat()
    }

    /// The part up to the start of the texture unit: materials, coordinates and level of detail.
    pub fn before_texture(self) -> Vec<Instruction<u64>> {
        let mut w = Writer::default();
        w.zero();
        self.materials(&mut w);
        if self.finest().is_some() {
            w.extend(perspective::coordinates(self.word));
            w.extend(perspective::level(self.word));
            w.push(start_texture());
        }
        w.0
    }

    /// The part that needs no texture: the light that falls on a surface.
    pub fn under_texture(self) -> Vec<Instruction<u64>> {
        let mut w = Writer::default();
        if !self.is_lit() {
            return w.0;
        }
        w.push(set(Field::new(DIFFUSE, 2), self.shader.ambient.into()));
        if !self.shader.lights.is_empty() {
            w.extend(normalize(self.word));
        }
        let mut sums = Combinations::default();
        let squarings = self.squarings();
        self.shader.lights.iter().for_each(|it| light(&mut w, &mut sums, it, squarings));
        if squarings.is_some() {
            w.scaled(REFLECTED, SPECULAR, REFLECTED);
        }
        if self.shader.materials.iter().any(|material| !material.is_lit) {
            let is_unlit = with_constant(Function::Compare, Field::new(SQUARINGS, 1), UNLIT.into());
            w.push(is_unlit.begins(Begin::One).flags(Condition::Carry));
            w.push(set(Field::new(DIFFUSE, 2), 255).only(Mask::Flagged));
        }
        w.0
    }

    /// The part after the texture unit: filter, products, and the background if nothing covers the pixel.
    pub fn after_texture(self) -> Vec<Instruction<u64>> {
        let mut w = Writer::default();
        if let Some(finest) = self.finest() {
            w.extend(filter::weights(finest));
            w.push(await_texture());
            w.extend(filter::trilinear());
            w.extend(filter::base(self.word));
        }
        let own = match self.finest() {
            Some(_) => BASE,
            None => appearance::RGB.map(|channel| channel.of(self.word).address),
        };
        for (base, to) in own.into_iter().zip([2, 1, 0].map(|at| self.colour + at)) {
            if !self.is_lit() {
                w.push(copy(Field::new(base, 1), Field::new(to, 1)));
                continue;
            }
            w.scaled(base, DIFFUSE, PARTIAL);
            w.last_to_accumulator();
            let sum = with_accumulator(Function::Add, REFLECTED).writes(to).begins(Begin::Zero);
            w.push(sum.flags(Condition::Carry));
            w.push(set(Field::new(to, 1), 255).only(Mask::Flagged));
        }
        let [red, green, blue] = self.shader.background.map(i64::from);
        let is_empty = with_constant(Function::Compare, appearance::ZERO.of(self.word), 1);
        w.push(is_empty.begins(Begin::One).flags(Condition::Carry));
        w.push(set(Field::new(self.colour, 3), red << 16 | green << 8 | blue).only(Mask::Flagged));
        w.0
    }

    /// Writes the materials' values to the pixels. Each material is written to all pixels with this material or a later
    /// one, so the last write to a pixel is that of its own material.
    fn materials(self, w: &mut Writer) {
        let mut last = None;
        for (number, material) in self.shader.materials.iter().enumerate() {
            if last.replace(*material) == Some(*material) {
                continue;
            }
            let mask = if number == 0 {
                Mask::Everybody
            } else {
                let names = with_constant(Function::Compare, appearance::MATERIAL.of(self.word), number as i64);
                w.push(names.begins(Begin::One).flags(Condition::Carry));
                Mask::Flagged
            };
            let squarings = if material.is_lit { material.squarings } else { UNLIT };
            let texture = material.texture;
            let finest = texture.map_or(0, |texture| texture.finest);
            let bytes = i64::from(material.specular) | i64::from(squarings) << 8 | i64::from(finest) << 16;
            w.push(set(MATERIAL, bytes).only(mask));
            if self.finest().is_some() {
                let number = texture.map_or(NO_TEXTURE, |texture| texture.number.into());
                w.push(set(texture::TEXTURE, number).only(mask));
            }
        }
    }

    /// The finest level of all textures, if there are any.
    fn finest(self) -> Option<u8> {
        self.shader.materials.iter().filter_map(|material| material.texture).map(|texture| texture.finest).max()
    }

    fn is_lit(self) -> bool {
        self.shader.materials.iter().any(|material| material.is_lit)
    }

    /// The least and the most squarings of materials that have highlights, if there are any.
    fn squarings(self) -> Option<[u8; 2]> {
        let shining = || self.shader.materials.iter().filter(|material| material.is_lit && material.specular > 0);
        let squarings = || shining().map(|material| material.squarings);
        Some([squarings().min()?, squarings().max()?])
    }
}
