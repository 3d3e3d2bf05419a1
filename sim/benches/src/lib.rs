//! Designs that measure the simulator, and the measurement.
//!
//! A [`Subject`] is a design of some size, such as `pim16`. It exists twice: as a description (in [`designs`]), and
//! in hand-written Verilog (in the folder `verilog`). [`measure`] runs it in every engine of the simulator. If it is
//! given [`Compiler`](tilewright_gen::tools::Compiler)s, it also runs it in models that their Verilators make from
//! the Verilog that we print and from the hand-written one. All of them run the same cycles, alternately, and all
//! must end with the same checksum.
//!
//! `cargo bench -p tilewright-benches` prints the figures of the simulator alone,
//! `tilewright bench --against verilator` those of all.

mod contender;
pub mod designs;
mod engine;
mod error;
mod measure;
mod report;
mod subject;
mod verilated;
mod word;

pub use engine::reset;
pub use error::Error;
pub use measure::{Effort, Rivals, Watch, measure};
pub use report::{FORMAT, Figures, Made, Measurement, Report, Versions};
pub use subject::{Family, HandWritten, Subject, USUAL};

/// The number of cycles of each clock for which the resets are high at the start.
pub const RESET_CYCLES: u64 = 4;
