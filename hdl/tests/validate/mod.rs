//! Circuits that were edited: each kind of edit that breaks a rule has its sentence.

mod common;
mod expressions;
mod lanes;
mod objects;
mod whole;
