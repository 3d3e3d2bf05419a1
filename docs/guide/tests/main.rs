//! The chapters say what is true: their code is the crate's, and what they print is what it prints.

mod book;
mod fpga;
mod outputs;
mod quotes;
mod tools;
