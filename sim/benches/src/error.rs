//! Errors of measurements.

use tilewright_gen::tools::{Missing, Problems};

/// Why a measurement failed.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A requested program is not installed.
    #[error(transparent)]
    Missing(#[from] Missing),
    /// Verilator, clang or a model made by them failed.
    #[error("{0}")]
    Tool(#[from] Problems),
    /// The output of a model is not its figures.
    #[error("{name}: the model printed `{printed}` instead of a checksum and two times")]
    Unreadable {
        /// The contender.
        name: String,
        /// Its output.
        printed: String,
    },
    /// Our simulator stopped.
    #[error(transparent)]
    Simulation(#[from] tilewright_sim::Error),
    /// Two simulators do not agree.
    #[error(
        "{design} after {cycles} cycles: the checksum of `{name}` is {found:08x}, that of `{other}` is {expected:08x}"
    )]
    Differs {
        /// The subject.
        design: String,
        /// The number of cycles.
        cycles: u64,
        /// The simulator that differs.
        name: String,
        /// Its checksum.
        found: u32,
        /// The simulator with which it is compared.
        other: String,
        /// The other's checksum.
        expected: u32,
    },
    /// The caller asked to stop.
    #[error("the measurement was interrupted at {design}")]
    Interrupted {
        /// The subject.
        design: String,
    },
}
