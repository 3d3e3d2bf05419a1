//! The Verilog, its testbenches and the programs that read it.

mod asserts;
mod blocks;
mod golden;
mod kinds;
mod lanes;
mod lengths;
mod linters;
mod long;
mod names;
mod properties;
mod replay;
mod shapes;
mod simplified;
