//! Constraints: what placers and timing analysers are told beside the Verilog.

mod chip;
mod pins;
mod text;

use crate::VerilogFile;
use chip::Chip;
pub use pins::{PinProblem, PinProblems, Pins};
use tilewright_circuit::ir::Design;

/// The languages of constraints.
///
/// ```
/// use tilewright_gen::Dialect;
///
/// assert_eq!(Dialect::ALL.map(Dialect::extension), ["sdc", "xdc", "lpf", "pcf"]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dialect {
    /// Synopsys Design Constraints, which most timing analysers read. It has no pins. nextpnr reads it if there is one
    /// clock, which comes from outside.
    Sdc,
    /// SDC as Vivado reads it, with pins.
    Xdc,
    /// The format of Diamond, which nextpnr reads for an ECP5.
    Lpf,
    /// The format that nextpnr reads for an iCE40.
    Pcf,
}

impl Dialect {
    /// All of them.
    ///
    /// ```
    /// use tilewright_gen::Dialect;
    ///
    /// assert!(Dialect::ALL.contains(&Dialect::Lpf));
    /// ```
    pub const ALL: [Dialect; 4] = [Dialect::Sdc, Dialect::Xdc, Dialect::Lpf, Dialect::Pcf];

    /// The ending of a file's name.
    ///
    /// ```
    /// use tilewright_gen::Dialect;
    ///
    /// assert_eq!(Dialect::Lpf.extension(), "lpf");
    /// ```
    pub const fn extension(self) -> &'static str {
        match self {
            Dialect::Sdc => "sdc",
            Dialect::Xdc => "xdc",
            Dialect::Lpf => "lpf",
            Dialect::Pcf => "pcf",
        }
    }
}

/// The constraints of a design: the period of each clock, the crossings between clocks, and the pins of its ports.
///
/// Periods are those of the description, also of a clock that a foreign module makes. A path between two clocks is a
/// declared crossing, because elaboration refuses any other path. SDC and XDC give such a path one period of the faster
/// clock, so that the bits of a Gray code arrive within one clock. nextpnr reports the delay of such a path and has no command for a limit,
/// so an `.lpf` and a `.pcf` have a comment in place of one.
///
/// [`Pins`] are optional. A design with pins needs one for each bit of each port.
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = elaborate(&tilewright_sim::for_examples::Delay).unwrap();
/// use tilewright_gen::{Dialect, Pins, constraints};
///
/// let file = constraints(&design, Dialect::Lpf, &Pins::none()).unwrap();
/// assert_eq!(file.name, "delay.lpf");
/// assert!(file.text.contains("FREQUENCY PORT \"clk\" 100 MHZ;"));
/// ```
///
/// # Errors
///
/// Every row of `pins` that does not fit the design or the dialect, and every port without a pin.
pub fn constraints(design: &Design, dialect: Dialect, pins: &Pins) -> Result<VerilogFile, PinProblems> {
    let chip = Chip::of(design);
    pins.check(&chip.ports, dialect)?;
    Ok(VerilogFile { name: format!("{}.{}", chip.name, dialect.extension()), text: text::print(&chip, dialect, pins) })
}
