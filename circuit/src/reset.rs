//! How a clock resets its registers.

/// How a clock resets the registers that have a reset value. The kind of reset belongs to the
/// clock. So all registers on the clock share it, and blocks never name it.
///
/// - A **synchronous** reset takes effect at the clock edges at which it is active.
/// - An **asynchronous** reset takes effect as soon as it becomes active, and lasts while it is active. Its release
///   must be synchronous, so the pin first goes through a reset synchronizer.
/// - With **power-on** values alone there is no reset port. A register starts with its initial value or, without one,
///   with its reset value. An FPGA loads these values with its configuration.
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
///         def!(count = m.reg(4).reset(9));
///         count.next(count + 1);
///         CountOut { count: *count }
///     }
/// }
///
/// let text = |reset: Reset| {
///     let design = elaborate_at(&Count, DefaultClock::new(Period::ns(20)).reset(reset)).unwrap();
///     tilewright_gen::verilog(&design)[0].text.clone()
/// };
/// assert!(text(Reset::Asynchronous).contains("always @(posedge clk or posedge rst) begin"));
/// assert!(text(Reset::PowerOn).contains("initial count = 4'd9;"));
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Reset {
    /// Synchronous and active high; the port is `rst`.
    #[default]
    Synchronous,
    /// Synchronous and active low; the port is `rst_n`.
    SynchronousLow,
    /// Asynchronous and active high; the port is `rst`.
    Asynchronous,
    /// Asynchronous and active low; the port is `rst_n`.
    AsynchronousLow,
    /// No reset, only values at power-on.
    PowerOn,
}

impl Reset {
    /// All kinds.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// assert_eq!(Reset::ALL.iter().filter(|reset| reset.has_port()).count(), 4);
    /// ```
    pub const ALL: [Reset; 5] =
        [Reset::Synchronous, Reset::SynchronousLow, Reset::Asynchronous, Reset::AsynchronousLow, Reset::PowerOn];

    /// Whether the reset takes effect without an edge of the clock.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// assert!(Reset::AsynchronousLow.is_asynchronous() && !Reset::SynchronousLow.is_asynchronous());
    /// ```
    pub const fn is_asynchronous(self) -> bool {
        matches!(self, Reset::Asynchronous | Reset::AsynchronousLow)
    }

    /// Whether the port is low during a reset.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// assert!(Reset::SynchronousLow.is_active_low() && !Reset::Synchronous.is_active_low());
    /// ```
    pub const fn is_active_low(self) -> bool {
        matches!(self, Reset::SynchronousLow | Reset::AsynchronousLow)
    }

    /// Whether the reset has a port.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// assert!(!Reset::PowerOn.has_port());
    /// ```
    pub const fn has_port(self) -> bool {
        !matches!(self, Reset::PowerOn)
    }

    /// The name of the reset's port, for a named clock or for the default clock.
    #[doc(hidden)]
    pub fn port(self, clock: Option<&str>) -> Option<String> {
        let port = if self.is_active_low() { "rst_n" } else { "rst" };
        let port = clock.map_or(port.to_owned(), |clock| format!("{clock}_{port}"));
        self.has_port().then_some(port)
    }

    /// In the words of a message.
    #[doc(hidden)]
    pub fn words(self) -> &'static str {
        match self {
            Reset::Synchronous => "a synchronous reset",
            Reset::SynchronousLow => "an active-low synchronous reset",
            Reset::Asynchronous => "an asynchronous reset",
            Reset::AsynchronousLow => "an active-low asynchronous reset",
            Reset::PowerOn => "no reset",
        }
    }

    /// The ending of a module's name if its own clock resets in this way and the top's does not.
    #[doc(hidden)]
    pub fn suffix(self) -> &'static str {
        match self {
            Reset::Synchronous => "synchronous",
            Reset::SynchronousLow => "synchronous_low",
            Reset::Asynchronous => "asynchronous",
            Reset::AsynchronousLow => "asynchronous_low",
            Reset::PowerOn => "power_on",
        }
    }
}
