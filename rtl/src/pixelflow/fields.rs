//! The layout of a pixel's memory and communication registers (PFL-NODE, PFL-BYTES, facts E4).
//!
//! ```text
//! 0                                 256        288        320  322  324   325     328                    352      383
//! | memory: what is new, and what   | bank 0   | bank 1   | u  | v  |level|texture| 8 texels x 3 bytes    | free   |
//! | shading keeps                   '---- network --------'--------- texture unit ---------------------'
//! ```
//!
//! Numbers have their least significant byte at the lowest address, which is the sequence in which they are processed.
//! The network sends a word from its highest address down. So byte j of n, counted as they are sent, is at n - 1 - j
//! above the word's address. A whole word is thus also one number. A rasterizer keeps its words in the bank itself.
//! While the network has one bank, the next region is drawn in the other, and nothing is copied.
//!
//! | address in the word | 0 | 2 | 3 | 4 | 6 | 8 | 9 | 10 | 11 | 13 | 15 | 17 | 18 to 20 |
//! |---|---|---|---|---|---|---|---|---|---|---|---|---|---|
//! | of appearance | 1/w | level | material | v/w | u/w | blue | green | red | normal: forward | down | right | zero | depth |
//!
//! | address in the word | 0 | 1 | 2 | 3 | 4 to 6 |
//! |---|---|---|---|---|---|
//! | z \|\| rgb | blue | green | red | zero | depth |

use super::pixel::PixelProcessor;

/// A number in a pixel's memory.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Field {
    /// The address of its least significant byte.
    pub address: u64,
    /// The number of bytes.
    pub bytes: u64,
}

impl Field {
    /// A number at an address.
    pub const fn new(address: u64, bytes: u64) -> Field {
        Field { address, bytes }
    }

    /// The same number in a word at that address.
    ///
    /// ```
    /// use tilewright_rtl::pixelflow::fields::{appearance, bank};
    /// // The least significant byte of depth is the third that is sent of 21.
    /// assert_eq!(appearance::DEPTH.of(bank(1)).address, bank(1) + 21 - 1 - 2);
    /// ```
    pub const fn of(self, word: u64) -> Field {
        Field { address: word + self.address, ..self }
    }

    /// One of its bytes, from the least significant on.
    pub const fn byte(self, number: u64) -> u64 {
        self.address + number
    }

    /// The address of its most significant byte.
    pub const fn top(self) -> u64 {
        self.address + self.bytes - 1
    }
}

/// The address of one of the network's two banks.
pub const fn bank(number: u64) -> u64 {
    PixelProcessor::REGISTERS as u64 + 32 * number
}

/// The appearance word; its fields are relative to its address.
pub mod appearance {
    use super::Field;

    /// The number of its bytes.
    pub const BYTES: u64 = 21;
    /// 1/w.
    pub const SCALE: Field = Field::new(0, 2);
    /// The level of detail at the greatest scale, in 1/8.
    pub const LEVEL: Field = Field::new(2, 1);
    /// The material.
    pub const MATERIAL: Field = Field::new(3, 1);
    /// u/w and v/w.
    pub const UV: [Field; 2] = [Field::new(6, 2), Field::new(4, 2)];
    /// Red, green and blue.
    pub const RGB: [Field; 3] = [Field::new(10, 1), Field::new(9, 1), Field::new(8, 1)];
    /// The normal: right, down, forward.
    pub const NORMAL: [Field; 3] = [Field::new(15, 2), Field::new(13, 2), Field::new(11, 2)];
    /// 0 where the pixel is covered, otherwise 255.
    pub const ZERO: Field = Field::new(17, 1);
    /// Depth.
    pub const DEPTH: Field = Field::new(18, 3);
}

/// The word z || rgb; its fields are relative to its address.
pub mod gouraud {
    use super::Field;

    /// The number of its bytes.
    pub const BYTES: u64 = 7;
    /// Red, green and blue.
    pub const RGB: [Field; 3] = [Field::new(2, 1), Field::new(1, 1), Field::new(0, 1)];
    /// Always zero, where a fraction would be.
    pub const ZERO: Field = Field::new(3, 1);
    /// Depth.
    pub const DEPTH: Field = Field::new(4, 3);
}

/// The registers that the texture unit sees.
pub mod texture {
    use super::Field;

    /// u and v, with 16 bits of fraction.
    pub const UV: [Field; 2] = [Field::new(320, 2), Field::new(322, 2)];
    /// The level l: the unit gives the texels of this level and of the next finer one, if there is one.
    pub const LEVEL: Field = Field::new(324, 1);
    /// The number of the texture.
    pub const TEXTURE: Field = Field::new(325, 1);

    /// A channel of one of the four texels on level l + `finer`, that at (x, y). Channel 0 is red; x and y are 0 or 1.
    pub const fn texel(finer: u64, [x, y]: [u64; 2], channel: u64) -> Field {
        Field::new(328 + 3 * (4 * finer + 2 * y + x) + channel, 1)
    }
}

/// What is kept of eight samples that are shaded once: first the addresses where [`shading`] begins after them, then
/// those that it leaves alone.
pub(super) mod samples {
    use super::{Field, appearance};

    /// The bytes of a sample: colour, normal and the empty flag as in the word, and the material.
    pub const BYTES: u64 = 11;
    /// The bytes of colour and normal.
    pub const SURFACE: u64 = 9;
    /// The first of them, in the word and in a sample.
    pub const FIRST: u64 = appearance::RGB[2].address;

    /// A field of the word, in the sample with that number.
    pub const fn of(field: Field, number: u64) -> Field {
        let at = if field.address == appearance::MATERIAL.address { BYTES - 1 } else { field.address - FIRST };
        Field::new(BYTES * number + at, field.bytes)
    }

    /// The number of covered samples.
    pub const COUNT: u64 = 184;
    /// The background's contribution: blue, green and red.
    pub const BEHIND: Field = Field::new(185, 3);
    /// Sums of colours, red first, and of normals.
    pub const RGB: [Field; 3] = [Field::new(188, 2), Field::new(190, 2), Field::new(192, 2)];
    pub const NORMAL: [Field; 3] = [Field::new(194, 3), Field::new(197, 3), Field::new(200, 3)];
}

/// The memory of shading.
pub(super) mod shading {
    use super::Field;

    /// Zero.
    pub const ZERO: u64 = 0;
    /// The offset of sums that may be negative.
    pub const BIAS: Field = Field::new(2, 2);
    /// Room for products: the multiplier's digits, and the results.
    pub const DIGITS: u64 = 4;
    pub const HIGH: u64 = 5;
    pub const LOW: u64 = 6;
    pub const PARTIAL: u64 = 7;
    /// Room for the remainder of a root, and for texels between levels.
    pub const TRIAL: Field = Field::new(8, 4);
    /// Twice a remainder.
    pub const DOUBLED: Field = TRIAL;

    /// The pixel's material: the brightness of highlights, the number of squarings of cosines, and the finest level of
    /// its texture. Without light the number of squarings is 255.
    pub const MATERIAL: Field = Field::new(12, 3);
    pub const SPECULAR: u64 = 12;
    pub const SQUARINGS: u64 = 13;
    pub const FINEST: u64 = 14;

    /// The magnitude of the normal's components, which become remainders.
    pub const MAGNITUDE: [Field; 3] = [Field::new(16, 2), Field::new(18, 2), Field::new(20, 2)];
    /// The sum of their squares, one of these, and twice the product of a component's bytes.
    pub const SUM: Field = Field::new(22, 4);
    pub const SQUARE: Field = Field::new(26, 4);
    pub const CROSS: Field = Field::new(30, 2);
    /// The root, which moves down to the two lowest bytes; then the divisor.
    pub const ROOT: Field = Field::new(32, 4);
    /// The unit normal, 12 bits of fraction and a sign.
    pub const UNIT: [Field; 3] = [Field::new(36, 2), Field::new(38, 2), Field::new(40, 2)];

    /// Sums and differences of its components, as many as can occur.
    pub const COMBINATIONS: u64 = 42;
    /// A cosine, and the cosine of a highlight.
    pub const LIT: Field = Field::new(94, 2);
    pub const HIGHLIGHT: Field = Field::new(96, 2);
    /// The light that the surface reflects: a factor of its colour, and a summand.
    pub const DIFFUSE: u64 = 98;
    pub const REFLECTED: u64 = 99;

    /// A remainder of 1/w, and the part of u/w or v/w that is still to come.
    pub const REMAINDER: Field = Field::new(100, 2);
    pub const REST: u64 = 102;
    /// 1/w, shifted until its leading one is the top bit, and the position of that one.
    pub const LEADING: Field = Field::new(103, 2);
    pub const PLACE: u64 = 105;
    /// The level of detail: 16 bits, of which 8 are the weight of the finer level.
    pub const DETAIL: Field = Field::new(106, 2);
    /// u and v in texels; the lower byte of each upper pair is fraction.
    pub const TEXELS: [Field; 2] = [Field::new(108, 2), Field::new(110, 2)];
    /// Weights along u and v, on the level and the next finer one.
    pub const WEIGHTS: [[u64; 2]; 2] = [[112, 113], [114, 115]];
    /// Values between the texels of a row, on each level: 2 rows of 3 channels.
    pub const ROWS: [u64; 2] = [116, 122];
    /// Values between rows, 3 channels on each level; then between levels.
    pub const LEVELS: [u64; 2] = [128, 131];
    /// The surface's own colour.
    pub const BASE: [u64; 3] = [134, 135, 136];
}
