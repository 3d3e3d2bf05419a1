//! PixelFlow: nodes that compose their images over a network (facts A4, E4).
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
//! The 128 x 64 pixels of a region are in 32 chips of 256 pixels each. The network has 8 wires for each chip, so a byte
//! of each pixel takes 256 transfers of 5 ns: 1.28 us (PFL-NET, PFL-TCB).
//!
//! This is a node, without the processors that write its instructions:
//!
//! ```text
//! store, frames ==>[ command fetcher ]==>[ controller ]---->[ linear evaluator ]
//!                                              |                  | a x + b y + c
//!                                              '--- control --->[ pixels ]
//!                                                                  ^  |
//!                                                                  |  v
//! jobs ==>[ sequencers ]---->[ network ports ]<==>[ communication registers ]<==>[ texture unit ]
//! ```
//!
//! | file | contents |
//! |---|---|
//! | [`machine`] | nodes on a network with both directions |
//! | [`node`] | an array with its instructions, sequencers and network ports |
//! | [`command_dma`] | brings instructions to the array |
//! | [`array`](mod@array) | controller, evaluator, pixels and communication registers |
//! | [`instruction`] | the instructions of an array |
//! | [`controller`] | takes instructions and controls evaluator and pixels |
//! | [`linear_evaluator`] | A x + B y + C at all pixels |
//! | [`pixel`] | a pixel's ALU, flags and memory |
//! | [`registers`] | bytes of each pixel that a port also accesses |
//! | [`texture_unit`] | looks up the texels of each pixel |
//! | [`texture_memory`] | reads the texels around a point of a texture |
//! | [`frame_buffer`] | stores and shows frames |
//! | [`network_sequencer`] | decides what a node does with each word that passes |
//! | [`network_port`] | the compositors of a node, and the counter of their pixels |
//! | [`network`] | the ports of all nodes |
//! | [`compositor`] | chooses the nearer of two pixels, byte by byte |
//! | [`fields`] | the layout of a pixel's memory |
//! | [`programs`] | rasterization and shading |
//! | [`schedule`] | the clocks in which a controller takes instructions |
//! | [`emulator`] | a software model of what instructions do to a pixel |

use crate::prelude::{Clock, Period};
use std::ops::RangeInclusive;

pub mod array;
pub mod command_dma;
pub mod compositor;
pub mod controller;
pub mod emulator;
pub mod fields;
pub mod frame_buffer;
pub mod instruction;
pub mod linear_evaluator;
pub mod machine;
#[cfg(test)]
mod model;
pub mod network;
pub mod network_port;
pub mod network_sequencer;
pub mod node;
pub mod pixel;
pub mod programs;
pub mod registers;
pub mod schedule;
#[cfg(test)]
mod testing;
pub mod texture_memory;
pub mod texture_unit;

/// The clock of controller, evaluator and pixels: 100 MHz (facts E4).
pub const ARRAY: Clock = Clock::new("array", Period::ns(10));

/// The clock of the network: 100 MHz, on both edges (PFL-NET).
pub const NETWORK: Clock = Clock::new("network", TRANSFER);

/// The time of a transfer; transfers have a rate of 200 MHz (PFL-NET).
pub const TRANSFER: Period = Period::ns(5);

/// The number of pixels of a chip, which share a compositor (facts E4).
pub const PIXELS: u32 = 256;

/// The number of chips of a node with 128 x 64 pixels (PFL-NODE).
pub const CHIPS: u32 = 32;

/// The least and the greatest width and height of a region in pixels; each is a power of two.
pub const SIDES: RangeInclusive<u32> = 2..=256;
