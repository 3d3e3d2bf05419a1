//! The visibility word: depth above colour, so that the nearer of two samples is the smaller word.
//!
//! ```text
//! 47      24 23       0
//! |   z     |   rgb   |
//! ```

use tilewright_hdl::Bits;

/// The width of the word in bits: 24 bits of depth above 24 bits of colour.
pub const WORD: u32 = 48;

/// The word of a pixel where nothing was drawn: the greatest word, which every other replaces.
pub fn empty() -> Bits {
    Bits::ones(WORD)
}
