//! Machine code of strip programs, made by Cranelift. Nothing outside of this room knows of it.

mod evaluated;
mod jit;
mod pages;
mod shared;
mod target;
mod translate;

pub(super) use jit::{Code, Jit, VECTOR, unsupported};
pub(crate) use shared::SharedCode;
pub use target::Unsupported;
#[cfg(test)]
pub(super) use target::tests::least;
