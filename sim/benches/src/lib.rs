//! Designs that measure the simulator, and the measuring.
//!
//! A [`Subject`] is a design of some size, such as `pim16`. It is there twice: as a description (in [`designs`]), and in Verilog as
//! one would write it by hand (in the folder `verilog`). [`measure`] runs it in every engine of the simulator and, if it is
//! given [`Compiler`](tilewright_gen::tools::Compiler)s, in models that their Verilators make of what we print of the description
//! and of what is written by hand. All of them do the same cycles, alternately, and all have to end with the same checksum.
//!
//! `cargo bench -p tilewright-benches` prints the figures of the simulator alone, `tilewright bench --against verilator` all.

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

/// For so many cycles of each clock the resets are high at the start.
pub const RESET_CYCLES: u64 = 4;
