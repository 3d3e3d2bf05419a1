//! Clocks: a name and an exact period.

use std::fmt;

/// A clock period in picoseconds.
///
/// ```
/// # use tilewright_hdl::*;
/// assert_eq!(Period::ns(20), Period::ps(20_000));
/// assert_eq!((Period::ns(20).to_string(), Period::ps(2_500).to_string()), ("20 ns".into(), "2500 ps".into()));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Period(u64);

impl Period {
    /// A period in picoseconds. It must be even, because the clock is high for half of it. A clock's period is at
    /// most 2^50 ps, 18 minutes.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// // A pixel clock of 25.175 MHz, exact to a thousandth of a percent.
    /// const PIXEL: Period = Period::ps(39_722);
    /// assert_eq!(PIXEL.picoseconds(), 39_722);
    /// ```
    ///
    /// # Panics
    ///
    /// The period is 0 or odd.
    #[track_caller]
    pub const fn ps(picoseconds: u64) -> Period {
        assert!(
            picoseconds > 0 && picoseconds.is_multiple_of(2),
            "a clock period is an even number of picoseconds above 0"
        );
        Period(picoseconds)
    }

    /// A period in nanoseconds.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// assert_eq!(Period::ns(10), DEFAULT_PERIOD);
    /// ```
    ///
    /// # Panics
    ///
    /// The period is 0.
    #[track_caller]
    pub const fn ns(nanoseconds: u64) -> Period {
        // A period that is too long is reported where a clock uses it.
        Period::ps(nanoseconds.saturating_mul(1000) & !1)
    }

    /// The period in picoseconds.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// let clocks_a_frame = 16_666_666_666 / Period::ns(40).picoseconds();
    /// assert_eq!(clocks_a_frame, 416_666);
    /// ```
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

/// A named clock of a design. The name is the same in every module that uses the clock.
///
/// A block with one clock never mentions it: the block runs on the clock of the place where it is instantiated. A
/// block with several clocks has them among its parameters and uses [`Module::on`](crate::Module::on).
///
/// ```
/// # use tilewright_hdl::*;
/// const VIDEO: Clock = Clock::new("video", Period::ns(40));
///
/// block! {
///     /// Counts the pixels of a line.
///     struct Column { clock: Clock }
///     out ColumnOut { x: bits(10) }
/// }
///
/// impl Column {
///     fn build(&self, m: Module, _: ()) -> ColumnOut {
///         def!(x = m.on(self.clock).reg(10).reset(0));
///         x.next(x + 1);
///         ColumnOut { x: *x }
///     }
/// }
///
/// let design = elaborate(&Column { clock: VIDEO })?;
/// assert_eq!(design.top().clocks[0].period, Some(Period::ns(40)));
/// # Ok::<(), Problems>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Clock {
    /// The name; the Verilog ports are `NAME_clk` and `NAME_rst`.
    pub name: &'static str,
    /// The exact period.
    pub period: Period,
}

/// The clock's name: a testbench accepts a clock or its name.
impl AsRef<str> for Clock {
    fn as_ref(&self) -> &str {
        self.name
    }
}

impl Clock {
    /// A clock with this name and period.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// const VIDEO: Clock = Clock::new("video", Period::ns(40));
    /// assert_eq!(VIDEO.as_ref(), "video");
    /// ```
    pub const fn new(name: &'static str, period: Period) -> Clock {
        Clock { name, period }
    }
}
