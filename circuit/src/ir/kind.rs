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

/// The names and the numbers of an enum's codes.
///
/// ```
/// # use tilewright_hdl::*;
/// codes! { enum Response { Okay = 0, Slverr = 2 } }
///
/// assert_eq!((Response::NAMES.of, Response::NAMES.codes[1], Response::NAMES.values[1]), ("Response", "Slverr", 2));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Names {
    /// The enum's name, such as `Phase`.
    pub of: &'static str,
    /// The codes' names, in the sequence of declaration.
    pub codes: &'static [&'static str],
    /// The number of each.
    pub values: &'static [u64],
}

impl Names {
    /// The place of a number among the codes; `None` if it is none of them.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// codes! { enum Response { Okay = 0, Slverr = 2 } }
    ///
    /// assert_eq!([0, 1, 2].map(|value| Response::NAMES.place(value)), [Some(0), None, Some(1)]);
    /// ```
    pub fn place(self, value: u64) -> Option<usize> {
        // Most enums count from 0.
        let counted = usize::try_from(value).ok().filter(|place| self.values.get(*place) == Some(&value));
        counted.or_else(|| self.values.iter().position(|known| *known == value))
    }

    /// The name of the code with that number; `None` if the number is no code.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// codes! { enum Response { Okay = 0, Slverr = 2 } }
    ///
    /// assert_eq!([0, 1, 2].map(|value| Response::NAMES.name(value)), [Some("Okay"), None, Some("Slverr")]);
    /// ```
    pub fn name(self, value: u64) -> Option<&'static str> {
        self.place(value).map(|place| self.codes[place])
    }

    /// The bits that the greatest number needs, at least 1.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// codes! {
    ///     enum Phase { Idle, Fill, Drain }
    ///     enum Opcode { Load = 0x03, Store = 0x23, Branch = 0x63 }
    /// }
    ///
    /// assert_eq!((Phase::NAMES.width(), Opcode::NAMES.width()), (2, 7));
    /// ```
    pub fn width(self) -> u32 {
        let greatest = self.values.iter().max().copied().unwrap_or(0);
        (64 - greatest.leading_zeros()).max(1)
    }
}

impl Kind {
    /// Its shift to the right.
    #[doc(hidden)]
    pub fn right_shift(self) -> Shift {
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
