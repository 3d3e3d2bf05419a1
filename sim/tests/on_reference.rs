//! The tests of other files on the reference engine.
#![allow(missing_docs)]
#![allow(clippy::duplicate_mod, reason = "each file also stands for itself")]

mod arithmetic;
mod arrays;
mod clocks;
mod testbench;
mod vcd;
mod vcd_values;
