//! Deferred shading of a region with eight samples per pixel: shades the mean of their surfaces once.
//!
//! ```text
//! word of a sample ──> take: keep surface, material, least word ── eight times ──> combine: mean surface ──> shading ──> add background
//! ```
//!
//! The words come one after another to the same bank. The shader keeps colour, normal and material of each word, and
//! the least word of all. It then shades that word with the mean colour and normal. Source: facts E4. The result equals
//! that of the golden `Shader::shade_once`, bit for bit.

use super::super::fields::appearance::{BYTES, MATERIAL, NORMAL, RGB, ZERO as EMPTY};
use super::super::fields::samples::{self, BEHIND, COUNT};
use super::super::fields::shading::{HIGH, LOW, REFLECTED, ZERO};
use super::super::fields::{Field, appearance};
use super::super::instruction::Instruction;
use super::super::pixel::{Begin, Condition, Function, Mask};
use super::arithmetic::Writer;
use super::assembler::{carried, copy, load, set, with_accumulator, with_constant};
use super::average::{add, eighth};
use super::ports::move_word;
use super::shade::Shading;

/// The number of samples of a pixel.
const SAMPLES: u64 = 8;
/// The sign bit in the top byte of a component.
const SIGN: i64 = 0x80;

/// The programs that shade a region of eight samples once.
#[derive(Debug, Clone, Copy)]
pub struct ShadingOnce<'a> {
    /// The programs that shade the least word, which is kept at their address of words.
    pub shading: Shading<'a>,
}

impl ShadingOnce<'_> {
    /// Keeps the word of the sample with this number, 0 to 7, from an address. That takes 32 clocks for sample 0, and 74
    /// for each later one.
    ///
    /// ```
    /// use tilewright_rtl::pixelflow::emulator::Pixel;
    /// use tilewright_rtl::pixelflow::fields::{appearance, bank};
    /// use tilewright_rtl::pixelflow::programs::{Material, Shader, Shading, ShadingOnce};
    ///
    /// let plain = Material { is_lit: false, texture: None, specular: 0, squarings: 0 };
    /// let shader = Shader { background: [0, 0, 80], ambient: 0, lights: vec![], materials: vec![plain] };
    /// let once = ShadingOnce { shading: Shading { shader: &shader, word: 160, colour: bank(1) } };
    ///
    /// // A red surface that covers six of the samples.
    /// let mut pixel = Pixel::new();
    /// for sample in 0..8 {
    ///     let covers = sample < 6;
    ///     let byte = |field: tilewright_rtl::pixelflow::fields::Field| field.of(bank(0)).address as usize;
    ///     pixel.memory[byte(appearance::DEPTH)..][..3].fill(if covers { 7 } else { 255 });
    ///     pixel.memory[byte(appearance::ZERO)] = if covers { 0 } else { 255 };
    ///     pixel.memory[byte(appearance::RGB[0])] = 200;
    ///     pixel.run(&once.take(sample, bank(0)), 0, 0);
    /// }
    /// pixel.run(&once.combine(), 0, 0);
    /// pixel.run(&[once.before_texture(), once.under_texture(), once.after_texture()].concat(), 0, 0);
    /// assert_eq!(pixel.memory[bank(1) as usize..][..3], [20, 0, 150]);
    /// ```
    pub fn take(self, number: u64, from: u64) -> Vec<Instruction<u64>> {
        let mut w = Writer::default();
        let surface = Field::new(samples::FIRST, samples::SURFACE + EMPTY.bytes);
        w.extend(move_word(surface.of(from).address, samples::of(surface, number).address, surface.bytes));
        w.push(copy(MATERIAL.of(from), samples::of(MATERIAL, number)));
        let least = self.shading.word;
        if number == 0 {
            w.extend(move_word(from, least, BYTES));
            return w.0;
        }
        for byte in 0..BYTES {
            w.push(load(from + byte));
            let begin = if byte == 0 { Begin::One } else { Begin::Kept };
            w.push(with_accumulator(Function::Compare, least + byte).begins(begin).flags(Condition::Carry));
        }
        w.extend(move_word(from, least, BYTES).into_iter().map(|part| part.only(Mask::Flagged)));
        w.0
    }

    /// Combines the eight samples in the word that is shaded: 499 clocks.
    pub fn combine(self) -> Vec<Instruction<u64>> {
        let (mut w, word) = (Writer::default(), self.shading.word);
        w.push(set(Field::new(COUNT, 1), SAMPLES as i64));
        w.extend(samples::RGB.map(|sum| set(sum, 4)));
        w.extend(samples::NORMAL.map(|sum| set(sum, 0)));
        for number in 0..SAMPLES {
            self.surface(&mut w, number);
            for (channel, sum) in RGB.iter().zip(samples::RGB) {
                w.extend(add(samples::of(*channel, number), sum));
            }
            for (part, sum) in NORMAL.iter().zip(samples::NORMAL) {
                // The offset makes components 0 to 2^16 - 1, so no sum is negative.
                let part = samples::of(*part, number);
                let top = Field::new(part.top(), 1);
                w.push(with_constant(Function::ExclusiveOr, top, SIGN).to(top));
                w.extend(add(part, sum));
            }
        }
        for (channel, sum) in RGB.iter().zip(samples::RGB) {
            w.extend(eighth(sum, channel.of(word)));
        }
        for (part, sum) in NORMAL.iter().zip(samples::NORMAL) {
            let part = part.of(word);
            w.extend(eighth(sum, part));
            let top = Field::new(part.top(), 1);
            w.push(with_constant(Function::ExclusiveOr, top, SIGN).to(top));
        }
        self.behind(&mut w);
        w.0
    }

    /// All instructions that shade the combined word.
    pub fn program(self) -> Vec<Instruction<u64>> {
        [self.before_texture(), self.under_texture(), self.after_texture()].concat()
    }

    /// The part up to the start of the texture unit, as [`Shading::before_texture`].
    pub fn before_texture(self) -> Vec<Instruction<u64>> {
        self.shading.before_texture()
    }

    /// The part that needs no texture, as [`Shading::under_texture`]. It weights highlights by the number of covered
    /// samples.
    pub fn under_texture(self) -> Vec<Instruction<u64>> {
        let mut w = Writer(self.shading.under_texture());
        if w.0.is_empty() {
            return w.0;
        }
        // One shift to the left gives an eighth, because the product's four lowest bits are on top of the lower byte.
        w.push(load(REFLECTED));
        w.product(ZERO, COUNT, 4, [HIGH, LOW]);
        w.push(carried(Function::ShiftLeft, LOW).begins(Begin::Zero));
        w.push(carried(Function::ShiftLeft, HIGH).writes(REFLECTED));
        w.0
    }

    /// The part after the texture unit, as [`Shading::after_texture`]. It then adds the background's share.
    pub fn after_texture(self) -> Vec<Instruction<u64>> {
        let mut w = Writer(self.shading.after_texture());
        for channel in 0..3 {
            let to = self.shading.colour + channel;
            w.push(load(BEHIND.byte(channel)));
            let sum = with_accumulator(Function::Add, to).writes(to).begins(Begin::Zero);
            w.push(sum.flags(Condition::Carry));
            w.push(set(Field::new(to, 1), 255).only(Mask::Flagged));
        }
        w.0
    }

    /// Prepares a sample's colour and normal for the sums. They become those of the least word if the material differs,
    /// and 0 if nothing covers the sample. Such a sample is subtracted from the count.
    fn surface(self, w: &mut Writer, number: u64) {
        let material = samples::of(MATERIAL, number);
        let surface = Field::new(samples::FIRST, samples::SURFACE);
        let own = samples::of(surface, number);
        w.push(load(MATERIAL.of(self.shading.word).address));
        w.push(with_accumulator(Function::ExclusiveOr, material.address).writes(material.address));
        w.push(with_constant(Function::Compare, material, 1).begins(Begin::One).flags(Condition::Carry));
        let least = move_word(surface.of(self.shading.word).address, own.address, own.bytes);
        w.extend(least.into_iter().map(|part| part.only(Mask::Flagged)));
        let is_empty = with_constant(Function::Compare, samples::of(EMPTY, number), 1);
        w.push(is_empty.begins(Begin::One).flags(Condition::Carry));
        let (lower, top) = (Field::new(own.address, own.bytes - 1), Field::new(own.top(), 1));
        w.extend([lower, top].map(|part| set(part, 0).only(Mask::Flagged)));
        let count = Field::new(COUNT, 1);
        w.push(with_constant(Function::Subtract, count, 1).to(count).begins(Begin::One).only(Mask::Flagged));
    }

    /// Writes the background's share, `floor((background (8 - m) + 4) / 8)` for m covered samples. For m = 0 it is 0,
    /// because shading already gives the background.
    fn behind(self, w: &mut Writer) {
        w.push(set(BEHIND, 0));
        for covered in 1..=SAMPLES as i64 {
            let part = |channel: u8| (i64::from(channel) * (SAMPLES as i64 - covered) + 4) >> 3;
            let [red, green, blue] = self.shading.shader.background.map(part);
            let count = with_constant(Function::Compare, Field::new(COUNT, 1), covered);
            w.push(count.begins(Begin::One).flags(Condition::Carry));
            w.push(set(BEHIND, red << 16 | green << 8 | blue).only(Mask::Flagged));
        }
    }
}

// The least word fits into addresses 160 to 183, and the samples fit below.
const _: () = assert!(appearance::BYTES <= 24 && SAMPLES * samples::BYTES <= 160);
