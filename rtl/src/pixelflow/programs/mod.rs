//! The programs of a node: rasterization and shading (facts E0, E4).
//!
//! Each program has a file of its own. It makes the instructions for one primitive or one region, as the node's
//! processors would.
//!
//! A rasterizer [clears](clear()) the words of a region, draws triangles, and gives the words to the network. A pixel
//! keeps the least word, whatever the drawing sequence. [`gouraud`] draws words z || rgb. [`appearance`] draws
//! appearance words, and [`covered`] flags their empty pixels. Words are in the network's registers from the start
//! ([`fields`](super::fields)), so nothing is copied. A copy of 21 bytes would take 21 clocks per region.
//!
//! If the samples of a pixel come one after another, the node of the frame buffer adds them up ([`add_sample`]). At the
//! end it divides the sums to get colours ([`average`](average())).
//!
//! A shader makes a colour from each appearance word ([`Shading`]), or from eight words that come one after another
//! ([`ShadingOnce`]). It matches the golden shader bit for bit, because all steps are exact floors.
//!
//! | file | program |
//! |---|---|
//! | `clear` | empties words |
//! | `edges`, `least_word` | triangles |
//! | `ports` | synchronization with the network; copies of words |
//! | `arithmetic` | digits of products and quotients |
//! | `normalize` | the unit normal |
//! | `light` | cosines, highlights and their sums |
//! | `perspective` | texture coordinates and level |
//! | `filter` | interpolation between texels |
//! | `shade` | complete shading |
//! | `shade_once` | shading of eight samples at once |
//! | `average` | sums of samples, and their mean |
//!
//! # Clocks
//!
//! The table is for regions of 128 x 64 and triangles with three edges; lights have highlights of power 32. "One at a
//! time" is the sum over all instructions. "Side by side" is the time from the beginning of a program to that of the
//! next one, in a long sequence of equal programs. The paper's figures are its times at 100 MHz (PFL-LAT1, PFL-NT,
//! PFL-SHADE); it does not print the programs. Shading takes the same time for one pixel and for a whole region. This
//! command prints the table:
//! `cargo test -p tilewright-rtl the_table_of_pixelflow -- --nocapture`.
//!
//! | program | one at a time | side by side | to compare |
//! |---|---|---|---|
//! | clear | 21 | 21 |  |
//! | gouraud, edges fixed | 32 | 28 | paper 62; facts 32 |
//! | gouraud, edges least | 26 | 22 | facts 26 |
//! | appearance, edges fixed | 72 | 58 | paper 83; facts 70 |
//! | appearance, edges least | 66 | 58 | facts 64 |
//! | covered | 4 | 4 |  |
//! | unit normal | 690 | 690 | facts 746 to 949 |
//! | four lights | 1414 | 1414 | facts 4398 to 5993 |
//! | two coordinates | 432 | 432 |  |
//! | level | 52 | 52 | with coordinates: facts 442 to 506 |
//! | weights | 48 | 48 |  |
//! | trilinear filter | 508 | 508 | facts 1050 to 1386 |
//! | before the texture unit | 490 | 490 | paper 1540 |
//! | during the texture unit | 2123 | 2123 | paper 9500 (the look-up) |
//! | after the texture unit | 673 | 673 |  |
//! | all | 3286 | 3286 | paper 11040 |
//! | all, without textures | 2188 | 2188 |  |
//! | add a sample to sums | 9 | 9 |  |
//! | mean of eight | 18 | 18 |  |
//! | take eight samples | 550 | 550 |  |
//! | combine eight samples | 499 | 499 |  |
//! | all, once for eight samples | 4356 | 4356 |  |
//!
//! - An appearance takes 2 clocks more than in facts E4, for the comparison of material and level.
//! - Side by side, the copy of a word overlaps the next primitive's edges and the fraction of its first plane. So the
//!   form of the edges does not matter: 58 is 72 without the 12 clocks of the edges and the 2 of the fraction.
//! - The paper's 1540 clocks, 15.4 us, are for addresses alone. Its 9500, 95 us, are for the slowest look-up; they hide
//!   the computation while the texture unit works.
//! - Four lights from any directions take at most 1476 clocks. The exact number depends on the ones in the binary
//!   components of their directions.
//! - A digit of a product takes 2 clocks, because the ALU adds and halves in one
//!   ([`Function::AddHalved`](super::pixel::Function::AddHalved)). A digit of a quotient takes 9.

use super::instruction::Instruction;
pub use crate::pixel_planes::programs::{Edges, Expression, Surface};

mod arithmetic;
mod assembler;
mod average;
mod clear;
mod edges;
mod filter;
mod least_word;
mod light;
mod normalize;
mod perspective;
mod ports;
mod shade;
mod shade_once;

pub use average::{SUM_BYTES, add_sample, average, begin_sums};
pub use clear::{clear, clear_to};
pub use least_word::{Appearance, Region, Words, appearance, covered, gouraud};
pub use ports::{await_bank, await_texture, give_bank, move_word, start_texture};
pub use shade::{Light, Material, NO_TEXTURE, Shader, Shading, Texture};
pub use shade_once::ShadingOnce;

/// The fraction bits of planes.
const FRACTION: u64 = 16;

#[cfg(test)]
mod tests;
