//! The meaning of a value's bits.

use super::Shift;
use std::fmt;

/// How to read the bits of a value, in each lane. It does not affect results: an operation itself says whether it is
/// signed. Waves and Verilog show codes by name.
///
/// ```
/// # use tilewright_hdl::*;
/// use tilewright_hdl::ir::Kind;
///
/// codes! { enum Phase { Idle, Fill } }
///
/// let kinds = [Kind::Number, Kind::Signed, Kind::Code(Phase::NAMES)];
/// assert_eq!(kinds.map(|kind| kind.to_string()), ["a number", "signed", "a code of `Phase`"]);
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash)]
pub enum Kind {
    /// An unsigned number, or bits without a further meaning.
    #[default]
    Number,
    /// A number in two's complement.
    Signed,
    /// A code of an enum.
    Code(Names),
}

/// The names of an enum's codes.
///
/// ```
/// # use tilewright_hdl::*;
/// codes! { enum Phase { Idle, Fill } }
///
/// assert_eq!((Phase::NAMES.of, Phase::NAMES.codes[1]), ("Phase", "Fill"));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Names {
    /// The enum's name, such as `Phase`.
    pub of: &'static str,
    /// The codes' names; the index is the code.
    pub codes: &'static [&'static str],
}

impl Kind {
    /// Its shift to the right.
    pub(crate) fn right_shift(self) -> Shift {
        if self == Kind::Signed { Shift::RightSigned } else { Shift::Right }
    }

    /// The enum, if it is a code.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// use tilewright_hdl::ir::Kind;
    ///
    /// codes! { enum Phase { Idle, Fill } }
    ///
    /// assert_eq!(Kind::Code(Phase::NAMES).names(), Some(Phase::NAMES));
    /// assert_eq!(Kind::Signed.names(), None);
    /// ```
    pub fn names(self) -> Option<Names> {
        match self {
            Kind::Code(names) => Some(names),
            _ => None,
        }
    }
}

/// The text for messages: `a number`, `signed`, `` a code of `Phase` ``.
impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Kind::Number => f.write_str("a number"),
            Kind::Signed => f.write_str("signed"),
            Kind::Code(names) => write!(f, "a code of `{}`", names.of),
        }
    }
}
