//! A triangle as words of a block RAM: its packet of the integer contract, evaluated at the upper left of its box.
//!
//! Steps from pixel to pixel give exactly the values of direct evaluation (facts E0), so nothing is lost. Fields follow
//! each other from bit 0 on, without gaps.

use std::fmt;
use tilewright_hdl::{Signal, concat};
use tilewright_scenes::packet::{COLOUR_PLANE_BITS, DEPTH_PLANE_BITS};
use tilewright_scenes::{Plane, Triangle};

/// The bits of a word, as many as a block RAM of an ECP5 has side by side.
pub const WORD_BITS: u32 = 18;
/// The words of a triangle.
pub const WORDS: u32 = 29;

/// A field: its lowest bit, and its bits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Field {
    low: u32,
    bits: u32,
}

impl Field {
    const fn new(low: u32, bits: u32) -> Field {
        Field { low, bits }
    }

    const fn after(self, bits: u32) -> Field {
        Field { low: self.low + self.bits, bits }
    }

    /// The field of a packet whose words are signals.
    pub fn of(self, words: &[Signal]) -> Signal {
        let (first, last) = (self.low / WORD_BITS, (self.low + self.bits - 1) / WORD_BITS);
        let joined: Vec<Signal> = (first..=last).rev().map(|word| words[word as usize]).collect();
        concat(&joined).part(self.low % WORD_BITS, self.bits)
    }
}

/// The processor that draws the triangle.
pub const PROCESSOR: Field = Field::new(0, 3);
/// The triangle is the last one of its frame.
pub const LAST: Field = PROCESSOR.after(1);
/// The leftmost column of the box.
pub const LEFT: Field = LAST.after(9);
/// The uppermost row of the box.
pub const TOP: Field = LEFT.after(8);
/// The columns of the box, less one.
pub const COLUMNS: Field = TOP.after(9);
/// The rows of the box, less one.
pub const ROWS: Field = COLUMNS.after(8);

/// A value that changes by a fixed step to the right and downwards.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Interpolant {
    /// The value at the upper left of the box.
    pub value: Field,
    /// The step to the right; signed, if it has fewer bits.
    pub right: Field,
    /// The step downwards; signed, if it has fewer bits.
    pub down: Field,
}

impl Interpolant {
    const fn after(field: Field, value: u32, step: u32) -> Interpolant {
        let value = field.after(value);
        let right = value.after(step);
        Interpolant { value, right, down: right.after(step) }
    }

    /// The bits of the value.
    pub fn bits(self) -> u32 {
        self.value.bits
    }
}

/// The edge functions, the depth, and red, green and blue.
pub const INTERPOLANTS: [Interpolant; 7] = {
    let first = Interpolant::after(ROWS, EDGE, EDGE_STEP);
    let second = Interpolant::after(first.down, EDGE, EDGE_STEP);
    let third = Interpolant::after(second.down, EDGE, EDGE_STEP);
    let depth = Interpolant::after(third.down, DEPTH_PLANE_BITS, DEPTH_PLANE_BITS);
    let red = Interpolant::after(depth.down, COLOUR_PLANE_BITS, COLOUR_PLANE_BITS);
    let green = Interpolant::after(red.down, COLOUR_PLANE_BITS, COLOUR_PLANE_BITS);
    let blue = Interpolant::after(green.down, COLOUR_PLANE_BITS, COLOUR_PLANE_BITS);
    assert!(blue.down.low + blue.down.bits <= WORDS * WORD_BITS, "all fields fit into the words");
    [first, second, third, depth, red, green, blue]
};

const EDGE: u32 = 21;
const EDGE_STEP: u32 = 14;

/// A triangle that does not fit into the format.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TooLarge(String);

impl fmt::Display for TooLarge {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}", self.0)
    }
}

impl std::error::Error for TooLarge {}

/// The words of a triangle for this processor.
///
/// # Errors
///
/// A number of the packet has more bits than its field.
pub fn words(packet: &Triangle, processor: u32, is_last: bool) -> Result<[u32; WORDS as usize], TooLarge> {
    let bounds = packet.bounds;
    let mut words = Words([0; WORDS as usize]);
    words.put(PROCESSOR, "processor", processor.into())?;
    words.put(LAST, "mark", is_last.into())?;
    words.put(LEFT, "left", bounds.left.into())?;
    words.put(TOP, "top", bounds.top.into())?;
    words.put(COLUMNS, "width", (bounds.right - bounds.left).into())?;
    words.put(ROWS, "height", (bounds.bottom - bounds.top).into())?;
    let (left, top) = (i64::from(bounds.left), i64::from(bounds.top));
    for (at, edge) in INTERPOLANTS.iter().zip(packet.edges) {
        let value = |x: i64, y: i64| i64::from(edge.a) * x + i64::from(edge.b) * y + i64::from(edge.c);
        let (right, bottom) = (i64::from(bounds.right), i64::from(bounds.bottom));
        for corner in [value(right, top), value(left, bottom), value(right, bottom)] {
            words.fits(at.value, "edge", corner)?;
        }
        words.put_signed(at.value, "edge", value(left, top))?;
        words.put_signed(at.right, "edge's step", edge.a.into())?;
        words.put_signed(at.down, "edge's step", edge.b.into())?;
    }
    let planes = [packet.z, packet.rgb[0], packet.rgb[1], packet.rgb[2]];
    for (at, Plane { x, y, origin }) in INTERPOLANTS[3..].iter().zip(planes) {
        let mask = (1u64 << at.bits()) - 1;
        let start = x.wrapping_mul(left as u64).wrapping_add(y.wrapping_mul(top as u64)).wrapping_add(origin) & mask;
        for (field, number) in [(at.value, start), (at.right, x), (at.down, y)] {
            words.put(field, "plane", number as i64)?;
        }
    }
    Ok(words.0)
}

struct Words([u32; WORDS as usize]);

impl Words {
    fn put(&mut self, field: Field, what: &str, value: i64) -> Result<(), TooLarge> {
        if !(0..1 << field.bits).contains(&value) {
            return Err(too_large(field, what, value));
        }
        for bit in 0..field.bits {
            let at = field.low + bit;
            self.0[(at / WORD_BITS) as usize] |= ((value >> bit & 1) as u32) << (at % WORD_BITS);
        }
        Ok(())
    }

    fn put_signed(&mut self, field: Field, what: &str, value: i64) -> Result<(), TooLarge> {
        self.fits(field, what, value)?;
        self.put(field, what, value & ((1 << field.bits) - 1))
    }

    fn fits(&self, field: Field, what: &str, value: i64) -> Result<(), TooLarge> {
        let half = 1i64 << (field.bits - 1);
        if (-half..half).contains(&value) { Ok(()) } else { Err(too_large(field, what, value)) }
    }
}

fn too_large(field: Field, what: &str, value: i64) -> TooLarge {
    TooLarge(format!("a triangle's {what} is {value}, which {} bits do not store: draw smaller triangles", field.bits))
}
