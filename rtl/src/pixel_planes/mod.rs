//! Pixel-planes 5: each renderer is an array of pixel processors, each with a one-bit adder and 208 bits of memory
//! (facts A0, E3).
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
//! A renderer draws regions of S x S pixels, one after another. All coefficients are relative to the
//! region: the host gives `c` at the region's upper left pixel, `c + a x0 + b y0`. So the hardware knows no position on
//! the screen. With a quadratic tree instead of the linear one a renderer also draws spheres.
//!
//! | file | contents |
//! |---|---|
//! | [`linear_tree`] | A x + B y + C at all pixels |
//! | [`quadratic_tree`] | A x + B y + C + D x² + E x y + F y² at all pixels |
//! | [`pixel`] | a pixel's adder, flags and memory |
//! | [`instruction`] | the instructions, and the microcode of each operation |
//! | [`controller`] | takes instructions and controls tree and pixels |
//! | [`backing_store`] | a finished region, sent while the next one is drawn |
//! | [`renderer`] | all of the above |
//! | [`ring`] | carries instructions to renderers and planes to the frame buffer |
//! | [`allocator`] | gives regions to renderers |
//! | [`frame_buffer`] | assembles the picture from regions |
//! | [`machine`] | renderers, ring, allocator and frame buffer |
//! | [`fields`] | the layout of a pixel's memory |
//! | [`programs`] | the instructions that draw triangles, polygons, vectors and spheres |
//! | [`schedule`] | the clocks in which a controller takes the instructions |
//!
//! All sums are exact modulo powers of two, so bit-serial evaluation gives the contract's integers bit for bit (facts
//! E0).

use crate::prelude::Period;
use std::ops::RangeInclusive;

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

/// The width of a region's number in bits: enough for regions of 8 x 8 pixels on the largest screen, 2048 x 2048
/// pixels.
pub const REGION_BITS: u32 = 16;

/// The least and the greatest side of a region in pixels; it is a power of two.
pub const SIDES: RangeInclusive<u32> = 2..=256;
