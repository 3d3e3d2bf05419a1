//! The tests of other files on both engines side by side.
#![allow(missing_docs)]
#![allow(clippy::duplicate_mod, reason = "each file also stands for itself")]

mod arithmetic;
mod arrays;
mod clocks;
mod testbench;
mod vcd;
mod vcd_values;
