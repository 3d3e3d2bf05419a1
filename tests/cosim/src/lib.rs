//! Compares the simulator with other simulators on the printed Verilog.
//!
//! - [`operators`] and [`matrix`]: every operator at every width against big integers, Icarus and Verilator;
//! - [`board`]: a design with pads without their models;
//! - [`campaign`]: thousands of random designs, shrunk where they differ;
//! - [`drawn`]: a random design of one of three kinds;
//! - [`shaped`]: random circuits whose values have shapes, built node by node;
//! - [`streams`]: random networks of streams, of the library's blocks;
//! - [`features`]: what of the language a random design uses;
//! - [`reduce`]: a circuit that fails made smaller, node by node;
//! - [`fuzz`]: random designs and random edits of them, on both engines;
//! - [`causes`]: what is no cause of a value, forced, and the cause, forced;
//! - [`many`]: several stimuli of a random design at once;
//! - [`mutation`]: small edits of the blocks, which their own tests have to find;
//! - [`check`]: one design through all tools, for the blocks of the catalogue;
//! - [`workers`]: two threads that share jobs.

pub mod batch;
pub mod board;
pub mod build;
pub mod campaign;
pub mod causes;
pub mod check;
pub mod drawn;
mod dump;
mod edit;
pub mod features;
pub mod fuzz;
pub mod many;
pub mod matrix;
pub mod mutation;
pub mod operators;
pub mod reduce;
pub mod shaped;
pub mod spec;
pub mod stimulus;
pub mod strategy;
pub mod streams;
mod tally;
pub mod workers;

pub use campaign::{Campaign, Failure, Summary};
