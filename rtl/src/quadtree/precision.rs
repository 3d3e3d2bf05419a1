//! The widths of a generator's numbers. A small machine, such as one on a board, has fewer bits of depth and colour.

use std::fmt;

use crate::prelude::*;

/// The fraction bits of a colour plane of the integer contract, below the 8 bits of the channel (facts E0).
const FRACTION: u32 = 16;
/// The bits of a colour's plane in the integer contract. A depth's plane is as wide as [`Precision::FULL`] says.
const COLOUR_PLANE: u32 = 24;

/// The widths of a generator's numbers in bits.
///
/// Of a plane of the integer contract, a machine has the upper bits: of 40 bits of depth, and of 24 bits of a colour.
/// A narrower machine leaves out the lower ones in each coefficient. Of a pixel it stores the upper bits of depth and
/// colour. So its picture equals the golden one of packets whose coefficients are cut so, with words that are cut so.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct Precision {
    /// A position on the screen.
    pub position: u32,
    /// A slope of an edge function, with its sign.
    pub slope: u32,
    /// An edge function, with its sign.
    pub edge: u32,
    /// A plane: depth has its upper bits. A colour has its upper bits too, if it has fewer than 24.
    pub plane: u32,
    /// The stored depth.
    pub depth: u32,
    /// Each stored channel of a colour.
    pub colour: u32,
}

impl Precision {
    /// The integer contract's own widths (facts E0): depth is in bits 39..16 of its plane, and a colour in bits 23..16.
    pub const FULL: Precision = Precision { position: 11, slope: 17, edge: 32, plane: 40, depth: 24, colour: 8 };

    /// These widths, if a machine can have them.
    ///
    /// # Errors
    ///
    /// One is 0 or above that of [`Precision::FULL`], or a plane is too narrow for what is stored of it.
    pub fn checked(self) -> Result<Precision, ParameterError> {
        let full = Precision::FULL;
        let widths = [
            ("position", self.position, 1..=full.position),
            ("slope", self.slope, 2..=full.slope),
            ("edge", self.edge, 2..=full.edge),
            ("plane", self.plane, 1..=full.plane),
            ("depth", self.depth, 1..=full.depth.min(self.plane)),
            ("colour", self.colour, 1..=full.colour.min(self.plane)),
        ];
        match widths.into_iter().find(|(_, bits, range)| !range.contains(bits)) {
            None => Ok(self),
            Some((name, bits, range)) => Err(ParameterError(format!(
                "`{name}` of the precision is {bits} bits: it has to be from {} to {}",
                range.start(),
                range.end()
            ))),
        }
    }

    /// The lowest bit of a depth in its plane.
    pub(super) fn depth_from(&self) -> u32 {
        self.plane - self.depth
    }

    /// The lowest bit of a stored channel in its plane.
    pub(super) fn colour_from(&self) -> u32 {
        self.plane.min(COLOUR_PLANE) - self.colour
    }

    /// The lower bits of a depth's coefficient that this machine leaves out.
    ///
    /// ```
    /// use tilewright_rtl::quadtree::precision::Precision;
    ///
    /// let small = Precision { plane: 20, ..Precision::FULL };
    /// assert_eq!((small.cut_of_depth(), small.cut_of_colour()), (20, 4));
    /// assert_eq!((Precision::FULL.cut_of_depth(), Precision::FULL.cut_of_colour()), (0, 0));
    /// ```
    pub fn cut_of_depth(&self) -> u32 {
        Precision::FULL.plane - self.plane
    }

    /// The lower bits of a colour's coefficient that this machine leaves out.
    pub fn cut_of_colour(&self) -> u32 {
        COLOUR_PLANE.saturating_sub(self.plane)
    }

    /// What this machine stores of a word of 48 bits: the upper bits of the depth and of each channel.
    ///
    /// ```
    /// use tilewright_rtl::quadtree::precision::Precision;
    ///
    /// let small = Precision { plane: 20, depth: 9, colour: 3, ..Precision::FULL };
    /// assert_eq!(small.stored(0xff_8000_20_40_e0), 0b1_1111_1111_001_010_111);
    /// assert_eq!(Precision::FULL.stored(0x12_3456_789a_bcde & 0xffff_ffff_ffff), 0x12_3456_789a_bcde & 0xffff_ffff_ffff);
    /// ```
    pub fn stored(&self, word: u64) -> u64 {
        let upper = |low: u32, bits: u32, kept: u32| word >> (low + bits - kept) & ((1 << kept) - 1);
        let channels = [FRACTION, 8, 0].map(|low| upper(low, Precision::FULL.colour, self.colour));
        let depth = upper(24, Precision::FULL.depth, self.depth);
        channels.into_iter().fold(depth, |word, channel| word << self.colour | channel)
    }
}

/// The widths as text, for the names of a generator's modules.
impl fmt::Debug for Precision {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Precision { position, slope, edge, plane, depth, colour } = self;
        write!(f, "numbers{position}_{slope}_{edge}_{plane}_{depth}_{colour}")
    }
}

#[cfg(test)]
mod tests {
    use super::super::format::{Format, Matrix};
    use super::*;

    const SMALL: Precision = Precision { position: 8, slope: 12, edge: 20, plane: 16, depth: 7, colour: 3 };

    #[test]
    fn widths_that_cannot_be_are_refused_in_a_sentence() {
        let problem = |precision: Precision| precision.checked().unwrap_err().to_string();
        assert_eq!(SMALL.checked().unwrap(), SMALL);
        let narrow = "`depth` of the precision is 17 bits: it has to be from 1 to 16";
        assert_eq!(problem(Precision { depth: 17, ..SMALL }), narrow);
        assert_eq!(
            problem(Precision { slope: 18, ..SMALL }),
            "`slope` of the precision is 18 bits: it has to be from 2 to 17"
        );
        let format = |width| Format::new(Screen { width, height: 4 }, Matrix::new(1, 1).unwrap(), 3).unwrap();
        assert!(format(256).with_precision(SMALL).unwrap().with_spram().is_ok());
        let wide = format(257).with_precision(SMALL).unwrap_err().to_string();
        assert_eq!(wide, "positions of 8 bits: a screen of 257x4 pixels needs more");
        let full = format(8).with_spram().unwrap_err().to_string();
        assert_eq!(full, "words of 48 bits in single-port memories: they have to have 16 or fewer");
    }

    /// Ones above what is cut, zeros below: each field is where it was.
    #[test]
    fn a_stored_word_has_the_upper_bits_of_each_field() {
        assert_eq!(SMALL.stored(0xfe00_00e0_00e0), 0b1111_1111_1100_0111);
        assert_eq!(SMALL.stored(0x01ff_ff1f_ff1f), 0b0000_0000_0011_1000);
    }
}
