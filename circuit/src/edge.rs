//! The edge of a clock at which its registers act.

/// The edge of a clock at which everything on it acts: registers, memories and properties. Like the kind of reset, the
/// edge belongs to the clock, so blocks never name it.
///
/// A clock whose edge is the falling one is high at first. It falls after one period, and after each further period.
/// So its edges have the times that those of a rising clock have. The simulator, waves, replays and Verilog agree on
/// that.
///
/// ```
/// # use tilewright_hdl::*;
/// block! {
///     /// Counts up.
///     struct Count;
///     out CountOut { count: bits(4) }
/// }
///
/// impl Count {
///     fn build(&self, m: Module, _: ()) -> CountOut {
///         def!(count = m.reg(4).reset(0));
///         count.next(count + 1);
///         CountOut { count: *count }
///     }
/// }
///
/// let design = elaborate_at(&Count, DefaultClock::new(Period::ns(20)).falling())?;
/// assert_eq!(design.top().clocks[0].edge, Edge::Falling);
/// assert!(tilewright_gen::verilog(&design)[0].text.contains("always @(negedge clk) begin"));
/// # Ok::<(), Problems>(())
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Edge {
    /// Where the clock rises.
    #[default]
    Rising,
    /// Where it falls.
    Falling,
}

impl Edge {
    /// In the words of a message.
    #[doc(hidden)]
    pub fn words(self) -> &'static str {
        match self {
            Edge::Rising => "acts on its rising edge",
            Edge::Falling => "acts on its falling edge",
        }
    }

    /// The ending of a module's name if its own clock has this edge and the top's has not.
    #[doc(hidden)]
    pub fn suffix(self) -> &'static str {
        match self {
            Edge::Rising => "rising",
            Edge::Falling => "falling",
        }
    }
}
