//! The benches: their results, and their Verilog.

mod checksums;
mod equality;
mod verilog;
