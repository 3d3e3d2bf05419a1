//! Pads: pins of a chip that are driven from both sides.

use crate::block::Block;
use crate::module::Module;
use crate::select::{lit, mux};
use crate::signal::Signal;
use crate::width::{Width, bit, bits};
use tilewright_circuit::Loc;

crate::record! {
    /// What the outside of a pad does in simulation. It is an input of the top, such as `sda: Outside::widths(1)`. On
    /// the chip, the pad is an `inout` port of that name.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// let outside = Outside::widths(16);
    /// assert_eq!((outside.value.bits(), outside.drives.bits()), (16, 1));
    /// ```
    pub struct Outside(width: u32) {
        /// The value that the outside drives.
        value: bits(width),
        /// High while the outside drives the value. Low when it has released the line.
        drives: bit(),
    }

    /// The inputs of a [`Pad`].
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// assert_eq!(PadIn::widths(16).outside.value.bits(), 16);
    /// ```
    pub struct PadIn(width: u32) {
        /// The value that the chip drives.
        out: bits(width),
        /// High while the chip drives the value.
        enable: bit(),
        /// The other side, which is an input of the top.
        outside: Outside::widths(width),
    }

    /// The output of a [`Pad`].
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// assert_eq!(PadOut::widths(16).line.bits(), 16);
    /// ```
    pub struct PadOut(width: u32) {
        /// What the line shows.
        line: bits(width),
    }
}

impl PadIn {
    /// An open drain: the chip pulls the line low, or leaves it alone. A [pull-up](Pad::pull_up) makes the line high.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// block! {
    ///     /// A wire on which a chip and others may call.
    ///     struct Interrupt;
    ///     in InterruptIn { calls: bit(), irq: Outside::widths(1) }
    ///     out InterruptOut { called: bit() }
    /// }
    ///
    /// impl Interrupt {
    ///     fn build(&self, m: Module, i: InterruptIn) -> InterruptOut {
    ///         def!(irq = m.instance(&Pad::new(1).pull_up(), PadIn::open_drain(i.calls, i.irq)));
    ///         InterruptOut { called: !irq.line }
    ///     }
    /// }
    ///
    /// let mut sim = tilewright_sim::Simulation::of(&Interrupt)?;
    /// assert_eq!(sim.get(sim.o.called), 0);
    /// sim.set(sim.i.irq.drives, 1); // a low, because `value` is 0
    /// assert_eq!(sim.get(sim.o.called), 1);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn open_drain(low: impl Into<Signal>, outside: Outside) -> PadIn {
        PadIn { out: lit(1, 0), enable: low.into(), outside }
    }
}

/// A pad: one or more pins of a chip that are driven from both sides, such as the data bus of a memory. In Verilog a
/// pad is an `inout` port of the top, in which all pads are instantiated.
///
/// In simulation, the top has inputs for what the [`Outside`] does. Verilog has them, too, if the macro
/// `TILEWRIGHT_MODELS` is defined. `line` shows the chip's value while the chip drives, else the outside's while that
/// drives, else what the line is pulled to. An assertion fails if both sides drive and differ.
///
/// ```
/// # use tilewright_hdl::*;
/// block! {
///     /// A register that others read and write over a bus.
///     struct Shared;
///     in SharedIn { read: bit(), write: bit(), bus: Outside::widths(8) }
/// }
///
/// impl Shared {
///     fn build(&self, m: Module, i: SharedIn) {
///         def!(word = m.reg(8).reset(0));
///         let into = PadIn { out: *word, enable: i.read, outside: i.bus };
///         def!(bus = m.instance(&Pad::new(8), into));
///         word.when(i.write, bus.line);
///     }
/// }
///
/// let mut sim = tilewright_sim::Simulation::of(&Shared)?;
/// sim.drive(SharedIn { write: 1, bus: Outside { value: 7, drives: 1 }, ..SharedIn::default() });
/// sim.step();
/// sim.drive(SharedIn { read: 1, ..SharedIn::default() });
/// assert_eq!(sim.peek("u_bus.line")?, 7);
///
/// let text = &tilewright_gen::verilog(&elaborate(&Shared)?)[1].text;
/// assert!(text.contains("inout  wire [7:0] bus"));
/// assert!(text.contains("assign bus = read ? word : 8'bz;"));
/// # Ok::<(), tilewright_sim::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Pad {
    width: u32,
    pull: Pull,
}

/// The level of a line that nobody drives.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
enum Pull {
    /// The line floats: a simulation shows zeros.
    None,
    Up,
}

impl Pad {
    /// A pad of this width. Without a pull-up, a line that nobody drives shows zeros in simulation.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// assert_eq!(Pad::new(16).name(), "pad_width16_pull_none");
    /// ```
    pub fn new(width: u32) -> Pad {
        Pad { width, pull: Pull::None }
    }

    /// A pull-up makes the line high if nobody drives it. The pull-up is a resistor on the board, or a constraint sets
    /// it in the pin.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// assert_eq!(Pad::new(1).pull_up().name(), "pad_width1_pull_up");
    /// ```
    #[must_use]
    pub fn pull_up(self) -> Pad {
        Pad { pull: Pull::Up, ..self }
    }
}

impl Block for Pad {
    type In = PadIn;
    type Out = PadOut;

    fn inputs(&self) -> PadIn<Width> {
        PadIn::widths(self.width)
    }

    fn build(&self, m: Module, i: PadIn) -> PadOut {
        let PadIn { out, enable, outside } = i;
        let released = match self.pull {
            Pull::None => lit(self.width, 0),
            Pull::Up => !lit(self.width, 0),
        };
        let contends = enable & outside.drives & out.ne(outside.value);
        m.assert(!contends, "the two sides of the pad do not drive different values");
        PadOut { line: mux(enable, out, mux(outside.drives, outside.value, released)) }
    }

    fn outputs(&self) -> Vec<(String, Width)> {
        crate::declared("", &PadOut::widths(self.width))
    }

    fn declared(&self) -> Option<Loc> {
        Some(Loc::caller())
    }

    fn is_pad(&self) -> bool {
        true
    }
}
