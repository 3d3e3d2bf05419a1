//! Edited circuits: each kind of edit that breaks a rule has its own sentence.

mod common;
mod expressions;
mod lanes;
mod objects;
mod whole;
