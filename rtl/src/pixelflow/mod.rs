//! PixelFlow: nodes that compose their images on a network (facts A4, E4).
//!
//! ```text
//!            node 0                node 1                          node n
//!          .---------.           .---------.                     .---------.
//!          | pixels  |           | pixels  |                     | pixels  |
//!          '----|----'           '----|----'                     '----^----'
//!         own v                     v                               | unloaded
//!          [ port ]== upstream ==>[ port ]==> ...             ==>[ port ]
//!            load                composite                       unload
//! ```
//!
//! A region of 128 x 64 pixels is in 32 chips of 256 pixels. The network has 8 wires for each chip, so a byte of each pixel takes 256 transfers of
//! 5 ns: 1.28 us (PFL-NET, PFL-TCB).
//!
//! | file | what is in it |
//! |---|---|
//! | [`compositor`] | of two pixels, the nearer, byte by byte |
//! | [`network_port`] | the compositors of a node, and whose turn it is |
//! | [`instruction`] | what a node is told to do |
//! | [`schedule`] | the clocks that it takes |
//! | [`fields`] | what is where in a pixel |
//! | [`programs`] | rasterization and shading |
//! | [`emulator`] | what instructions do, by definition |
//! | [`pixel`] | a pixel's ALU, flags and memory |

use crate::prelude::Period;

pub mod compositor;
pub mod emulator;
pub mod fields;
pub mod instruction;
pub mod network_port;
pub mod pixel;
pub mod programs;
pub mod schedule;

/// The time of a transfer: 200 MHz (PFL-NET).
pub const TRANSFER: Period = Period::ns(5);

/// Pixels of a chip, which share a compositor (facts E4).
pub const PIXELS: u32 = 256;

/// Chips of a node: 128 x 64 pixels (PFL-NODE).
pub const CHIPS: u32 = 32;
