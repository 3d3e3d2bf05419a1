//! The Verilog, its testbenches, the programs that read it, and block diagrams.

mod asserts;
mod blocks;
mod constraints;
mod diagrams;
mod displays;
mod foreign;
mod golden;
mod kinds;
mod lanes;
mod lengths;
mod linters;
mod long;
mod names;
mod properties;
mod replay;
mod resets;
mod shapes;
mod simplified;
