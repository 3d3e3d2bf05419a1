//! The command line as a user meets it: what it prints, what it writes, how it fails.

mod bad_input;
mod bench;
mod determinism;
mod documentation;
mod engine;
mod harness;
mod interruption;
mod output;
mod render;
mod verilog;
mod wave;
