//! Running circuits: what a testbench sees of them, on every engine.
#![allow(missing_docs)]

mod asserts;
mod batch;
#[path = "../../../hdl/tests/shapes/build.rs"]
mod build;
mod edges;
mod engine;
mod engines;
mod every_engine;
mod fields;
mod glancing;
mod idle;
mod in_bounds;
mod instants;
mod lanes_by_name;
mod long_loops;
mod looking;
mod looking_on;
mod many_operands;
mod nested;
mod packed;
mod past;
mod quiet;
mod random;
mod resets;
mod rows_together;
mod shapes;
mod store;
mod tiers;
mod units;
mod vcd_rows;
mod versions;
mod watching;
mod wide;
mod windows;
mod words;
