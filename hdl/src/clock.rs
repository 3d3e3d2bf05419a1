//! Clocks: a name and an exact period.

use std::fmt;

/// A clock period in picoseconds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Period(u64);

impl Period {
    /// A period of so many picoseconds, an even number, since half of it is the clock's high time.
    pub const fn ps(picoseconds: u64) -> Period {
        assert!(
            picoseconds > 0 && picoseconds.is_multiple_of(2),
            "a clock period is an even number of picoseconds above 0"
        );
        Period(picoseconds)
    }

    /// A period of so many nanoseconds.
    pub const fn ns(nanoseconds: u64) -> Period {
        Period::ps(nanoseconds * 1000)
    }

    /// The period in picoseconds.
    pub const fn picoseconds(self) -> u64 {
        self.0
    }
}

impl fmt::Display for Period {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self.0 {
            ps if ps % 1000 == 0 => write!(f, "{} ns", ps / 1000),
            ps => write!(f, "{ps} ps"),
        }
    }
}

/// A named clock of a design. Its name is the same in every module that uses it.
///
/// A block with one clock does not mention any: it takes the clock of the place where it is instantiated. A block
/// with more has its clocks among its parameters, and says [`Module::on`](crate::Module::on).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Clock {
    /// The name; the ports in Verilog are `NAME_clk` and `NAME_rst`.
    pub name: &'static str,
    /// The exact period.
    pub period: Period,
}

/// Its name: a testbench takes a clock, or the name of one.
impl AsRef<str> for Clock {
    fn as_ref(&self) -> &str {
        self.name
    }
}

impl Clock {
    /// A clock of that name and period.
    pub const fn new(name: &'static str, period: Period) -> Clock {
        Clock { name, period }
    }
}
