//! Clocks: a name, an exact period, a kind of reset and an edge.

use crate::edge::Edge;
use crate::reset::Reset;
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
    /// A period in picoseconds. The number must be even, because the clock is high for half of the period. A clock's
    /// period is at most 2^50 ps, 18 minutes.
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
/// A block with one clock never mentions the clock. It runs on the clock of the place where it is instantiated. A block
/// with several clocks has them among its parameters, and uses `Module::on`.
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
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct Clock {
    /// The name; the Verilog ports are `NAME_clk` and `NAME_rst`, or `NAME_rst_n` for a reset that is active low.
    pub name: &'static str,
    /// The exact period.
    pub period: Period,
    /// How it resets its registers.
    pub reset: Reset,
    /// The edge at which its registers act.
    pub edge: Edge,
}

/// Shows the reset and the edge unless they are the usual ones. The text is a part of modules' names and headers.
impl fmt::Debug for Clock {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let mut text = f.debug_struct("Clock");
        text.field("name", &self.name).field("period", &self.period);
        if self.reset != Reset::default() {
            text.field("reset", &self.reset);
        }
        if self.edge != Edge::default() {
            text.field("edge", &self.edge);
        }
        text.finish()
    }
}

/// The clock's name: a testbench accepts a clock or its name.
impl AsRef<str> for Clock {
    fn as_ref(&self) -> &str {
        self.name
    }
}

impl Clock {
    /// A clock with this name and period. Its reset is synchronous and active high, and its registers act where it rises.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// const VIDEO: Clock = Clock::new("video", Period::ns(40));
    /// assert_eq!(VIDEO.as_ref(), "video");
    /// ```
    pub const fn new(name: &'static str, period: Period) -> Clock {
        Clock { name, period, reset: Reset::Synchronous, edge: Edge::Rising }
    }

    /// The same clock with another kind of reset.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// const VIDEO: Clock = Clock::new("video", Period::ns(40)).reset(Reset::AsynchronousLow);
    ///
    /// # block! {
    /// #     struct Column;
    /// #     out ColumnOut { x: bits(10) }
    /// # }
    /// # impl Column {
    /// #     fn build(&self, m: Module, _: ()) -> ColumnOut {
    /// def!(x = m.on(VIDEO).reg(10).reset(0));
    /// x.next(x + 1);
    /// #         ColumnOut { x: *x }
    /// #     }
    /// # }
    /// # let text = &tilewright_gen::verilog(&elaborate(&Column)?)[0].text;
    /// assert!(text.contains("always @(posedge video_clk or negedge video_rst_n) begin"));
    /// assert!(text.contains("if (!video_rst_n) x <= 10'd0;"));
    /// # Ok::<(), Problems>(())
    /// ```
    pub const fn reset(self, reset: Reset) -> Clock {
        Clock { reset, ..self }
    }

    /// The same clock, but everything on it acts where it falls.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// // A peripheral bus whose slave takes the word at the falling edge.
    /// const BUS: Clock = Clock::new("bus", Period::ns(40)).falling();
    ///
    /// # block! {
    /// #     struct Taker;
    /// #     in TakerIn { word: bits(8).on(BUS) }
    /// #     out TakerOut { taken: bits(8) }
    /// # }
    /// # impl Taker {
    /// #     fn build(&self, m: Module, i: TakerIn) -> TakerOut {
    /// def!(taken = m.on(BUS).pipe(i.word));
    /// #         TakerOut { taken }
    /// #     }
    /// # }
    /// # let text = &tilewright_gen::verilog(&elaborate(&Taker)?)[0].text;
    /// assert!(text.contains("always @(negedge bus_clk) begin"));
    /// # Ok::<(), Problems>(())
    /// ```
    pub const fn falling(self) -> Clock {
        Clock { edge: Edge::Falling, ..self }
    }
}

/// The clock of a top that names none: its period, its kind of reset and its edge. A [`Period`] is accepted wherever a
/// `DefaultClock` is.
///
/// ```
/// # use tilewright_hdl::*;
/// # block! {
/// #     struct Toggle;
/// #     out ToggleOut { high: bit() }
/// # }
/// # impl Toggle {
/// #     fn build(&self, m: Module, _: ()) -> ToggleOut {
/// #         def!(high = m.reg(1).reset(0));
/// #         high.next(!high);
/// #         ToggleOut { high: *high }
/// #     }
/// # }
/// let board = DefaultClock::new(Period::ns(20)).reset(Reset::SynchronousLow);
/// let design = elaborate_at(&Toggle, board)?;
/// assert_eq!(design.top().clocks[0].reset.as_deref(), Some("rst_n"));
/// # Ok::<(), Problems>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct DefaultClock {
    /// The exact period.
    pub period: Period,
    /// How it resets its registers.
    pub reset: Reset,
    /// The edge at which its registers act.
    pub edge: Edge,
}

impl DefaultClock {
    /// A clock with this period. Its reset is synchronous and active high, and its registers act where it rises.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// assert_eq!(DefaultClock::new(Period::ns(20)), Period::ns(20).into());
    /// ```
    pub const fn new(period: Period) -> DefaultClock {
        DefaultClock { period, reset: Reset::Synchronous, edge: Edge::Rising }
    }

    /// The same clock with another kind of reset.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// const BOARD: DefaultClock = DefaultClock::new(Period::ns(20)).reset(Reset::PowerOn);
    /// assert_eq!(BOARD.period, Period::ns(20));
    /// ```
    pub const fn reset(self, reset: Reset) -> DefaultClock {
        DefaultClock { reset, ..self }
    }

    /// The same clock, but everything on it acts where it falls.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// const BOARD: DefaultClock = DefaultClock::new(Period::ns(20)).falling();
    /// assert_eq!(BOARD.edge, Edge::Falling);
    /// ```
    pub const fn falling(self) -> DefaultClock {
        DefaultClock { edge: Edge::Falling, ..self }
    }
}

impl From<Period> for DefaultClock {
    fn from(period: Period) -> DefaultClock {
        DefaultClock::new(period)
    }
}

/// A named clock's period, reset and edge.
impl From<Clock> for DefaultClock {
    fn from(Clock { period, reset, edge, .. }: Clock) -> DefaultClock {
        DefaultClock { period, reset, edge }
    }
}
