//! The benches: what they compute, and their Verilog.

mod checksums;
mod verilog;
