//! The layout of a pixel's memory and communication registers (PFL-NODE, PFL-BYTES, facts E4).
//!
//! ```text
//! 0                                 256        288        320  322  324   325     328                    352      383
//! | memory: the new word, and the   | bank 0   | bank 1   | u  | v  |level|texture| 8 texels x 3 bytes    | free   |
//! | values of shading               '---- network --------'--------- texture unit ---------------------'
//! ```
//!
//! Numbers have their least significant byte at the lowest address, because it is processed first. The network sends a
//! word from its highest address down. So of n bytes, the byte sent j-th, from 0, is at n - 1 - j above the word's
//! address. A whole word is thus one number, too. A rasterizer keeps its words in the bank itself. While the network
//! has one bank, the next region is drawn in the other, and nothing is copied.
//!
//! | address in the word | 0 | 2 | 3 | 4 | 6 | 8 | 9 | 10 | 11 | 13 | 15 | 17 | 18 to 20 |
//! |---|---|---|---|---|---|---|---|---|---|---|---|---|---|
//! | appearance | 1/w | level | material | v/w | u/w | blue | green | red | normal: forward | down | right | zero | depth |
//!
//! | address in the word | 0 | 1 | 2 | 3 | 4 to 6 |
//! |---|---|---|---|---|---|
//! | z \|\| rgb | blue | green | red | zero | depth |

use super::pixel::PixelProcessor;

/// A number in a pixel's memory.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Field {
    /// The address of the least significant byte.
    pub address: u64,
    /// The number of bytes.
    pub bytes: u64,
}

impl Field {
    /// A number at an address.
    pub const fn new(address: u64, bytes: u64) -> Field {
        Field { address, bytes }
    }

    /// The same field in a word at this address.
    ///
    /// ```
    /// use tilewright_rtl::pixelflow::fields::{appearance, bank};
    /// // Of 21 bytes, the least significant one of the depth is sent third.
    /// assert_eq!(appearance::DEPTH.of(bank(1)).address, bank(1) + 21 - 1 - 2);
    /// ```
    pub const fn of(self, word: u64) -> Field {
        Field { address: word + self.address, ..self }
    }

    /// The address of a byte of the number; byte 0 is the least significant.
    pub const fn byte(self, number: u64) -> u64 {
        self.address + number
    }

    /// The address of the most significant byte.
    pub const fn top(self) -> u64 {
        self.address + self.bytes - 1
    }
}

/// The address of one of the network's two banks.
pub const fn bank(number: u64) -> u64 {
    PixelProcessor::REGISTERS as u64 + 32 * number
}

/// The fields of the appearance word, relative to the word's address.
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
    /// 0 if the pixel is covered, otherwise 255.
    pub const ZERO: Field = Field::new(17, 1);
    /// Depth.
    pub const DEPTH: Field = Field::new(18, 3);
}

/// The fields of the word z || rgb, relative to the word's address.
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

/// The registers that the texture unit accesses.
pub mod texture {
    use super::Field;

    /// u and v, with 16 bits of fraction.
    pub const UV: [Field; 2] = [Field::new(320, 2), Field::new(322, 2)];
    /// The level l: the unit gives the texels of this level and of the next finer one, if there is one.
    pub const LEVEL: Field = Field::new(324, 1);
    /// The number of the texture.
    pub const TEXTURE: Field = Field::new(325, 1);

    /// A channel of the texel at (x, y) on level l + `finer`. Channel 0 is red; `finer`, x and y are 0 or 1.
    pub const fn texel(finer: u64, [x, y]: [u64; 2], channel: u64) -> Field {
        Field::new(328 + 3 * (4 * finer + 2 * y + x) + channel, 1)
    }
}

/// The values of eight samples that are shaded once. The samples are at addresses that [`shading`] uses later, and the
/// other values at addresses that it does not use.
pub(super) mod samples {
    use super::{Field, appearance};

    /// The number of bytes of a sample: colour, normal and the empty flag as in the word, and the material.
    pub const BYTES: u64 = 11;
    /// The number of bytes of colour and normal.
    pub const SURFACE: u64 = 9;
    /// The address of the first byte of colour and normal in the word; a sample begins with that byte.
    pub const FIRST: u64 = appearance::RGB[2].address;

    /// The address of a field of the word in the sample with this number.
    pub const fn of(field: Field, number: u64) -> Field {
        let at = if field.address == appearance::MATERIAL.address { BYTES - 1 } else { field.address - FIRST };
        Field::new(BYTES * number + at, field.bytes)
    }

    /// The number of covered samples.
    pub const COUNT: u64 = 184;
    /// The background's contribution: blue, green and red.
    pub const BEHIND: Field = Field::new(185, 3);
    /// The sums of colours, red first, and of normals.
    pub const RGB: [Field; 3] = [Field::new(188, 2), Field::new(190, 2), Field::new(192, 2)];
    pub const NORMAL: [Field; 3] = [Field::new(194, 3), Field::new(197, 3), Field::new(200, 3)];
}

/// The memory that shading uses.
pub(super) mod shading {
    use super::Field;

    /// Zero.
    pub const ZERO: u64 = 0;
    /// The offset of sums that may be negative.
    pub const BIAS: Field = Field::new(2, 2);
    /// The digits of a multiplier, and the results of products.
    pub const DIGITS: u64 = 4;
    pub const HIGH: u64 = 5;
    pub const LOW: u64 = 6;
    pub const PARTIAL: u64 = 7;
    /// The remainder of a root, and later the texels between levels.
    pub const TRIAL: Field = Field::new(8, 4);
    /// A remainder times two.
    pub const DOUBLED: Field = TRIAL;

    /// The pixel's material: the brightness of highlights, the number of squarings of cosines, and the finest level of
    /// the texture. The number of squarings is 255 if no light falls on the material.
    pub const MATERIAL: Field = Field::new(12, 3);
    pub const SPECULAR: u64 = 12;
    pub const SQUARINGS: u64 = 13;
    pub const FINEST: u64 = 14;

    /// The magnitude of the normal's components, which become remainders.
    pub const MAGNITUDE: [Field; 3] = [Field::new(16, 2), Field::new(18, 2), Field::new(20, 2)];
    /// The sum of the components' squares, one square, and twice the product of a component's bytes.
    pub const SUM: Field = Field::new(22, 4);
    pub const SQUARE: Field = Field::new(26, 4);
    pub const CROSS: Field = Field::new(30, 2);
    /// The root, which moves down to the two lowest bytes, and becomes the divisor.
    pub const ROOT: Field = Field::new(32, 4);
    /// The unit normal: each component has a sign and 12 bits of fraction.
    pub const UNIT: [Field; 3] = [Field::new(36, 2), Field::new(38, 2), Field::new(40, 2)];

    /// The sums and differences of the unit normal's components; there is room for all that can occur.
    pub const COMBINATIONS: u64 = 42;
    /// A cosine, and the cosine of a highlight.
    pub const LIT: Field = Field::new(94, 2);
    pub const HIGHLIGHT: Field = Field::new(96, 2);
    /// The light that the surface reflects: a factor of the colour, and a summand.
    pub const DIFFUSE: u64 = 98;
    pub const REFLECTED: u64 = 99;

    /// The remainder of a division by 1/w, and the digits of u/w or v/w that are still to come.
    pub const REMAINDER: Field = Field::new(100, 2);
    pub const REST: u64 = 102;
    /// 1/w, shifted until its leading one is the top bit, and the position of that one.
    pub const LEADING: Field = Field::new(103, 2);
    pub const PLACE: u64 = 105;
    /// The level of detail: 16 bits, of which the lower 8 are the weight of the finer level.
    pub const DETAIL: Field = Field::new(106, 2);
    /// u and v, shifted to texels of the level; the upper byte is their fraction.
    pub const TEXELS: [Field; 2] = [Field::new(108, 2), Field::new(110, 2)];
    /// Weights along u and v, on the level and the next finer one.
    pub const WEIGHTS: [[u64; 2]; 2] = [[112, 113], [114, 115]];
    /// The values interpolated along rows, on each level: 2 rows of 3 channels.
    pub const ROWS: [u64; 2] = [116, 122];
    /// The values interpolated between rows: 3 channels on each level.
    pub const LEVELS: [u64; 2] = [128, 131];
    /// The colour of the surface itself.
    pub const BASE: [u64; 3] = [134, 135, 136];
}
