//! The compiled engine: machine code made for one program.
#![allow(dead_code, unused_imports)]

mod jit;
mod lanes;
mod scalar;

pub use jit::Unsupported;
