//! Pixel-planes 5: renderers, each an array of pixels that compute, with a bit of adder and 208 bits of memory each (facts A0, E3).
//!
//! ```text
//!                  .------------------------- renderer -------------------------.
//!                  |                     a, b, c                                |
//! instructions ===>|[ queue ]==>[ controller ]------>[ linear tree ]            |
//!                  |               |    ^                  | a x + b y + c      |
//!                  |       control |    |                  v                    |
//!                  |               '----|-------->[ S x S pixel processors ]    |
//!                  |                    |                  | 48 planes          |
//!                  |                    '-- free --[ backing store ]============|==> lines, plane by plane
//!                  '------------------------------------------------------------'
//! ```
//!
//! A renderer draws a region of S x S pixels of the screen, and then another one. All coefficients are relative to the region: whoever makes
//! them has `c` at the region's upper left pixel, `c + a x0 + b y0`, so the hardware knows no place on the screen. With a quadratic tree in place of the linear one
//! a renderer draws spheres, too.
//!
//! | file | what is in it |
//! |---|---|
//! | [`linear_tree`] | A x + B y + C at all pixels |
//! | [`quadratic_tree`] | A x + B y + C + D x² + E x y + F y² at all pixels |
//! | [`pixel`] | a pixel's adder, flags and memory |
//! | [`instruction`] | the instructions, and the microcode of each operation |
//! | [`controller`] | what takes instructions and controls tree and pixels |
//! | [`backing_store`] | a finished region, sent while the next one is drawn |
//! | [`renderer`] | all of these |
//! | [`ring`] | brings instructions and planes to where they go |
//! | [`allocator`] | which renderer draws a region |
//! | [`frame_buffer`] | puts regions together to a picture |
//! | [`machine`] | renderers, ring, allocator and frame buffer |
//! | [`fields`] | what is where in a pixel's memory |
//! | [`programs`] | the instructions that draw triangles, polygons, vectors and spheres |
//! | [`schedule`] | the clocks in which a controller takes them |
//!
//! All sums are exact modulo powers of two, so bit-serial evaluation gives the integers of the contract bit for bit (facts E0).

use crate::prelude::{ParameterError, Period};

pub mod allocator;
pub mod backing_store;
mod bit_serial;
pub mod controller;
pub mod fields;
pub mod frame_buffer;
pub mod instruction;
pub mod linear_tree;
pub mod machine;
#[cfg(test)]
mod model;
pub mod pixel;
pub mod programs;
pub mod quadratic_tree;
pub mod renderer;
pub mod ring;
pub mod schedule;
#[cfg(test)]
mod testing;

/// The clock's period: 40 MHz (PP5-UT).
pub const PERIOD: Period = Period::ns(25);

/// Pixels along a side of a region in the machine that was built (PP5-ARCH).
pub const SIDE: u32 = 128;

/// The bits of a region's number: as many regions of 8 x 8 pixels as the largest screen has, 2048 x 2048 pixels.
pub const REGION_BITS: u32 = 16;

/// A number of pixels along a side of a region for which there is hardware.
///
/// # Errors
///
/// It is no power of two from 2 to 256.
pub fn side(pixels: u32) -> Result<u32, ParameterError> {
    if pixels.is_power_of_two() && (2..=256).contains(&pixels) {
        return Ok(pixels);
    }
    Err(ParameterError(format!(
        "a region of {pixels} x {pixels} pixels: its side has to be a power of two from 2 to 256"
    )))
}
