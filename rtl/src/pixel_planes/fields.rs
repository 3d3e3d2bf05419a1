//! The layout of a pixel's 208 bits of memory (facts E3).
//!
//! ```text
//! 0     8     16    24              48    56    64    72              96                       207
//! | blue| green| red|      z        | blue| green| red|      z        |          free            |
//! '-------- kept: z || rgb --------'  '---------- new ---------------'
//! ```
//!
//! The least significant bit of a word has the lowest address, and is processed first. So the visibility word z || rgb
//! is one field of 48 bits (facts E0). Colours are compared before the depth above them.

/// Bits of a pixel's memory, side by side.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Field {
    /// The address of the least significant bit.
    pub address: u32,
    /// The number of bits.
    pub bits: u32,
}

/// The stored blue channel.
pub const BLUE: Field = Field { address: 0, bits: 8 };
/// The stored green channel.
pub const GREEN: Field = Field { address: 8, bits: 8 };
/// The stored red channel.
pub const RED: Field = Field { address: 16, bits: 8 };
/// All stored channels.
pub const RGB: Field = Field { address: 0, bits: 24 };
/// The stored depth.
pub const DEPTH: Field = Field { address: 24, bits: 24 };
/// The stored visibility word: depth above colour.
pub const WORD: Field = Field { address: 0, bits: 48 };
/// The first address of the new values.
const NEW: u32 = 48;

impl Field {
    /// The field of the new value, until the program decides whether the pixel keeps it.
    ///
    /// ```
    /// use tilewright_rtl::pixel_planes::fields::DEPTH;
    /// assert_eq!(DEPTH.new_value().address, 72);
    /// ```
    pub const fn new_value(self) -> Field {
        Field { address: self.address + NEW, ..self }
    }
}
