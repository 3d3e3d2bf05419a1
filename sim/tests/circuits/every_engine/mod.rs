//! What holds on every engine.

mod arithmetic;
mod arrays;
mod clocks;
mod testbench;
mod until;
mod vcd;
mod vcd_values;
