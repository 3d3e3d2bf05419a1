//! Prints a circuit: as Verilog with a self-checking testbench, and as a block diagram.
//!
//! [`verilog`] prints a [`Design`](tilewright_circuit::ir::Design) as one file a module, in the Verilog-2001 subset that
//! Verilator, Icarus and Yosys agree on. [`testbench`] replays a recorded run against those files. [`constraints()`]
//! prints clocks and pins for a placer. [`tools`] runs the external programs that check these files. [`diagram()`] draws the boxes and arrows that a paper would show.
//!
//! ```
//! use tilewright_gen::verilog;
//! use tilewright_hdl::{Module, bit, block, def, elaborate};
//!
//! block! {
//!     /// A lamp that each press switches on or off.
//!     struct Toggle;
//!     in ToggleIn { flip: bit() }
//!     out ToggleOut { on: bit() }
//! }
//!
//! impl Toggle {
//!     fn build(&self, m: Module, i: ToggleIn) -> ToggleOut {
//!         def!(on = m.reg(1).reset(0));
//!         on.when(i.flip, !on);
//!         ToggleOut { on: *on }
//!     }
//! }
//!
//! let files = verilog(&elaborate(&Toggle).unwrap());
//! assert_eq!(files[0].name, "toggle.v");
//! assert!(files[0].text.contains("else if (flip) on <= !on;"));
//! ```

mod bench;
mod constraints;
mod diagram;
pub mod tools;
mod verilog;

pub use bench::{Net, nets, testbench};
pub use constraints::{Dialect, PinProblem, PinProblems, Pins, constraints};
pub use diagram::{
    Around, Arrow, ArrowKind, BoxKind, Diagram, DiagramBox, DiagramError, DiagramOptions, Frame, diagram,
};
pub use verilog::verilog;

/// A file of the printed design: Verilog, the data to load into a memory, or constraints.
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = elaborate(&tilewright_sim::for_examples::Delay).unwrap();
/// let files = tilewright_gen::verilog(&design);
/// assert_eq!(files[0].name, "delay.v");
/// assert!(files[0].text.contains("held <= word;"));
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct VerilogFile {
    /// The file's name, such as `counter_width8.v`. Data files end in `.hex` and must be in the same directory as the
    /// Verilog.
    pub name: String,
    /// The whole text.
    pub text: String,
}
