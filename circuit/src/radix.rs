//! Numbers that are shown in the radix in which they are written.

use crate::bits::Bits;

/// The radix in which a constant is shown.
///
/// ```
/// # use tilewright_hdl::*;
/// assert_eq!(Bits::new(8, 5).radix(), Radix::Any);
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash)]
pub enum Radix {
    /// Chosen by use: decimal for a count, hexadecimal for a mask.
    #[default]
    Any,
    /// Hexadecimal.
    Hex,
    /// Binary.
    Binary,
}

impl Bits {
    /// The same value, shown in this radix where it is a constant in Verilog. The radix does not matter to equality.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// let mask = Bits::new(8, 10).shown_in(Radix::Binary);
    /// assert_eq!((mask.radix(), mask == Bits::new(8, 10)), (Radix::Binary, true));
    /// ```
    pub fn shown_in(mut self, radix: Radix) -> Bits {
        self.radix = radix;
        self
    }

    /// The radix in which it is shown.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// assert_eq!(Bits::new(8, 10).shown_in(Radix::Hex).radix(), Radix::Hex);
    /// ```
    pub fn radix(&self) -> Radix {
        self.radix
    }
}
