//! What is where in a pixel's 208 bits of memory (facts E3).
//!
//! ```text
//! 0     8     16    24              48    56    64    72              96                       207
//! | blue| green| red|      z        | blue| green| red|      z        |          free            |
//! '-------- kept: z || rgb --------'  '---------- new ---------------'
//! ```
//!
//! Words lie with their least significant bit at the lowest address, in the order in which they are worked on: so the visibility word
//! z || rgb is one field of 48 bits (facts E0), and colours are compared before the depth that is above them.

/// Bits of a pixel's memory, side by side.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Field {
    /// The address of the least significant bit.
    pub address: u32,
    /// How many they are.
    pub bits: u32,
}

/// The blue channel that is kept.
pub const BLUE: Field = Field { address: 0, bits: 8 };
/// The green channel that is kept.
pub const GREEN: Field = Field { address: 8, bits: 8 };
/// The red channel that is kept.
pub const RED: Field = Field { address: 16, bits: 8 };
/// All channels that are kept.
pub const RGB: Field = Field { address: 0, bits: 24 };
/// The depth that is kept.
pub const DEPTH: Field = Field { address: 24, bits: 24 };
/// The visibility word that is kept: depth above colour.
pub const WORD: Field = Field { address: 0, bits: 48 };
/// Where what is new begins.
const NEW: u32 = 48;

impl Field {
    /// The field in which the new value stands, until it is known whether it is kept.
    ///
    /// ```
    /// use tilewright_rtl::pixel_planes::fields::DEPTH;
    /// assert_eq!(DEPTH.new_value().address, 72);
    /// ```
    pub const fn new_value(self) -> Field {
        Field { address: self.address + NEW, ..self }
    }
}
