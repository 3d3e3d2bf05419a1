//! The chapters say what is true: their code is the crate's, and what they print is what it prints.

mod book;
#[path = "../../../blocks/examples/dvi.rs"]
#[allow(dead_code, reason = "the chapters show a part of it")]
mod dvi;
mod fpga;
mod outputs;
mod quotes;
mod tools;
