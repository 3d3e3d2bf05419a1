//! Drawing of primitives: each pixel keeps the least word, whatever the drawing sequence (DES-MIN).
//!
//! A word's bytes are computed from the least significant on. They are written as the new word and compared with the
//! stored one. After the whole word, the carry is 1 unless the new word is greater. Then the new word is copied, if the
//! pixel is covered.

use super::super::fields::{Field, appearance, gouraud};
use super::super::instruction::{Instruction, LONGEST};
use super::super::pixel::{Begin, Condition, Flagging, Function, Mask, Source};
use super::assembler::{alu, copy, set, with_constant};
use super::edges;
use super::{Expression, FRACTION};
use crate::pixel_planes::programs::{Edges, Surface};
use crate::prelude::Codes;

/// The addresses of a pixel's words.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Words {
    /// The stored word.
    pub kept: u64,
    /// The new word.
    pub new: u64,
}

/// A region: its width and height in pixels, and the form in which edges are sent.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Region {
    /// Pixels along x and y.
    pub size: [u32; 2],
    /// The form in which edges are sent.
    pub edges: Edges,
}

/// The planes of a surface that is shaded later, each relative to the region.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Appearance {
    /// Depth and diffuse colour.
    pub surface: Surface,
    /// The normal: right, down, forward.
    pub normal: [Expression; 3],
    /// u/w and v/w.
    pub uv: [Expression; 2],
    /// 1/w.
    pub scale: Expression,
    /// The index of the material.
    pub material: u8,
    /// The level of detail at the greatest scale, in 1/8.
    pub level: u8,
}

/// The instructions that draw a primitive with planes of colour. They take the edges' bytes, 5 + 3 x 3 clocks for the
/// planes, and 6 for the copy. There are none if the whole region is outside an edge.
///
/// ```
/// use tilewright_rtl::pixel_planes::programs::{Edges, Expression, Surface};
/// use tilewright_rtl::pixelflow::programs::{Region, Words, gouraud};
/// use tilewright_rtl::pixelflow::schedule::one_at_a_time;
///
/// let edges = [(3, 4, -99), (-9, 1, 300), (2, -8, 111)].map(|(a, b, c)| Expression { a, b, c });
/// let surface = Surface::of_one_colour(Expression { a: 5 << 16, b: 0, c: 900 << 16 }, 0xff_80_00);
/// let words = Words { kept: 256, new: 0 };
/// let clocks = [Edges::Fixed, Edges::Least].map(|edges_as| {
///     let region = Region { size: [128, 64], edges: edges_as };
///     one_at_a_time(&gouraud(region, words, &edges, &surface))
/// });
/// assert_eq!(clocks, [32, 26]);
/// ```
pub fn gouraud(region: Region, words: Words, edges: &[Expression], surface: &Surface) -> Vec<Instruction<u64>> {
    let Some(mut program) = edges::tests(region.size, region.edges, edges) else { return Vec::new() };
    let colours = gouraud::RGB.iter().zip(&surface.rgb).rev().map(|(field, plane)| planned(words, *field, plane));
    let depth = planned(words, gouraud::DEPTH, &surface.z);
    program.extend(compared(colours.chain([depth]).collect()));
    let [red, _, blue] = gouraud::RGB;
    program.extend(kept(words, blue.address, red.address + 1));
    program.extend(kept(words, gouraud::DEPTH.address, gouraud::BYTES));
    program
}

/// The instructions that draw a primitive's appearance. They take the edges' bytes, 5 + 6 x 4 + 3 x 3 clocks for the
/// planes, 2 for constants, and 20 for the copy. There are none if the whole region is outside an edge.
///
/// [`covered`] writes the zero later, because the depth alone decides between a word and the empty one.
pub fn appearance(
    region: Region,
    words: Words,
    edges: &[Expression],
    appearance: &Appearance,
) -> Vec<Instruction<u64>> {
    let Some(mut program) = edges::tests(region.size, region.edges, edges) else { return Vec::new() };
    let Appearance { surface, normal, uv, scale, material, level } = appearance;
    let plane = |(field, plane): (&Field, &Expression)| planned(words, *field, plane);
    let constant = |field: Field, number: u8| {
        with_constant(Function::Compare, field.of(words.kept), number.into()).to(field.of(words.new))
    };
    let mut steps = vec![
        plane((&appearance::SCALE, scale)),
        constant(appearance::LEVEL, *level),
        constant(appearance::MATERIAL, *material),
    ];
    steps.extend(appearance::UV.iter().zip(uv).rev().map(plane));
    steps.extend(appearance::RGB.iter().zip(&surface.rgb).rev().map(plane));
    steps.extend(appearance::NORMAL.iter().zip(normal).rev().map(plane));
    steps.push(plane((&appearance::DEPTH, &surface.z)));
    program.extend(compared(steps));
    program.extend(kept(words, appearance::DEPTH.address, appearance::BYTES));
    program.extend(kept(words, 0, appearance::ZERO.address));
    program
}

/// The instructions that distinguish covered pixels from empty ones after a region is drawn. They set the byte
/// [`appearance::ZERO`] to 0 unless the depth is the greatest. They take 4 clocks.
pub fn covered(word: u64) -> Vec<Instruction<u64>> {
    let is_greatest = with_constant(Function::Compare, appearance::DEPTH.of(word), -1).begins(Begin::One);
    vec![is_greatest.flags(Condition::NoCarry), set(appearance::ZERO.of(word), 0).only(Mask::Flagged)]
}

/// Computes the integer part of a plane, and compares it with the stored value.
fn planned(words: Words, field: Field, plane: &Expression) -> Instruction<u64> {
    let compared = alu(Function::Compare, Source::Expression).from(field.of(words.kept)).to(field.of(words.new));
    compared.expression(FRACTION / 8, plane)
}

/// The parts of a word's comparison: the first begins it, and the last sets the flag.
fn compared(mut parts: Vec<Instruction<u64>>) -> Vec<Instruction<u64>> {
    if let Some(first) = parts.first_mut() {
        *first = first.begins(Begin::One);
    }
    if let Some(last) = parts.last_mut() {
        let flagging = Flagging::EnabledCondition.code();
        *last = Instruction { flagging, condition: Condition::Carry.code(), ..*last };
    }
    parts
}

/// Copies the new word's bytes from address `from` to before `to`, if the flag is set. The shortest part comes first,
/// because the next primitive's edges may begin when the last part is taken.
fn kept(words: Words, from: u64, to: u64) -> impl Iterator<Item = Instruction<u64>> {
    let longest = u64::from(LONGEST);
    let first = (to - from) % longest;
    let parts =
        std::iter::once((from, first)).chain((from + first..to).step_by(LONGEST as usize).map(move |at| (at, longest)));
    parts.filter(|(_, bytes)| *bytes > 0).map(move |(at, bytes)| {
        let field = Field::new(at, bytes);
        copy(field.of(words.new), field.of(words.kept)).only(Mask::Flagged)
    })
}
