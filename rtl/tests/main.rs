//! The blocks of the machines: their catalogue and their Verilog.

mod catalog;
mod diagrams;
mod figure_6;
mod verilog;
