//! Empties the words of a region: sets all bytes to 255, so that the depth is the greatest.

use super::super::fields::{Field, gouraud};
use super::super::instruction::{Instruction, LONGEST};
use super::assembler::set;

/// The instructions that fill `bytes` bytes from an address on with 255, in one clock per byte.
///
/// ```
/// use tilewright_rtl::pixelflow::fields::{appearance, bank};
/// use tilewright_rtl::pixelflow::{programs::clear, schedule::one_at_a_time};
/// assert_eq!(one_at_a_time(&clear(bank(0), appearance::BYTES)), 21);
/// ```
pub fn clear(word: u64, bytes: u64) -> Vec<Instruction<u64>> {
    let longest = u64::from(LONGEST);
    let part = |at: u64| set(Field::new(word + at, longest.min(bytes - at)), -1);
    (0..bytes).step_by(LONGEST as usize).map(part).collect()
}

/// The instructions that set words z || rgb to the greatest depth and the background's colour, in 7 clocks.
pub fn clear_to(word: u64, background: [u8; 3]) -> Vec<Instruction<u64>> {
    let [red, green, blue] = background.map(i64::from);
    let colour = Field::new(gouraud::RGB[2].of(word).address, gouraud::ZERO.address + 1);
    vec![set(colour, red << 16 | green << 8 | blue), set(gouraud::DEPTH.of(word), -1)]
}
